#!/usr/bin/env bats
# burnish-mipmap --kind material. What holds for all kinds is in mipmap.bats; the fit is tested in
# unit/material_lobe_test.cpp and unit/material_mips_test.cpp.

load helpers

info() { "$BURNISH_FIXTURE" info "$1"; }

# material MODEL [OPTION…]: textures of bumps at the prefix m.
material() {
  local alphas="--alpha-x 0.2 --alpha-y 0.4"
  [ "$1" != banks ] || alphas=
  make_image normals 32 24 n.png
  # shellcheck disable=SC2086
  succeeds burnish-material --model "$@" $alphas --normal n.png --angle 30 --ks 0.5 --encode float --extension exr -d float -o m
}

@test "every model: the textures, and the maps beside them, on every level" {
  for model in ward blinn-phong banks; do
    material $model
    succeeds burnish-mipmap m -o c -d float --report r.json
    fits_schema mipmap r.json
    for which in t b n; do
      same_pixels c_$which.exr m_$which.exr
      [ "$(info c_$which.exr)" = "$(info m_$which.exr)" ]
      grep -aq "burnish:model" c_$which.exr
    done
    [ "$(info c_direction.exr)" = "32 24 3 float" ]
    if [ $model = banks ]; then [ ! -e c_alpha.exr ]; else [ "$(info c_alpha.exr)" = "32 24 3 float" ]; fi
    rm c_*
    succeeds burnish-mipmap m --split 'l_%d' --report r.json
    fits_schema mipmap r.json
    [ "$(info l_3_t.exr)" = "4 3 $([ $model = ward ] && echo 3 || echo 4) half" ]
    [ -e l_5_direction.exr ]
    [ ! -e l_6_t.exr ]
    rm l_*
  done
}

@test "the base's alphas, k_s and directions are those that were baked" {
  material ward
  succeeds burnish-mipmap m -o c -d float
  texel_is "0.2 0.4 0.5" c_alpha.exr 5 7 1e-5
  "${PYTHON3:-python3}" - "$("$BURNISH_FIXTURE" texel m_t.exr 5 7)" "$("$BURNISH_FIXTURE" texel c_direction.exr 5 7)" <<'PYTHON'
import sys
t, d = (list(map(float, a.split())) for a in sys.argv[1:])
assert all(abs(a * 0.2 - b) < 1e-5 for a, b in zip(t, d)), (t, d)
PYTHON
}

@test "--khr: the wider axis, its strength, the roughness of the narrower" {
  succeeds burnish-material --model ward --alpha-x 0.25 --alpha-y 0.0625 --angle 90 --encode float --extension exr -d float -o m
  succeeds burnish-mipmap m -o c -d float --khr
  texel_is "0.5 1 0.447214" c_khr.exr 0 0 1e-5  # α_t = 0.0625 + 0.9375 · 0.2
  texel_is "0.25" c_roughness.exr 0 0 1e-5
  succeeds burnish-material --model ward --alpha-x 0.25 --alpha-y 1.5 --encode float --extension exr -d float -o m
  call burnish-mipmap m -o c -d float --khr
  [ "$status" -eq 0 ]
  grep -q 'warning: 1 texel with an alpha beyond 1, which KHR_materials_anisotropy cannot say' err
  texel_is "0.5 1 1" c_khr.exr 0 0 1e-5
  texel_is "0.5" c_roughness.exr 0 0 1e-5
  material banks
  refuses 5 "banks has no alpha" burnish-mipmap m -o c --khr
}

@test "--levels and --split" {
  material ward
  succeeds burnish-mipmap m --split 'l_%d.exr' --levels 3 -d float
  [ "$(info l_2_t.exr)" = "8 6 3 float" ]
  [ ! -e l_3_t.exr ]
  succeeds burnish-mipmap m -o one --levels 1 -d float
  same_bytes one_t.exr m_t.exr
  same_bytes one_n.exr m_n.exr
  refuses 5 "EXR holds one level or all 6, not 3" burnish-mipmap m -o c --levels 3
  refuses 1 "--levels: expected 1 to 6" burnish-mipmap m -o c --levels 7
  refuses 5 "written as EXR, not PNG" burnish-mipmap m --split 'l_%d.png'
  refuses 1 "--split" burnish-mipmap m --split 'l'
}

@test "a chain is made anew from a chain" {
  material ward
  succeeds burnish-mipmap m -o a -d float
  succeeds burnish-mipmap a -o b -d float
  for which in t b n alpha direction; do same_bytes a_$which.exr b_$which.exr; done
}

@test "wrong use" {
  material ward
  refuses 5 "uint8" burnish-mipmap m -o c -d uint8
  refuses 1 "PREFIX" burnish-mipmap m -o - --output-type exr
  refuses 1 "is an input" burnish-mipmap m -o m
  refuses 2 "'nowhere/c_t.exr'" burnish-mipmap m -o nowhere/c
  refuses 2 "'none_t.exr, .png or .tif'" burnish-mipmap none -o c --kind material
  cp m_t.exr s_t.exr
  refuses 2 "'s_b.exr, .png or .tif'" burnish-mipmap s -o c
  cp m_b.exr s_b.exr
  cp m_t.exr s_n.exr
  refuses 3 "'s_n.exr'" burnish-mipmap s -o c
  refuses 1 "--palette goes with --kind indexed" burnish-mipmap m -o c --palette n.png
}

@test "the same bytes for any thread count and folder, and what was read in the depfile" {
  make_image normals 61 45 n.png
  burnish-material --model ward --alpha-x 0.2 --alpha-y 0.4 --normal n.png --encode float --extension exr -o m
  succeeds burnish-mipmap m -o a -j 1 --depfile d
  [ "$(cat d)" = "a_t.exr: m_t.exr m_b.exr m_n.exr" ]
  mkdir b
  (cd b && succeeds burnish-mipmap ../m -o a -j 4)
  for which in t b n alpha direction; do same_bytes a_$which.exr b/a_$which.exr; done
}
