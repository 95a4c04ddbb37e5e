#!/usr/bin/env bats
# burnish-material: every option, and every way of using it wrongly. The arithmetic is tested in
# unit/material_bake_test.cpp.

load helpers

info() { "$BURNISH_FIXTURE" info "$1"; }
bake() { succeeds burnish-material "$@"; }
ward="--model ward --alpha-x 0.25 --alpha-y 0.5"
float="--encode float --extension exr -d float"

@test "numbers alone: one texel of each model, with its alpha, in both ranges" {
  bake $ward --ks 3.14159265 -o w --report r.json
  fits_schema material r.json
  [ "$(info w_t.png), $(info w_b.png), $(info w_n.png)" = "1 1 3 uint8, 1 1 3 uint8, 1 1 4 uint8" ]
  texel_is "1 0.501961 0.501961" w_t.png 0 0
  texel_is "0.501961 0.74902 0.501961" w_b.png 0 0
  texel_is "0.501961 0.501961 1 1" w_n.png 0 0
  [ "$(value scale r.json) $(value max_component r.json) $(value clamped_texels r.json)" = "0.25 4.0 0" ]
  bake $ward --ks 3.14159265 $float -o w --report r.json
  texel_is "4 0 0" w_t.exr 0 0
  texel_is "0 2 0" w_b.exr 0 0
  texel_is "0 0 1 1" w_n.exr 0 0
  [ "$(value scale r.json) $(value max_component r.json)" = "1.0 4.0" ]
  bake --model banks --ks 0.5 $float -o k
  texel_is "1 0 0 0.5" k_t.exr 0 0
  texel_is "0 1 0" k_b.exr 0 0
  texel_is "0 0 1" k_n.exr 0 0
  bake --model blinn-phong --alpha-x 0.25 --alpha-y 0.5 $float -o p
  texel_is "4 0 0 1" p_t.exr 0 0
  texel_is "0 2 0 0.25" p_b.exr 0 0
  bake --model blinn-phong --alpha-x 0.25 --alpha-y 0.5 --exponent 128 --ks 0.2 -o p
  texel_is "1 0.501961 0.501961 0.2" p_t.png 0 0
  texel_is "0.501961 0.74902 0.501961 1" p_b.png 0 0
}

@test "files say what their channels mean" {
  bake $ward --ks 3.14159265 --extension tif -o w
  grep -aqF '{"burnish:model":"ward","burnish:scale":[8.0,8.0,8.0],"burnish:bias":[-4.0,-4.0,-4.0]}' w_t.tif
  grep -aqF '"burnish:scale":[2.0,2.0,2.0,2.0],"burnish:bias":[-1.0,-1.0,-1.0,0.0],"burnish:alpha":"k_s/(4 pi alpha_x alpha_y)"' w_n.tif
  [ "$(info w_n.tif)" = "1 1 4 uint16" ]
  bake --model blinn-phong --alpha-x 0.25 --alpha-y 0.5 --extension exr -o p
  grep -aq 'burnish:model.*blinn-phong' p_b.exr
  for name in burnish:scale burnish:bias burnish:alpha; do grep -aqF $name p_b.exr; done
  [ "$(info p_b.exr)" = "1 1 4 half" ]
}

@test "--alpha-x and the others as maps, --angle, --direction and --normal: one size, the same from numbers" {
  make_image flat 9 7 a.exr float  # 0.25
  make_image normals 9 7 n.png
  bake --model ward --alpha-x 0.25 --alpha-y 0.5 --normal n.png $float --angle 30 -o number
  bake --model ward --alpha-x a.exr --alpha-y 0.5 --normal n.png $float --angle 30 -o map
  for which in t b n; do same_bytes number_$which.exr map_$which.exr; done
  [ "$(info map_t.exr)" = "9 7 3 float" ]
  bake --model blinn-phong --alpha-x 1 --alpha-y 1 --ks a.exr --exponent a.exr $float -o p
  texel_is "1 0 0 0.25" p_t.exr 3 3
  texel_is "0 1 0 0.001953125" p_b.exr 3 3
  # A quarter of a turn as a map, as degrees, as vectors.
  bake $ward --angle a.exr $float -o turn
  texel_is "0 4 0" turn_t.exr 3 3
  texel_is "-2 0 0" turn_b.exr 3 3
  bake $ward --angle 90 --normal n.png $float -o degrees
  bake $ward --angle a.exr --normal n.png $float -o turn
  same_pixels degrees_t.exr turn_t.exr 1e-6
  succeeds burnish-tangents a.exr --from angle --normal n.png -d float -o d.exr
  bake $ward --direction d.exr --normal n.png $float -o vectors
  same_pixels degrees_t.exr vectors_t.exr 1e-5
  same_pixels degrees_b.exr vectors_b.exr 1e-5
  refuses 1 "" burnish-material $ward --direction d.exr --angle 30 -o x
}

@test "integers and floats of every kind hold the same material" {
  make_image normals 16 12 n.png
  make_image flow 16 12 t.png
  for model in banks blinn-phong ward; do
    alphas="--alpha-x 0.3 --alpha-y 0.7"
    [ $model = banks ] && alphas=
    maps="--model $model $alphas --ks 0.8 --normal n.png --direction t.png"
    bake $maps $float -o f
    for case in "png uint8 0.003" "png uint16 1e-5" "tif uint8 0.003" "tif uint16 1e-5" "tif float 1e-6" "exr half 6e-4" "exr float 1e-6"; do
      read -r type sample tolerance <<<"$case"
      bake $maps --extension $type -d $sample -o c
      bake $maps --extension exr -d float -o e
      for which in t b n; do same_pixels c_$which.$type e_$which.exr $tolerance; done
    done
    bake $maps --encode float --extension exr -o h
    for which in t b n; do same_pixels h_$which.exr f_$which.exr 2e-3; done
  done
}

@test "--alpha-min and --clamp-alpha" {
  make_image slope-u 8 4 a.exr float  # 0, ⅛, ¼, …
  refuses 3 "'a.exr': expected a number above 0, got 0 at column 0, row 0" burnish-material --model ward --alpha-x a.exr --alpha-y 1 --clamp-alpha -o x
  make_image slope-v 8 4 b.exr float  # 1, ¾, ½, ¼
  bake --model ward --alpha-x b.exr --alpha-y 1 -o x
  rm x_*
  refuses 3 "'b.exr': expected at least 0.5 for the combiner range, got 0.25 at column 0, row 3" burnish-material --model ward --alpha-x b.exr --alpha-y 1 --alpha-min 0.5 -o x
  refuses 1 "--alpha-y: expected at least 0.25 for the combiner range, got 0.1" burnish-material --model ward --alpha-x 1 --alpha-y 0.1 -o x
  bake --model ward --alpha-x b.exr --alpha-y 1 --alpha-min 0.5 --clamp-alpha -o x --report r.json
  [ "$(value clamped_texels r.json) $(value scale r.json) $(value max_component r.json)" = "8 0.5 2.0" ]
  bake --model ward --alpha-x b.exr --alpha-y 1 --alpha-min 1 --clamp-alpha -o x --report r.json
  [ "$(value clamped_texels r.json)" = 24 ]
  texel_is "1 0.501961 0.501961" x_t.png 0 3
  refuses 1 "--alpha-min: expected 0.25|0.5|1, got '0.3'" burnish-material $ward --alpha-min 0.3 -o x
  refuses 1 "--clamp-alpha goes with --encode combiner" burnish-material $ward $float --clamp-alpha -o x
  refuses 1 "--alpha-min goes with --encode combiner" burnish-material $ward $float --alpha-min 0.5 -o x
}

@test "texels whose direction is along the normal are filled and counted; normals without length too" {
  make_image holed-normals 9 7 n.exr float
  make_image flow 9 7 t.png
  bake $ward --normal n.exr --direction t.png -o x --report r.json
  fits_schema material r.json
  [ "$(value degenerate_texels r.json) $(value invalid_normal_texels r.json)" = "1 1" ]
}

@test "--y, --normal-y, --encoding and --channels are those of the maps read" {
  make_image bumps 12 8 h.png
  make_image flow 12 8 t.png
  burnish-normals h.png --height 3 -o up.exr -d float
  burnish-normals h.png --height 3 -o down.exr -d float --y down
  burnish-normals h.png --height 3 -o biased.exr -d float --encoding biased
  bake $ward --angle 20 --normal up.exr $float -o up
  bake $ward --angle 20 --normal down.exr --y down $float -o down
  bake $ward --angle 20 --normal biased.exr --encoding biased $float -o biased
  bake $ward --angle 20 --normal up.exr --channels xy $float -o xy
  for which in t b n; do
    for other in down biased xy; do same_pixels up_$which.exr ${other}_$which.exr 1e-5; done
  done
  bake $ward --direction t.png --normal up.exr $float -o up
  bake $ward --direction t.png --normal down.exr --normal-y down $float -o down
  same_pixels up_t.exr down_t.exr 1e-6
}

@test "the same bytes on any number of threads, in any folder" {
  make_image normals 40 30 n.png
  make_image flow 40 30 t.png
  mkdir a
  bake $ward --normal n.png --direction t.png -o one -j 1
  bake $ward --normal n.png --direction t.png -o a/four -j 4
  for which in t b n; do same_bytes one_$which.png a/four_$which.png; done
}

@test "what the model does not use is warned of and not read" {
  call burnish-material --model banks --alpha-x missing.png --exponent 3 -o x
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-material: warning: --alpha-x is not used: banks has none
burnish-material: warning: --exponent is not used: banks has none" ]
  refuses 1 "--alpha-y is required by --model ward" burnish-material --model ward --alpha-x 1 -o x
  refuses 1 "--model" burnish-material -o x
}

@test "values out of range" {
  for bad in 0 -1 nan; do
    refuses 1 "--alpha-x: expected a number above 0, got $bad" burnish-material --model ward --alpha-x=$bad --alpha-y 1 -o x
  done
  refuses 1 "--ks: expected a number of at least 0, got -1" burnish-material $ward --ks=-1 -o x
  refuses 1 "--ks: expected at most 1 in uint8 samples, got 2" burnish-material --model banks --ks 2 -o x
  refuses 1 "--exponent: expected at most 128 in uint8 samples, got 200" burnish-material --model blinn-phong --alpha-x 1 --alpha-y 1 --exponent 200 -o x
  refuses 1 "--alpha-x: expected at least" burnish-material --model ward --alpha-x 1e-6 --alpha-y 1 --encode float --extension exr -o x
  refuses 1 "--alpha-x: expected a finite number above 0, got inf" burnish-material --model ward --alpha-x inf --alpha-y 1 -o x
  refuses 1 "--ks: expected a finite number of at least 0, got inf" burnish-material $ward --ks inf -o x
  for bad in 1e-50 1e50; do
    refuses 1 "--alpha-x: expected a number within single precision, got ${bad/e50/e+50}" burnish-material --model ward --alpha-x $bad --alpha-y 1 -o x
  done
  for bad in 0,5 1e400 0.5x; do
    refuses 2 "--alpha-x: expected a number or the file of a map, got '$bad'" burnish-material --model ward --alpha-x $bad --alpha-y 1 -o x
  done
  refuses 2 "--angle: expected a number or the file of a map, got '45deg'" burnish-material $ward --angle 45deg -o x
  refuses 1 "--angle: expected a number, got nan" burnish-material $ward --angle nan -o x
  make_image nan 9 7 nan.exr float
  refuses 3 "'nan.exr': expected a number above 0, got nan at column 4, row 3" burnish-material --model ward --alpha-x nan.exr --alpha-y 1 -o x
}

@test "maps and outputs that do not serve: each with its message, and nothing left behind" {
  make_image normals 9 7 n.png
  make_image flat 9 8 other.png
  refuses 3 "'n.png': expected 9x8 texels as in 'other.png', got 9x7" burnish-material --model ward --alpha-x other.png --alpha-y 1 --normal n.png -o x
  refuses 3 "'other.png': expected 3 channels" burnish-material $ward --direction other.png -o x
  refuses 2 "'missing.png'" burnish-material $ward --ks missing.png -o x
  refuses 1 "--output: expected a prefix of three files' names, got '-'" burnish-material $ward -o -
  refuses 2 "'nowhere/x_t.png'" burnish-material $ward -o nowhere/x
  refuses 1 "--encode: float needs half or float samples, which exr has, not uint8" burnish-material $ward --encode float -o x
  refuses 5 "half" burnish-material $ward -d half -o x
  refuses 1 "expected png|tif|exr, got 'tga'" burnish-material $ward --extension tga -o x
  refuses 1 "expected banks|blinn-phong|ward, got 'phong'" burnish-material --model phong -o x
  cp n.png m_n.png
  refuses 1 "'m_n.png': is an input" burnish-material $ward --normal m_n.png -o m
  refuses 1 "" burnish-material n.png $ward -o x
}

@test "--depfile names the first output and all that was read" {
  make_image normals 9 7 n.png
  make_image flat 9 7 a.exr float
  bake --model ward --alpha-x a.exr --alpha-y a.exr --normal n.png -o x --depfile x.d
  [ "$(cat x.d)" = "x_t.png: a.exr n.png" ]
}
