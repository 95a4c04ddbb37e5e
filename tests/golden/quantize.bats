#!/usr/bin/env bats
# What the chain from heights over normals and indices to mip levels made when it was last looked at: the palette as numbers, the
# indices as hashes. scripts/regen-goldens writes it anew.

load ../cli/helpers

# The height map is text, so that no change of the fixtures can hide one of the tools.
heights() {
  echo "P2 40 30 255"
  awk 'BEGIN { for (y = 0; y < 30; y++) for (x = 0; x < 40; x++) print int((x * x * 3 + y * y * 5 + x * y * 2 + 40 * (x > 17 && y > 9)) / 8) % 256 }'
}

golden() {
  local name=$1
  shift
  heights >h.pgm
  succeeds burnish-normals h.pgm -o n.png --height 12
  succeeds burnish-quantize n.png -n 64 -o q.exr "$@"
  succeeds burnish-mipmap q.exr -o m.exr
  "$BURNISH_FIXTURE" digest m.exr >digest
  if [ -n "${BURNISH_REGEN-}" ]; then cp digest "$BURNISH_SOURCE_DIR/tests/golden/$name.txt"; fi
  diff "$BURNISH_SOURCE_DIR/tests/golden/$name.txt" digest
}

@test "undithered" { golden quantize_none; }
@test "error diffusion" { golden quantize_diffusion --dither diffusion; }
@test "blue noise" { golden quantize_blue_noise --dither blue-noise; }
