#!/usr/bin/env bats
# burnish-quantize --material-encoding: materials and normals in one colour cube, for our engines and for other quantizers.

load helpers

inputs() {
  make_image normals 64 48 n.png
  make_image ids 64 48 ids.png
  make_image mask 64 48 mask.png
}

needs() { command -v "$1" >/dev/null || skip "there is no $1"; }

# rms N OPTION…: RMS angle of the map with its materials, in r.json's figures; no texel of another material.
rms() {
  local n=$1
  shift
  succeeds burnish-quantize n.png --material ids.png -n "$n" "$@" -o x.exr --report r.json || return 1
  fits_schema quantize r.json || return 1
  [ "$("$BURNISH_FIXTURE" strays x.exr ids.png)" = 0 ] || { echo "texels have changed their material: $*"; return 1; }
  value rms_deg r.json
}

less() { awk "BEGIN { exit !($1 < $2) }" || { echo "$1 is not below $2"; return 1; }; }

@test "split by default; alpha and subcubes with every engine: no texel changes its material" {
  inputs
  succeeds burnish-quantize n.png --material ids.png -n 64 -o x.exr
  succeeds burnish-quantize n.png --material ids.png -n 64 --material-encoding split -o y.exr
  same_bytes x.exr y.exr
  for n in 4 64 500; do
    split=$(rms $n)
    for encoding in alpha subcubes; do
      for engine in spherical median-cut; do
        e=$(rms $n --material-encoding $encoding --engine $engine)
        less "0.95 * $split" "$e"
      done
      less "$(rms $n --material-encoding $encoding)" "1.5 * $split"
    done
  done
  if burnish-quantize n.png --engine imagequant -n 16 -o probe.exr 2>/dev/null; then
    for encoding in alpha subcubes; do rms 64 --material-encoding $encoding --engine imagequant; done
    refuses 5 "imagequant" burnish-quantize n.png --engine imagequant --material-encoding alpha -n 257 -o y.exr
  fi
  refuses 1 "expected split|alpha|subcubes" burnish-quantize n.png --material-encoding hue -o y.exr
  refuses 3 "--normals: expected at least one for each of the 4 materials in 'ids.png', got 3" \
    burnish-quantize n.png --material ids.png -n 3 --material-encoding alpha -o y.exr
}

@test "without materials there is one, opaque" {
  inputs
  for encoding in alpha subcubes; do
    succeeds burnish-quantize n.png -n 64 --material-encoding $encoding -o x.exr --emit-rgb rgb.png --report r.json
    fits_schema quantize r.json
  done
  succeeds burnish-quantize n.png -n 64 --material-encoding alpha -o x.exr --emit-rgb rgb.png
  [ "$("$BURNISH_FIXTURE" texel rgb.png 5 7 | cut -d' ' -f4)" = 1 ]
}

@test "subcubes hold at most 4 materials" {
  make_image normals 64 48 n.png
  make_image bumps 64 48 many.png
  refuses 5 "--material-encoding: subcubes holds at most 4 materials, not 195 as in 'many.png'" \
    burnish-quantize n.png --material many.png --material-encoding subcubes -o x.exr
  make_image ids 64 48 ids.png
  make_image colours 64 48 m.png
  refuses 5 "as in 'ids.png' and the others" burnish-quantize n.png m.png --material ids.png --material many.png \
    --material-encoding subcubes --output-dir q
  succeeds burnish-quantize n.png --material many.png --material-encoding alpha -o x.exr
  [ "$("$BURNISH_FIXTURE" strays x.exr many.png)" = 0 ]
}

@test "nothing is lost where every normal has room; a target is met" {
  inputs
  for encoding in alpha subcubes; do
    succeeds burnish-quantize n.png --material ids.png -n 65536 --material-encoding $encoding -o x.exr --report r.json
    [ "$(value lossless r.json)" = True ]
    succeeds burnish-quantize n.png --material ids.png --target-error 4 --material-encoding $encoding -o x.exr --report r.json
    less "$(value rms_deg r.json)" 4.0000001
  done
}

@test "--emit-rgb: the alphas, the subcubes" {
  inputs
  succeeds burnish-quantize n.png --material ids.png --material-encoding alpha -o x.exr --emit-rgb rgba.png --report r.json
  fits_schema quantize r.json
  [ "$("$BURNISH_FIXTURE" info rgba.png)" = "64 48 4 uint8" ]
  succeeds burnish-quantize n.png --material ids.png --material-encoding subcubes -o x.exr --emit-rgb rgb.png
  [ "$("$BURNISH_FIXTURE" info rgb.png)" = "64 48 3 uint8" ]
  "$BURNISH_FIXTURE" text rgb.png >rgb.ppm
  "$BURNISH_FIXTURE" texel rgba.png 0 0 16 0 32 0 48 0 >alphas
  "$BURNISH_FIXTURE" texel rgba.png $(for y in $(seq 0 47); do for x in $(seq 0 63); do echo $x $y; done; done) >rgba.txt
  "${PYTHON3:-python3}" - <<'PYTHON'
alphas = [round(float(line.split()[3]) * 255) for line in open("alphas")]
assert alphas == [255, 202, 149, 96], alphas
rgba = [[round(float(v) * 255) for v in line.split()] for line in open("rgba.txt")]
words = open("rgb.ppm").read().split()[4:]
bits = [(0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 0)]
for i, texel in enumerate(rgba):
    material = 4 * (i % 64) // 64
    assert texel[3] == alphas[material], (i, texel)
    expected = [c // 2 + 128 * b for c, b in zip(texel, bits[material])]
    got = [int(v) for v in words[3 * i:3 * i + 3]]
    assert got == expected, (i, texel, got, expected)
PYTHON
  refuses 1 "--emit-rgb needs --material-encoding alpha or subcubes" burnish-quantize n.png --material ids.png -o y.exr --emit-rgb rgb2.png
  refuses 5 "written as PNG" burnish-quantize n.png --material-encoding alpha -o y.exr --emit-rgb rgb.tif
  refuses 1 "is an input" burnish-quantize n.png --material-encoding alpha -o y.exr --emit-rgb n.png
  refuses 1 "twice" burnish-quantize n.png --material-encoding alpha -o y.png --emit-rgb y.png
}

@test "several maps: an image each by {stem}" {
  inputs
  make_image colours 64 48 m.png
  succeeds burnish-quantize n.png m.png --material ids.png --material-encoding subcubes --output-dir q --emit-rgb 'rgb_{stem}.png'
  [ -s rgb_n.png ]
  [ -s rgb_m.png ]
  refuses 1 "--emit-rgb: expected a name with {stem} for the images of 2 maps, got 'one.png'" \
    burnish-quantize n.png m.png --material-encoding alpha --output-dir two --emit-rgb one.png
}

@test "pngquant, there and back" {
  needs pngquant
  inputs
  split=$(rms 100)
  for encoding in alpha subcubes; do
    succeeds burnish-quantize n.png --material ids.png --mask mask.png --material-encoding $encoding -o x.exr --emit-rgb rgb.png
    pngquant --nofs --force --output q.png 100 rgb.png
    succeeds burnish-quantize n.png --material ids.png --material-encoding $encoding --palette q.png -o x.exr --report r.json
    fits_schema quantize r.json
    [ "$(value normals r.json)" -gt 80 ]
    [ "$(value normals r.json)" -le 100 ]
    [ "$("$BURNISH_FIXTURE" strays x.exr ids.png)" = 0 ]
    less "$(value rms_deg r.json)" "1.6 * $split"
  done
}

@test "pnmquant and pnmcolormap, there and back" {
  needs pnmquant
  needs pamtopng
  inputs
  split=$(rms 300)
  for encoding in alpha subcubes; do
    succeeds burnish-quantize n.png --material ids.png --material-encoding $encoding -o x.exr --emit-rgb rgb.png
    if [ $encoding = alpha ]; then pngtopam -alphapam rgb.png >rgb.pam; else pngtopam rgb.png >rgb.pam; fi
    pnmquant -nofs 300 rgb.pam 2>/dev/null | pamtopng >image.png
    pnmcolormap 300 rgb.pam 2>/dev/null | pamtopng >map.png
    for palette in image.png map.png; do
      succeeds burnish-quantize n.png --material ids.png --material-encoding $encoding --palette $palette -o x.exr --report r.json
      [ "$(value normals r.json)" -gt 200 ]
      [ "$("$BURNISH_FIXTURE" strays x.exr ids.png)" = 0 ]
      less "$(value rms_deg r.json)" "4 * $split"
    done
    [ "$(value normals r.json)" = 300 ]
  done
}

@test "palettes that do not fit the encoding" {
  inputs
  succeeds burnish-quantize n.png --material ids.png -n 64 -o own.png
  succeeds burnish-quantize n.png --material ids.png -n 64 -o own.exr
  refuses 3 "expected 4 channels" burnish-quantize n.png --material ids.png --material-encoding alpha --palette own.png -o x.exr
  refuses 3 "expected 4 channels" burnish-quantize n.png --material ids.png --material-encoding alpha --palette own.exr -o x.exr
  succeeds burnish-quantize n.png --material ids.png -n 64 -o own.ktx2 --palette-output p.exr
  succeeds burnish-quantize n.png --material ids.png -n 64 -o own.dds --palette-output p.png
  for encoding in alpha subcubes; do
    for palette in own.png own.exr own.ktx2 own.dds p.exr p.png; do
      refuses 3 "channels of a quantizer's colours, got a palette of normals" \
        burnish-quantize n.png --material ids.png --material-encoding $encoding --palette $palette -o x.exr
      grep -q "'$palette': .* leave --material-encoding out" err
    done
  done
  make_image rgba 400 400 noise.png
  refuses 3 "65536" burnish-quantize n.png --material ids.png --material-encoding alpha --palette noise.png -o x.exr
  make_image normals 8 8 deep.png uint16
  refuses 3 "uint8" burnish-quantize n.png --material ids.png --material-encoding subcubes --palette deep.png -o x.exr
  refuses 2 "'none.png'" burnish-quantize n.png --material-encoding subcubes --palette none.png -o x.exr
  make_image flat 8 8 grey.png
  refuses 3 "expected 3 channels" burnish-quantize n.png --material-encoding subcubes --palette grey.png -o x.exr
  # Of one material only: the first subcube.
  succeeds burnish-quantize n.png --material-encoding subcubes -o x.exr --emit-rgb one.png
  refuses 3 "'one.png': expected entries for material 1" burnish-quantize n.png --material ids.png --material-encoding subcubes --palette one.png -o y.exr
}

@test "the same bytes for any thread count" {
  inputs
  for encoding in alpha subcubes; do
    for engine in spherical median-cut; do
      succeeds burnish-quantize n.png --material ids.png -n 100 --material-encoding $encoding --engine $engine -o x.exr --emit-rgb a.png -j 1
      succeeds burnish-quantize n.png --material ids.png -n 100 --material-encoding $encoding --engine $engine -o y.exr --emit-rgb b.png -j 8
      same_bytes x.exr y.exr
      same_bytes a.png b.png
    done
  done
}

@test "an old output and image stay where anything fails" {
  inputs
  succeeds burnish-quantize n.png --material ids.png --material-encoding alpha -o x.png --emit-rgb rgb.png
  refuses 5 "uint16" burnish-quantize n.png --material ids.png --material-encoding alpha -n 16 -d uint16 -o x.png --emit-rgb rgb.png
}
