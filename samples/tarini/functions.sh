# What the scripts of this folder share.

# A figure of a JSON report.
figure() { sed -n "s/^ *\"$2\": \([-+.0-9e]*\),\{0,1\}$/\1/p" "$1" | head -n 1; }
rounded() { LC_ALL=C printf "%.$2f" "$(figure "$1" "$3")"; }

faces_of() { grep -c '^f ' "$1"; }

# A template with its map, pixels, samples and material, which may be several lines with \n between.
fill_in() { sed -e "s/@MAP@/$2/" -e "s/@PIXELS@/$3/" -e "s/@SAMPLES@/$4/" -e "s/@MATERIAL@/$5/" "$1"; }
