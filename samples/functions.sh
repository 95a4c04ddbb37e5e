# What the scripts of the samples share.

# A figure of a JSON report.
figure() { sed -n "s/^ *\"$2\": \([-+.0-9e]*\),\{0,1\}$/\1/p" "$1" | head -n 1; }
rounded() { LC_ALL=C printf "%.$2f" "$(figure "$1" "$3")"; }

# The texels of a lookup table, by burnish-lut's report.
texels_of() { echo "$(figure "$1" width) × $(figure "$1" height)"; }

faces_of() { grep -c '^f ' "$1"; }

# A template with its map, pixels, samples and material, which may be several lines with \n between.
fill_in() { sed -e "s/@MAP@/$2/" -e "s/@PIXELS@/$3/" -e "s/@SAMPLES@/$4/" -e "s/@MATERIAL@/$5/" "$1"; }

# The beginning of a page in HTML, a table of Markdown in it, and pictures.
page() {
  cat <<PAGE
<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>$1</title>
<style>
body { font: 16px/1.5 sans-serif; max-width: 1080px; margin: 2em auto; color: #222 }
img { display: block; max-width: 100%; margin: 8px 0 }
td { padding: 2px 12px; border-bottom: 1px solid #ddd } table { border-collapse: collapse }
</style>
<h1>$1</h1>
PAGE
}
table() {
  echo '<table>'
  grep -v '^|---' "$1" | sed -e 's/^| /<tr><td>/' -e 's/ |$/<\/td><\/tr>/' -e 's/ | /<\/td><td>/g'
  echo '</table>'
}
pictures() { for picture in "$@"; do echo "<img src=\"$picture\" alt=\"\">"; done; }
