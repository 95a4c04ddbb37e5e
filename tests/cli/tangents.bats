#!/usr/bin/env bats
# burnish-tangents: every option, and every way of using it wrongly. The arithmetic is tested in
# unit/material_directions_test.cpp.

load helpers

# Bumps and flow of 15 x 11 texels; the flow has no length at column 7, row 5.
inputs() {
  make_image flow 15 11 flow.png uint16
  make_image normals 15 11 n.png
}

@test "flow against a normal map: orthogonal in float, holes filled and counted, and the report as the schema says" {
  inputs
  succeeds burnish-tangents flow.png --from flow --normal n.png -o t.exr -d float --report r.json --depfile t.d
  fits_schema tangents r.json
  [ "$("$BURNISH_FIXTURE" info t.exr)" = "15 11 3 float" ]
  [ "$(value degenerate_texels r.json)" = 1 ]
  [ "$(value invalid_normal_texels r.json)" = 0 ]
  "${PYTHON3:-python3}" -c 'import sys; assert 0 < float(sys.argv[1]) < 1e-6, sys.argv' "$(value max_abs_n_dot_t r.json)"
  [ "$(cat t.d)" = "t.exr: flow.png n.png" ]
}

@test "the defaults: vector to vector, the samples of the file's type; no normal map leaves z alone" {
  make_image normals 8 8 v.exr float  # their samples as they are: vectors of all lengths from ½ to 1.2
  succeeds burnish-tangents v.exr -o t.exr --report r.json
  fits_schema tangents r.json
  [ "$("$BURNISH_FIXTURE" info t.exr)" = "8 8 3 half" ]
  succeeds burnish-tangents v.exr -o explicit.exr --from vector --to vector --rotate 0 --y up
  same_bytes t.exr explicit.exr
  texel_is "$("$BURNISH_FIXTURE" texel v.exr 3 2 | awk '{l = sqrt($1*$1 + $2*$2 + $3*$3); print $1/l, $2/l, $3/l}')" t.exr 3 2 1e-3
  succeeds burnish-tangents v.exr -o t.png
  [ "$("$BURNISH_FIXTURE" info t.png)" = "8 8 3 uint8" ]
  grep -aqF '{"burnish:direction":"vector","burnish:space":"tangent"}' t.png
}

@test "--from and --to: one form into another and back" {
  inputs
  # Below the centre it flows to the right, right of it up, above it to the left.
  succeeds burnish-tangents flow.png --from flow --to angle -o a.exr
  [ "$("$BURNISH_FIXTURE" info a.exr)" = "15 11 1 half" ]
  texel_is 0 a.exr 7 8 1e-4
  texel_is 0.25 a.exr 12 5 1e-4
  texel_is 0.5 a.exr 7 2 1e-4
  succeeds burnish-tangents flow.png --from flow --to khr -o k.tif
  texel_is "0.5 1 1" k.tif 12 5 1e-4
  succeeds burnish-tangents flow.png --from flow -o v.tif
  succeeds burnish-tangents flow.png --from flow --to angle -o a.tif
  succeeds burnish-tangents a.tif --from angle -o va.tif
  succeeds burnish-tangents k.tif --from khr -o vk.tif
  same_pixels v.tif va.tif 5e-5
  same_pixels v.tif vk.tif 5e-5
  # The strength of khr is handed on, turned with its texel; nothing else has one.
  succeeds burnish-tangents flow.png --from khr --to khr --flip-u -o k.exr -d float
  texel_is "0.5 1 1" k.exr 0 5 1e-4
  texel_is "0.5 0 0" k.exr 14 5 1e-4
  refuses 1 "expected vector|angle|khr, got 'flow'" burnish-tangents flow.png --to flow -o x.png
  refuses 1 "expected vector|angle|flow|khr, got 'tangent'" burnish-tangents flow.png --from tangent -o x.png
}

@test "--rotate, --flip-u, --flip-v: the image and its vectors together" {
  inputs
  # A swirl turned is a swirl; mirrored it runs the other way. Without its third channel it is one.
  succeeds burnish-tangents flow.png --from flow -o t.exr -d float
  for angle in 180 -180 360 -720 540; do
    succeeds burnish-tangents flow.png --from flow -o r.exr -d float --rotate $angle
    same_pixels t.exr r.exr 2e-3  # 0 stores as the upper half
  done
  texel_is "1 0 0" t.exr 7 8 2e-4
  succeeds burnish-tangents flow.png --from flow -o m.exr -d float --flip-u
  texel_is "-1 0 0" m.exr 7 8 2e-4
  # Counter-clockwise: what was in the lower left corner, and pointed to the right, is in the lower right one and up.
  succeeds burnish-tangents flow.png --from khr --to khr -o k.exr -d float
  succeeds burnish-tangents flow.png --from khr --to khr -o q.exr -d float --rotate 90
  [ "$("$BURNISH_FIXTURE" info q.exr)" = "11 15 3 float" ]
  read -r x y s < <("$BURNISH_FIXTURE" texel k.exr 1 10)
  texel_is "$(echo "$x $y $s" | awk '{print 1 - $2, $1, $3}')" q.exr 10 13 1e-4
  for pair in "--rotate 270" "--rotate -90" "--flip-u --flip-v --rotate 90"; do
    succeeds burnish-tangents flow.png --from khr --to khr -o p.exr -d float $pair
    [ -e first.exr ] || cp p.exr first.exr
    same_pixels first.exr p.exr
  done
  for junk in 45 90.5 1e-3 inf nan; do
    refuses 1 "rotate: expected a multiple of 90 degrees" burnish-tangents flow.png --from flow -o x.png --rotate $junk
  done
  refuses 1 "--rotate: expected a number, got 'left'" burnish-tangents flow.png --from flow -o x.png --rotate left
}

@test "--y, --normal-y, --encoding and --channels" {
  inputs
  succeeds burnish-normals flow.png -o up.png --channel 0 --height 5
  succeeds burnish-normals flow.png -o down.png --channel 0 --height 5 --y down
  succeeds burnish-tangents flow.png --from flow -o v.png -d uint16
  succeeds burnish-tangents v.png -o t.exr -d float --normal up.png
  succeeds burnish-tangents v.png -o n.exr -d float --normal down.png --normal-y down
  same_pixels t.exr n.exr 0.02
  # What mirrors all maps mirrors the result.
  succeeds burnish-tangents v.png -o d.exr -d float --normal up.png --y down
  same_pixels t.exr d.exr 1e-6
  # Maps that differ in it make another one.
  succeeds burnish-tangents v.png -o f.exr -d float --normal down.png
  call same_pixels t.exr f.exr 0.1
  [ "$status" -eq 1 ]
  succeeds burnish-tangents v.png -o g.exr -d float --normal down.png --y down
  same_pixels f.exr g.exr 1e-6
  succeeds burnish-tangents v.png -o biased.tif --encoding biased
  succeeds burnish-tangents v.png -o biased.exr -d float --encoding biased
  same_pixels biased.tif biased.exr 1e-5
  succeeds burnish-tangents t.exr -o xy.exr -d float --normal up.png --channels xy
  same_pixels t.exr xy.exr 0.02
  refuses 1 "--channels" burnish-tangents v.png -o x.png --normal up.png --channels x
  refuses 5 "signed" burnish-tangents t.exr -o x.png --encoding signed
  refuses 5 "signed" burnish-tangents v.png -o x.exr --encoding signed
}

@test "the same bytes on any number of threads, through standard input and output" {
  inputs
  succeeds burnish-tangents flow.png --from flow --normal n.png -o one.png -j 1
  succeeds burnish-tangents flow.png --from flow --normal n.png -o four.png -j 4
  same_bytes one.png four.png
  burnish-tangents - --from flow --normal n.png -o - --output-type png <flow.png >stream.png
  same_bytes one.png stream.png
}

@test "maps that do not serve: each with its message, and nothing left behind" {
  inputs
  make_image normals 15 12 other.png
  make_image nan 15 11 nan.exr
  make_image flat 4 4 one.png
  refuses 3 "'other.png': expected 15x11 texels as in 'flow.png', got 15x12" burnish-tangents flow.png --from flow --normal other.png -o x.png
  refuses 3 "'n.png': expected 11x15 texels as in 'flow.png', got 15x11" burnish-tangents flow.png --from flow --rotate 90 --normal n.png -o x.png
  refuses 3 "'flow.png': expected 1 channel of directions as angle, got 3" burnish-tangents flow.png --from angle -o x.png
  refuses 3 "'one.png': expected 2 channels of directions as flow, got 1" burnish-tangents one.png --from flow -o x.png
  refuses 3 "'one.png': expected 3 channels of a normal map, got 1" burnish-tangents flow.png --from flow --normal one.png -o x.png
  refuses 3 "'nan.exr': expected finite directions, got nan at column 7, row 5" burnish-tangents nan.exr --from angle -o x.exr
  # Every normal is parallel to itself.
  refuses 3 "'n.png': expected directions, got none of any length that is not parallel to its normal" burnish-tangents n.png --normal n.png -o x.exr
  refuses 2 "'missing.png'" burnish-tangents missing.png -o x.png
  refuses 2 "'missing.png'" burnish-tangents flow.png --normal missing.png -o x.png
  refuses 1 "'flow.png': is an input" burnish-tangents flow.png --from flow -o flow.png
  refuses 1 "" burnish-tangents flow.png n.png -o x.png
  refuses 5 "half" burnish-tangents flow.png -o x.png -d half
}

@test "a map that says it is of another form, and a lookup table, are refused" {
  inputs
  succeeds burnish-tangents flow.png --from flow --to khr -o k.png
  succeeds burnish-tangents flow.png --from flow --to angle -o a.exr
  grep -aqF '{"burnish:direction":"khr"}' k.png
  refuses 3 "'k.png': expected directions as vector, got khr: burnish-tangents reads it --from khr and writes it --to vector" burnish-tangents k.png -o x.png
  refuses 3 "'a.exr': expected directions as vector, got angle" burnish-tangents a.exr -o x.png
  refuses 3 "'k.png': expected directions as vector, got khr" burnish-material --model banks --direction k.png -o x
  succeeds burnish-tangents k.png --from khr -o v.png
  succeeds burnish-material --model banks --direction v.png -o m
  succeeds burnish-lut strand -o lut.png --size 16
  refuses 3 "'lut.png': expected directions as vector, got a lookup table of strand" burnish-tangents lut.png -o x.png
}

@test "a file that promises more than it holds is refused by its name, whatever memory there is" {
  inputs
  "${PYTHON3:-python3}" - <<'PYTHON'
import struct, zlib
def chunk(name, data): return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
head = struct.pack(">IIBBBBB", 60000, 60000, 8, 2, 0, 0, 0)
open("huge.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(500000))) + chunk(b"IEND", b""))
PYTHON
  refuses 3 "'huge.png': " burnish-tangents huge.png -o x.png
  refuses 3 "'huge.png': " burnish-tangents flow.png --from flow --normal huge.png -o x.png
  refuses 3 "'huge.png': " burnish-material --model banks --direction huge.png -o x
  refuses 3 "'huge.png': " burnish-material --model banks --ks huge.png -o x
}

@test "object-space normals are refused where the file says so" {
  inputs
  printf 'v %s 0\n' '0 0' '1 0' '1 1' '0 1' >square.obj
  printf 'vt %s\n' '0 0' '1 0' '1 1' '0 1' >>square.obj
  printf 'f 1/1 2/2 3/3 4/4\n' >>square.obj
  succeeds burnish-transfer square.obj square.obj -o object.png --size 15x11
  refuses 3 "'object.png': expected normals in tangent space, got object space" burnish-tangents flow.png --from flow --normal object.png -o x.png
  succeeds burnish-transfer square.obj square.obj -o tangent.png --size 15x11 --space tangent
  succeeds burnish-tangents flow.png --from flow --normal tangent.png -o x.png
}
