#!/usr/bin/env bats
# The scenes of samples/ are as samples/README.md says: without what they name they fail for that and for nothing else.

load helpers

@test "every scene is read to the point where a file is missing" {
  local scenes=("$BURNISH_SOURCE_DIR"/samples/*/*.toml)
  [ "${#scenes[@]}" -ge 18 ]
  for scene in "${scenes[@]}"; do
    [[ $scene == */batch/* ]] && continue  # recipes
    cp "$scene" scene.toml
    refuses 2 "" burnish-render scene.toml -o x.png
    grep -qE "No such file|there is none" err || { echo "$scene:"; cat err; return 1; }
  done
}

@test "templates lack nothing but what is filled in" {
  local templates=("$BURNISH_SOURCE_DIR"/samples/*/*.toml.in)
  [ "${#templates[@]}" -ge 4 ]
  for template in "${templates[@]}"; do
    sed -e 's/@PATH@/ward/; s/@MODEL@/ward/; s/@SURFACE@/"quad"/; s/@LIGHT@/[1, 1, 1]/; s/@AGAINST@/[1, 1, 1]/; s/@PARAMETERS@//' \
      -e 's/@SAMPLES@/1/; s/@PIXELS@/8/; s/@MATERIAL@//' "$template" >scene.toml
    refuses 2 "" burnish-render scene.toml -o x.png
    grep -qE "No such file|there is none" err || { echo "$template:"; cat err; return 1; }
  done
}
