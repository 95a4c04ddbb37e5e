# Pages for man and completions, as `cmake --install` puts them beside the tools.
load helpers

@test "--man has every option of --help" {
  local tool
  for tool in "$BURNISH_BIN"/burnish-*; do
    "$tool" --man >page
    grep -q "^.TH BURNISH" page
    "$tool" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u >options
    [ -s options ]
    while read -r option; do
      grep -qF -- "${option//-/\\-}" page || { echo "$tool --man lacks $option"; return 1; }
    done <options
  done
}

@test "man finds no fault with the pages" {
  command -v groff >/dev/null || skip "there is no groff"
  for tool in "$BURNISH_BIN"/burnish-*; do
    "$tool" --man | groff -Kutf8 -man -Tutf8 -ww -b >text 2>faults
    [ ! -s faults ] || { echo "$tool"; head faults; return 1; }
    grep -q "OPTIONS" text
  done
}

# complete TOOL WORD…: what bash would offer for the last word.
complete_by_bash() {
  "$1" --completion bash >script
  bash -c 'source ./script; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); "_${1//-/_}"; printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort | tr '\n' ' '
}

@test "bash completes options, words, verbs and files" {
  touch map.png map.tif
  [ "$(complete_by_bash burnish-normals --wei)" = "--weights " ]
  [ "$(complete_by_bash burnish-normals --weights '')" = "gaussian uniform " ]
  [ "$(complete_by_bash burnish-normals ma)" = "map.png map.tif " ]
  [ "$(complete_by_bash burnish-normals -o map.p)" = "map.png " ]
  [ "$(complete_by_bash burnish-ptm f)" = "fit " ]
  [ "$(complete_by_bash burnish-ptm fit --rid)" = "--ridge " ]
  [ "$(complete_by_bash burnish-ptm fit --type '')" = "lrgb rgb " ]
}

@test "both shells read their scripts" {
  for tool in "$BURNISH_BIN"/burnish-*; do
    "$tool" --completion bash >script
    bash -n script
    command -v zsh >/dev/null || continue
    "$tool" --completion zsh >script
    zsh -n script
  done
  refuses 1 "--completion: expected bash|zsh, got 'fish'" burnish-normals --completion fish
}
