#!/usr/bin/env bats
# Tangent frames against the standard implementation, as the npm package mikktspace holds it.

load helpers

# agrees NAME MESH
agrees() {
  "$BURNISH_FIXTURE" tangents "$2" >corners
  node "$BURNISH_SOURCE_DIR/tests/cli/tangent_frames.mjs" "$1" <corners || { echo "differs: $1"; return 1; }
}

@test "as mikktspace has them, on plain, mirrored and split texture coordinates" {
  needs_node_package mikktspace
  for name in sphere mirrored-sphere torus mirrored-torus split-torus split-mirrored-sphere sheet mirrored-sheet; do
    for rows in 8 40; do  # even, so that no triangle lies across the mirror
      "$BURNISH_FIXTURE" mesh $name $rows m.obj
      agrees "$name $rows" m.obj
    done
  done
}

@test "as mikktspace has them, on triangles without texture area" {
  needs_node_package mikktspace
  # A fan around vertex 1: the second triangle's texture lies on a line, exactly so in single precision too.
  cat >fan.obj <<'OBJ'
v 0 0 0
v 1 0 0.1
v 0.8 0.7 0
v 0 1 0.2
v -0.9 0.3 0
v -0.2 -1 0.1
vt 0.5 0.5
vt 1 0.5
vt 0.875 0.75
vt 0.125 0.25
vt 0.5 0.125
vt 0.75 0.125
vn 0.1 0 1
f 1/1/1 2/2/1 3/3/1
f 1/1/1 3/3/1 4/4/1
f 1/1/1 4/4/1 5/5/1
f 1/1/1 5/5/1 6/6/1
OBJ
  agrees fan fan.obj
}

@test "the comparison sees a tangent that is wrong, and a sign" {
  needs_node_package mikktspace
  "$BURNISH_FIXTURE" mesh mirrored-torus 5 m.obj
  "$BURNISH_FIXTURE" tangents m.obj >corners
  awk 'NR == 1 { $9 += 0.01; $10 += 0.01; $11 += 0.01 } { print }' corners >tangent
  awk 'NR == 1 { $12 = -$12 } { print }' corners >sign
  for wrong in tangent sign; do
    call node "$BURNISH_SOURCE_DIR/tests/cli/tangent_frames.mjs" $wrong <$wrong
    [ "$status" -eq 1 ]
  done
}

@test "as mikktspace has them, on the meshes of \$BURNISH_TEST_MESHES" {
  needs_node_package mikktspace
  [ -n "${BURNISH_TEST_MESHES:-}" ] || skip "BURNISH_TEST_MESHES names no folder of meshes"
  compared=0
  for mesh in "$BURNISH_TEST_MESHES"/*.obj; do
    if grep -q '^vt' "$mesh"; then
      agrees "$(basename "$mesh")" "$mesh"
      compared=$((compared + 1))
    fi
  done
  [ $compared -gt 0 ]
}
