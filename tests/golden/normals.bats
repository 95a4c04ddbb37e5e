#!/usr/bin/env bats
# What burnish-normals made of one height map when it was last looked at, as text of 8-bit samples. scripts/regen-goldens
# writes it anew.

load ../cli/helpers

# The height map is text too, so that no change of the fixtures can hide one of the tool.
heights() {
  echo "P2 12 9 255"
  awk 'BEGIN { for (y = 0; y < 9; y++) for (x = 0; x < 12; x++) print (x * x * 7 + y * y * 13 + x * y * 5 + 40 * (x > 6 && y > 3)) % 256 }'
}

golden() {
  local name=$1
  shift
  heights >h.pgm
  succeeds burnish-normals h.pgm -o x.png --height 3 "$@"
  if [ -n "${BURNISH_REGEN-}" ]; then "$BURNISH_FIXTURE" text x.png >"$BURNISH_SOURCE_DIR/tests/golden/$name.ppm"; fi
  # One step of 8 bits: where a component falls on the border between two, the last bit of the arithmetic decides.
  same_pixels x.png "$BURNISH_SOURCE_DIR/tests/golden/$name.ppm" 0.00393
}

@test "4 neighbours" { golden normals_q4; }
@test "24 neighbours, gaussian, repeated" { golden normals_q24_gaussian --neighbors 24 --weights gaussian --wrap repeat; }
@test "80 neighbours, mirrored, y down" { golden normals_q80_down --neighbors 80 --wrap mirror --y down; }
