#!/usr/bin/env bats
# burnish-quantize: every option, and every way of using it wrongly. What holds for all tools is in every_tool.bats; that palettes
# and indices are the best ones is tested in unit/palette_*_test.cpp.

load helpers

# less A B: whether one figure is below another.
less() { awk "BEGIN { exit !($1 < $2) }" || { echo "$1 is not below $2"; return 1; }; }

# is_exr FILE, png_kind FILE: bit depth and colour type from the header.
is_exr() { [ "$(head -c 4 "$1" | od -An -tx1)" = " 76 2f 31 01" ]; }
png_kind() { od -An -tu1 -j24 -N2 "$1" | xargs; }

inputs() {
  make_image normals 64 48 n.png
  make_image ids 64 48 ids.png
  make_image mask 64 48 mask.png
}

@test "256 normals by default; -n and --normals choose" {
  inputs
  succeeds burnish-quantize n.png -o x.exr --report r.json
  [ "$(value normals r.json) $(value texels r.json) $(value lossless r.json)" = "256 3072 False" ]
  fits_schema quantize r.json
  is_exr x.exr
  last=180
  for n in 2 16 200 2000; do
    succeeds burnish-quantize n.png -n $n -o x.exr --report r.json
    succeeds burnish-quantize n.png --normals $n -o y.exr
    same_bytes x.exr y.exr
    [ "$(value normals r.json)" = $n ]
    less "$(value rms_deg r.json)" $last
    last=$(value rms_deg r.json)
  done
  succeeds burnish-quantize n.png -n 65536 -o x.exr --report r.json
  [ "$(value lossless r.json)" = True ]
  [ "$(value normals r.json)" = "$(value distinct_input_normals r.json)" ]
}

@test "PNG is indexed up to 256 normals, and 16-bit grey beyond" {
  inputs
  succeeds burnish-quantize n.png -n 256 -o x.png
  [ "$(png_kind x.png)" = "8 3" ]
  succeeds burnish-quantize n.png -n 257 -o x.png
  [ "$(png_kind x.png)" = "16 0" ]
  succeeds burnish-quantize n.png -n 256 -o x.png -d uint8
  succeeds burnish-quantize n.png -n 257 -o x.png -d uint16
  refuses 5 "uint16" burnish-quantize n.png -n 256 -o y.png -d uint16
  refuses 5 "uint8" burnish-quantize n.png -n 257 -o y.png -d uint8
  for d in uint8 uint16 half float; do refuses 5 "not $d" burnish-quantize n.png -o y.exr -d $d; done
}

@test "counts out of range, or together with a target, are refused" {
  inputs
  for n in -1 0 1 65537 1.5 many "" 99999999999; do refuses 1 "--normals" burnish-quantize n.png -o x.exr -n "$n"; done
  refuses 1 "--target-error" burnish-quantize n.png -o x.exr -n 16 --target-error 2
}

@test "--target-error finds the smallest palette" {
  inputs
  succeeds burnish-quantize n.png --target-error 3 -o x.exr --report r.json
  less "$(value rms_deg r.json)" 3.0000001
  n=$(value normals r.json)
  succeeds burnish-quantize n.png -n $((n - 1)) -o y.exr --report r.json
  less 3 "$(value rms_deg r.json)"
  succeeds burnish-quantize n.png -n "$n" -o y.exr
  same_bytes x.exr y.exr
  for junk in -1 181 much nan ""; do refuses 1 "target" burnish-quantize n.png -o z.exr --target-error "$junk"; done
}

@test "a target that an engine misses: exit 10" {
  inputs
  burnish-quantize n.png --engine imagequant -n 16 -o probe.exr 2>/dev/null || skip "built without libimagequant"
  refuses 10 "--target-error: expected an RMS angle of at most 0.01 degrees, got " burnish-quantize n.png --engine imagequant --target-error 0.01 -o x.exr
}

@test "--material: an interval each, in ascending order of id" {
  inputs
  for dither in none diffusion blue-noise; do
    succeeds burnish-quantize n.png --material ids.png -n 40 -o x.exr --report r.json --dither $dither
    fits_schema quantize r.json
    "${PYTHON3:-python3}" - <<'PYTHON'
import json
stats = json.load(open("r.json"))["stats"]
assert [m["id"] for m in stats["materials"]] == [0, 1, 2, 3], stats
next = 0
for m in stats["materials"]:
    assert m["first"] == next and m["count"] >= 1, stats
    next += m["count"]
assert next == stats["normals"] == 40, stats
PYTHON
  done
  refuses 3 "--normals: expected at least one for each of the 4 materials in 'ids.png', got 3" \
    burnish-quantize n.png --material ids.png -n 3 -o y.exr
}

@test "materials of another size, depth or channel count" {
  inputs
  make_image ids 64 47 small.png
  make_image ids 64 48 deep.png uint16
  make_image ids 64 48 half.exr half
  refuses 3 "'small.png'" burnish-quantize n.png --material small.png -o x.exr
  refuses 3 "'deep.png'" burnish-quantize n.png --material deep.png -o x.exr
  refuses 3 "'half.exr'" burnish-quantize n.png --material half.exr -o x.exr
  refuses 3 "'n.png'" burnish-quantize n.png --material n.png -o x.exr
  refuses 2 "'none.png'" burnish-quantize n.png --material none.png -o x.exr
}

@test "--mask" {
  inputs
  succeeds burnish-quantize n.png --mask mask.png -o x.exr --report r.json
  [ "$(value texels r.json)" = 3065 ]
  fits_schema quantize r.json
  make_image empty-mask 64 48 none.png
  refuses 3 "'none.png': expected texels that are not 0, got none: it masks every texel of 'n.png'" \
    burnish-quantize n.png --mask none.png -o y.exr
  make_image mask 63 48 small.png
  refuses 3 "'small.png'" burnish-quantize n.png --mask small.png -o y.exr
}

@test "--dither and --dither-amount" {
  inputs
  for dither in none diffusion blue-noise; do
    succeeds burnish-quantize n.png -n 32 --dither $dither -o $dither.exr --report r.json
    fits_schema quantize r.json
    succeeds burnish-quantize n.png -n 32 --dither $dither --dither-amount 1 -o x.exr
    same_bytes x.exr $dither.exr
    succeeds burnish-quantize n.png -n 32 --dither $dither --dither-amount 0 -o x.exr
    same_bytes x.exr none.exr
  done
  differ none.exr diffusion.exr
  differ none.exr blue-noise.exr
  differ diffusion.exr blue-noise.exr
  refuses 1 "expected none|diffusion|blue-noise" burnish-quantize n.png --dither ordered -o y.exr
  for junk in -0.1 1.1 nan some; do refuses 1 "dither" burnish-quantize n.png --dither diffusion --dither-amount "$junk" -o y.exr; done
}

@test "--engine" {
  inputs
  succeeds burnish-quantize n.png -n 64 -o default.exr --report r.json
  best=$(value rms_deg r.json)
  succeeds burnish-quantize n.png -n 64 --engine spherical -o x.exr
  same_bytes x.exr default.exr
  succeeds burnish-quantize n.png -n 64 --engine median-cut -o x.exr --report r.json
  less "$best" "$(value rms_deg r.json)"
  if burnish-quantize n.png -n 64 --engine imagequant -o x.exr --report r.json 2>/dev/null; then
    less "$best" "$(value rms_deg r.json)"
  fi
  refuses 5 "imagequant" burnish-quantize n.png -n 257 --engine imagequant -o y.exr
  refuses 1 "expected spherical|median-cut|imagequant" burnish-quantize n.png --engine octree -o y.exr
}

@test "--palette-output, and --palette reads it back" {
  inputs
  for ext in exr png; do
    succeeds burnish-quantize n.png --material ids.png -n 300 -o x.exr --palette-output p.$ext --report r.json
    fits_schema quantize r.json
    [ "$("$BURNISH_FIXTURE" info p.$ext | cut -d' ' -f1-3)" = "300 1 3" ]
    # Of a palette file, of the indexed map itself.
    for palette in p.$ext x.exr; do
      succeeds burnish-quantize n.png --material ids.png --palette $palette -o y.exr
      same_bytes x.exr y.exr
    done
  done
  for option in "-n 16" "--target-error 1" "--engine median-cut"; do
    # shellcheck disable=SC2086
    refuses 1 "--palette" burnish-quantize n.png --palette p.png $option -o z.exr
  done
  refuses 5 "EXR or PNG" burnish-quantize n.png -o z.exr --palette-output p.tif
}

@test "palettes of any image one texel high, and of garbage" {
  inputs
  make_image normals 30 1 strip.png
  succeeds burnish-quantize n.png --palette strip.png -o x.exr --report r.json
  [ "$(value normals r.json)" = 30 ]
  echo "not an image" >junk.png
  : >empty.exr
  refuses 3 "'junk.png'" burnish-quantize n.png --palette junk.png -o y.exr
  refuses 3 "'empty.exr'" burnish-quantize n.png --palette empty.exr -o y.exr
  refuses 3 "N x 1" burnish-quantize n.png --palette n.png -o y.exr
  refuses 2 "'none.exr'" burnish-quantize n.png --palette none.exr -o y.exr
  refuses 3 "material 1" burnish-quantize n.png --material ids.png --palette strip.png -o y.exr
}

@test "--y, --encoding, --channels and --space" {
  inputs
  succeeds burnish-quantize n.png -o up.exr
  succeeds burnish-quantize n.png -o x.exr --y up --encoding biased --space tangent --channels xyz
  same_bytes up.exr x.exr
  succeeds burnish-quantize n.png -o x.exr --y down --palette-output down.exr
  succeeds burnish-quantize n.png -o x.exr --palette-output xy.exr --channels xy
  succeeds burnish-quantize n.png -o object.exr --space object
  grep -aq object object.exr
  [ "$(grep -ac object up.exr)" = 0 ]
  make_image normals 64 48 biased.exr float
  succeeds burnish-quantize biased.exr --encoding biased -o x.exr --report r.json
  less "$(value rms_deg r.json)" 2
  refuses 1 "expected up|down" burnish-quantize n.png -o y.exr --y left
  refuses 1 "expected tangent|object" burnish-quantize n.png -o y.exr --space world
  refuses 1 "expected biased|signed" burnish-quantize n.png -o y.exr --encoding gamma
  refuses 1 "channels" burnish-quantize n.png -o y.exr --channels zz9
}

@test "inputs that do not fit: exit 3" {
  inputs
  make_image bumps 8 8 grey.png
  make_image nan 8 8 nan.exr float
  "${PYTHON3:-python3}" - <<'PYTHON'
import struct
# An EXR of one texel, R G B floats, uncompressed: red is NaN.
def attribute(name, kind, data): return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
box = struct.pack("<4i", 0, 0, 0, 0)
head = struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\0") \
    + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0") \
    + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)) \
    + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
open("bad.exr", "wb").write(head + struct.pack("<Q", len(head) + 8) + struct.pack("<ii3f", 0, 12, 1, 0, float("nan")))
PYTHON
  refuses 3 "got NaN or infinity at column 0, row 0" burnish-quantize bad.exr -o x.exr
  refuses 3 "3 channels" burnish-quantize grey.png -o x.exr
  refuses 3 "'nan.exr'" burnish-quantize nan.exr -o x.exr
  head -c 300 n.png >cut.png
  refuses 3 "'cut.png'" burnish-quantize cut.png -o x.exr
  refuses 2 "'none.png'" burnish-quantize none.png -o x.exr
}

@test "outputs that cannot be: types, inputs, places" {
  inputs
  for ext in tif tga bmp; do refuses 5 "EXR, PNG, KTX2 or DDS" burnish-quantize n.png -o x.$ext; done
  refuses 5 "EXR, PNG, KTX2 or DDS" burnish-quantize n.png -o - --output-type tiff
  refuses 1 "--output-type" burnish-quantize n.png -o -
  refuses 1 "is an input" burnish-quantize n.png -o n.png
  refuses 1 "is an input" burnish-quantize n.png --material ids.png -o ids.png
  refuses 1 "is an input" burnish-quantize n.png -o x.exr --palette-output n.png
  refuses 1 "twice" burnish-quantize n.png -o x.exr --palette-output x.exr
  refuses 2 "'nowhere/x.exr'" burnish-quantize n.png -o nowhere/x.exr
  succeeds burnish-quantize n.png -o palette.exr
  refuses 1 "is an input" burnish-quantize n.png --palette palette.exr -o palette.exr
}

@test "an old output and its palette stay where anything fails" {
  inputs
  succeeds burnish-quantize n.png -o x.png --palette-output p.png --report r.json
  refuses 5 "uint16" burnish-quantize n.png -n 16 -d uint16 -o x.png --palette-output p.png --report r.json
}

@test "pipelines through -" {
  inputs
  succeeds burnish-quantize n.png -n 64 -o x.exr
  succeeds burnish-quantize n.png -n 64 -o x.png
  for type in exr png; do
    burnish-quantize - -n 64 -o - --output-type $type <n.png >piped
    same_bytes piped x.$type
  done
  burnish-normals - -o - --output-type png <n.png --channel R -q | burnish-quantize - -n 16 -o - --output-type exr | burnish-mipmap - -o m.exr
  is_exr m.exr
}

@test "the same bytes for any thread count, run and folder" {
  inputs
  mkdir a b
  for ext in exr png; do
    for dither in none diffusion blue-noise; do
      succeeds burnish-quantize n.png --material ids.png --dither $dither -o a/x.$ext --palette-output a/p.$ext -j 1
      for j in 2 8; do
        (cd b && succeeds burnish-quantize ../n.png --material ../ids.png --dither $dither -o x.$ext --palette-output p.$ext -j $j)
        same_bytes a/x.$ext b/x.$ext
        same_bytes a/p.$ext b/p.$ext
      done
    done
  done
}

@test "--depfile names every file that was read" {
  inputs
  succeeds burnish-quantize n.png -o p.exr --material ids.png
  succeeds burnish-quantize n.png --material ids.png --mask mask.png --palette p.exr -o x.exr --depfile x.d
  [ "$(cat x.d)" = "x.exr: n.png ids.png mask.png p.exr" ] || { cat x.d; return 1; }
}

@test "a palette of another space than the one asked for is refused; unasked, the palette's own is kept" {
  inputs
  succeeds burnish-quantize n.png -n 16 --space object -o object.exr
  refuses 3 "space" burnish-quantize n.png --palette object.exr --space tangent -o x.exr
  succeeds burnish-quantize n.png --palette object.exr -o x.exr
  succeeds burnish-quantize n.png --palette object.exr --space object -o y.exr
  same_bytes x.exr y.exr
}
