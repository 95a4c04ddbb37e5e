#!/usr/bin/env bats
# burnish-mipmap --kind normal. What holds for all kinds is in mipmap.bats; the arithmetic is tested in
# unit/normal_mips_test.cpp.

load helpers

info() { "$BURNISH_FIXTURE" info "$1"; }

@test "EXR holds the chain, half or float, PNG and TIFF a level a file" {
  make_image normals 64 48 n.png
  succeeds burnish-mipmap n.png -o m.exr --report r.json --split 'l_%d.png'
  fits_schema mipmap r.json
  [ "$(info m.exr)" = "64 48 3 half" ]
  [ "$(info l_0.png), $(info l_3.png), $(info l_6.png)" = "64 48 3 uint8, 8 6 3 uint8, 1 1 3 uint8" ]
  [ ! -e l_7.png ]
  succeeds burnish-mipmap n.png -o m.exr -d float
  [ "$(info m.exr)" = "64 48 3 float" ]
  succeeds burnish-mipmap n.png --split 'l_%02d.tif' --levels 3
  [ "$(info l_02.tif)" = "16 12 3 uint16" ]
  [ ! -e l_03.tif ]
  succeeds burnish-mipmap n.png -o one.png --levels 1
  succeeds burnish-mipmap one.png -o two.png --levels 1
  same_bytes one.png two.png
}

@test "rms_deg is what storing costs" {
  make_image normals 64 48 n.png
  below() {
    "${PYTHON3:-python3}" - "$@" <<'PYTHON'
import json, sys
all = [l["rms_deg"] for l in json.load(open(sys.argv[1]))["stats"]["levels"]]
assert len(all) == 7 and all[0] >= float(sys.argv[2]) and max(all) <= float(sys.argv[3]), all
PYTHON
  }
  succeeds burnish-mipmap n.png -o m.exr -d float --report r.json
  below r.json 0 1e-5
  succeeds burnish-mipmap n.png -o m.exr --report r.json
  below r.json 1e-3 0.02
  succeeds burnish-mipmap n.png --split 'l_%d.png' --report r.json
  below r.json 0.02 0.5
}

@test "two slopes: the mean, and a roughness that has what it lost" {
  # ±0.6 along u: the mean is 0.8 long, so that α² grows by 2 · 0.2/0.8.
  printf 'P3 2 1 5 4 3 5 1 3 5' >n.ppm  # 2·4/5 − 1 = 0.6, but z = 1, so that the length is not 1
  succeeds burnish-mipmap n.ppm -o m.exr -d float --roughness 0.3 --roughness-output a.exr --split 'l_%d.exr'
  [ "$(info a.exr)" = "2 1 1 float" ]
  succeeds burnish-mipmap n.ppm --split 'l_%d.exr' -d float --roughness 0.3 --roughness-output 'a_%d.exr'
  texel_is "0 0.196116 0.980581" l_1.exr 0 0  # (0, 0.2, 1)
  "${PYTHON3:-python3}" - "$("$BURNISH_FIXTURE" texel a_0.exr 0 0)" "$("$BURNISH_FIXTURE" texel a_1.exr 0 0)" <<'PYTHON'
import math, sys
base, got = map(float, sys.argv[1:])
length = math.hypot(0.2, 1) / math.hypot(0.6, 0.2, 1)
assert abs(base - 0.3) < 1e-6 and abs(got - math.sqrt(0.09 + 2 * (1 - length) / length)) < 1e-6, (base, got)
PYTHON
}

@test "--roughness as a map" {
  make_image normals 16 16 n.png
  make_image flat 16 16 a.exr float  # 0.25
  succeeds burnish-mipmap n.png -o m.exr --roughness a.exr --roughness-output map.exr --depfile d
  [ "$(cat d)" = "m.exr: n.png a.exr" ]
  succeeds burnish-mipmap n.png -o m.exr --roughness 0.25 --roughness-output number.exr
  same_bytes map.exr number.exr
  make_image flat 16 15 b.exr
  refuses 3 "'b.exr': expected 16x16 texels" burnish-mipmap n.png -o m.exr --roughness b.exr --roughness-output x.exr
  refuses 2 "'none.exr'" burnish-mipmap n.png -o m.exr --roughness none.exr --roughness-output x.exr
  for value in -1 nan inf; do
    refuses 1 "--roughness: expected alpha of at least 0" burnish-mipmap n.png -o m.exr --roughness=$value --roughness-output x.exr
  done
  refuses 1 "--roughness-output" burnish-mipmap n.png -o m.exr --roughness 0.2
  refuses 1 "--roughness" burnish-mipmap n.png -o m.exr --roughness-output x.exr
  refuses 5 "'x_0.png': uint8 holds alpha up to 1" burnish-mipmap n.png -o m.exr --roughness 1.5 --roughness-output 'x_%d.png'
  refuses 5 "a roughness map is written as EXR, PNG or TIFF" burnish-mipmap n.png -o m.exr --roughness 0.2 --roughness-output x.tga
  refuses 5 "PNG holds one level" burnish-mipmap n.png -o m.exr --roughness 0.2 --roughness-output x.png
  refuses 1 "twice" burnish-mipmap n.png -o m.exr --roughness 0.2 --roughness-output m.exr
}

@test "--y, --encoding and --channels: files of either kind have one chain" {
  make_image normals 32 32 n.png
  succeeds burnish-mipmap n.png -o up.exr -d float
  succeeds burnish-mipmap n.png -o biased.exr -d float --encoding biased
  succeeds burnish-mipmap biased.exr -o x.exr -d float --encoding biased
  same_pixels x.exr biased.exr 1e-6
  # Both greens turned about: the same vectors, stored the other way.
  succeeds burnish-mipmap n.png -o down.exr -d float --y down
  same_pixels down.exr up.exr 1e-6
  succeeds burnish-mipmap n.png -o xy.exr -d float --channels xy
  same_pixels xy.exr up.exr 0.01
  refuses 5 "signed encoding" burnish-mipmap n.png --split 'l_%d.png' --encoding signed
}

@test "the space that the map says is handed on" {
  make_image bumps 16 16 h.png
  burnish-normals h.png -o n.exr
  succeeds burnish-mipmap n.exr -o m.exr
  grep -aq 'burnish:space' m.exr
  make_image normals 16 16 plain.png
  succeeds burnish-mipmap plain.png -o m.exr
  if grep -aq 'burnish:space' m.exr; then return 1; fi
}

@test "what cannot be written or read" {
  make_image normals 16 12 n.png
  refuses 5 "'m.png': PNG holds one level, not 5" burnish-mipmap n.png -o m.png
  refuses 5 "EXR holds one level or all 5, not 3" burnish-mipmap n.png -o m.exr --levels 3
  refuses 1 "--levels: expected 1 to 5 for 16x12 texels, got 6" burnish-mipmap n.png -o m.exr --levels 6
  for type in ktx2 dds tga; do refuses 5 "a normal map is written as EXR, PNG or TIFF" burnish-mipmap n.png -o m.$type; done
  refuses 5 "uint8" burnish-mipmap n.png -o m.exr -d uint8
  refuses 1 "--split" burnish-mipmap n.png --split 'm.png'
  refuses 1 "is an input" burnish-mipmap n.png -o n.png --levels 1
  make_image nan 64 64 nan.exr
  refuses 3 "'nan.exr'" burnish-mipmap nan.exr -o m.exr --kind normal
  make_image ids 16 12 ids.png
  refuses 3 "3 channels" burnish-mipmap ids.png -o m.exr --kind normal
}

@test "pipelines through -, the same bytes for any thread count and folder" {
  make_image normals 301 205 n.png
  succeeds burnish-mipmap n.png -o a.exr -j 1 --roughness 0.2 --roughness-output ra.exr
  mkdir b
  (cd b && succeeds burnish-mipmap ../n.png -o b.exr -j 4 --roughness 0.2 --roughness-output rb.exr)
  same_bytes a.exr b/b.exr
  same_bytes ra.exr b/rb.exr
  burnish-mipmap - -o - --output-type exr <n.png | cmp - a.exr
}
