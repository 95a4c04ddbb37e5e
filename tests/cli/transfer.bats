#!/usr/bin/env bats
# burnish-transfer: every option, and every way of using it wrongly. That the right points are found is tested in
# unit/mesh_transfer_test.cpp.

load helpers

mesh() { "$BURNISH_FIXTURE" mesh "$@"; }

# Two triangles over the unit square at height $1, whose map is $2 times the unit square.
square() {
  cat <<OBJ
v 0 0 $1
v 1 0 $1
v 1 1 $1
v 0 1 $1
vt 0 0
vt $2 0
vt $2 $2
vt 0 $2
f 1/1 2/2 3/3
f 1/1 3/3 4/4
OBJ
}

sphere() {
  mesh sphere 5 low.obj
  mesh sphere 40 high.obj
}

@test "a sphere onto a coarser one: everything found, near the true normals" {
  sphere
  succeeds burnish-transfer low.obj high.obj -o n.exr -d float --size 64x32 --report r.json
  fits_schema transfer r.json
  [ "$("$BURNISH_FIXTURE" info n.exr)" = "64 32 3 float" ]
  [ "$(value missed_texels r.json)" = 0 ]
  [ "$(value overlapped_texels r.json)" = 0 ]
  # Row 16 of 32 is half a texel below the equator, column 0 half a texel beyond +z.
  read -r x y z < <("$BURNISH_FIXTURE" texel n.exr 0 16)
  "${PYTHON3:-python3}" -c 'import sys; x, y, z = map(float, sys.argv[1:]); assert abs(x - .049) < .01 and abs(y + .049) < .01 and z > .995, sys.argv' "$x" "$y" "$z"
}

@test "the defaults: 1024x1024, object space, the samples of the file's type" {
  sphere
  succeeds burnish-transfer low.obj high.obj -o n.png
  [ "$("$BURNISH_FIXTURE" info n.png)" = "1024 1024 3 uint8" ]
  succeeds burnish-transfer low.obj high.obj -o explicit.png --size 1024x1024 --space object --rays smooth --samples 2 --padding 16
  same_bytes n.png explicit.png
  succeeds burnish-transfer low.obj high.obj -o n.exr --size 16
  [ "$("$BURNISH_FIXTURE" info n.exr)" = "16 16 3 half" ]
}

@test "the same bytes on any number of threads, and to standard output" {
  sphere
  succeeds burnish-transfer low.obj high.obj -o one.exr --size 100x50 -j 1 --displacement d1.exr --mask-output m1.png
  succeeds burnish-transfer low.obj high.obj -o all.exr --size 100x50 -j 4 --displacement d4.exr --mask-output m4.png
  same_bytes one.exr all.exr
  same_bytes d1.exr d4.exr
  same_bytes m1.png m4.png
  burnish-transfer low.obj high.obj -o - --output-type exr --size 100x50 >stream.exr
  same_bytes one.exr stream.exr
}

@test "--space tangent: what lies level is (0,0,1), however it is turned in space" {
  printf 'v 0 0 0\nv 0 2 0\nv 0 2 2\nv 0 0 2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n' >low.obj
  printf 'v 0.1 0 0\nv 0.1 2 0\nv 0.1 2 2\nv 0.1 0 2\nf 1 2 3 4\n' >high.obj
  succeeds burnish-transfer low.obj high.obj -o t.exr --space tangent --size 8 -d float
  succeeds burnish-transfer low.obj high.obj -o o.exr --space object --size 8 -d float
  [ "$("$BURNISH_FIXTURE" texel t.exr 3 3)" = "0 0 1" ]
  [ "$("$BURNISH_FIXTURE" texel o.exr 3 3)" = "1 0 0" ]
  refuses 1 "expected object|tangent, got 'world'" burnish-transfer low.obj high.obj -o x.png --space world
}

@test "--displacement: distances as they are in EXR, about one half elsewhere, with scale and bias" {
  square 0 1 >low.obj
  square 0.125 1 >high.obj
  succeeds burnish-transfer low.obj high.obj -o n.png --size 4 --displacement d.exr
  [ "$("$BURNISH_FIXTURE" info d.exr)" = "4 4 1 float" ]
  [ "$("$BURNISH_FIXTURE" texel d.exr 1 1)" = "0.125" ]
  for type in png tif; do
    succeeds burnish-transfer low.obj high.obj -o n.png --size 4 --displacement d.$type
    [ "$("$BURNISH_FIXTURE" info d.$type)" = "4 4 1 uint16" ]
    [ "$("$BURNISH_FIXTURE" texel d.$type 1 1)" = "1" ]
    grep -aqF '{"burnish:scale":0.25,"burnish:bias":-0.125}' d.$type
  done
  succeeds burnish-transfer high.obj low.obj -o n.png --size 4 --displacement d.png
  [ "$("$BURNISH_FIXTURE" texel d.png 1 1)" = "0" ]
  refuses 5 "a displacement map is written as EXR, PNG or TIFF" burnish-transfer low.obj high.obj -o n.png --displacement d.tga
}

@test "--max-distance and --cage: how far inwards, and outwards" {
  square 0 1 >low.obj
  square 0.3 1 >above.obj
  square -0.3 1 >below.obj
  for case in "above 0.2 1 0" "above 0.4 0 0" "above 0 0.4 0" "above 0.2 0.2 1" "below 0.4 0 0" "below 0.2 0.4 1"; do
    set -- $case
    if [ "$4" = 1 ]; then
      within=$([ "$2" = "$3" ] && echo "$2" || echo "$2 (outwards $3)")
      refuses 3 "'$1.obj': expected a surface within $within of 'low.obj' that faces the same way, got none at any texel" \
        burnish-transfer low.obj "$1.obj" -o y.exr --size 4 --max-distance "$2" --cage "$3" --displacement d.png
      continue
    fi
    succeeds burnish-transfer low.obj "$1.obj" -o x.exr --size 4 --max-distance "$2" --cage "$3" --report r.json
    [ "$(value missed_texels r.json)" = 0 ] || { echo "$case"; cat r.json; return 1; }
  done
  refuses 3 "got none at any texel" burnish-transfer low.obj above.obj -o y.exr --size 4 --max-distance 0.2 -q
  for option in --max-distance --cage; do
    refuses 1 "${option#--}" burnish-transfer low.obj above.obj -o x.exr $option -1
    refuses 1 "${option#--}" burnish-transfer low.obj above.obj -o x.exr $option nan
    refuses 1 "$option" burnish-transfer low.obj above.obj -o x.exr $option far
  done
}

@test "the report's max_distance is never beyond the limit, and a surface at the limit has no holes" {
  # Heights and limits that binary fractions miss, and meshes whose corners do so too.
  for height in 0.1 0.3 0.7; do
    for low in 0 0.2 -5.3; do
      square $low 1 >low.obj
      square "$("${PYTHON3:-python3}" -c "print($low + $height)")" 1 >high.obj
      succeeds burnish-transfer low.obj high.obj -o x.exr --size 64 --max-distance $height --report r.json
      "${PYTHON3:-python3}" -c 'import sys; got, most = map(float, sys.argv[1:]); assert most - 1e-6 < got <= most, sys.argv' \
        "$(value max_distance r.json)" $height
      succeeds burnish-transfer high.obj low.obj -o x.exr --size 64 --max-distance $height --report r.json
      "${PYTHON3:-python3}" -c 'import sys; got, most = map(float, sys.argv[1:]); assert most - 1e-6 < got <= most, sys.argv' \
        "$(value max_distance r.json)" $height
    done
  done
  # A slope whose far side lies beyond, found just as far as the limit reaches.
  square 0 1 >low.obj
  printf 'v 0 0 0\nv 1 0 .3\nv 1 1 .3\nv 0 1 0\nf 1 2 3 4\n' >slope.obj
  for limit in 0.1 0.15 0.2000001 0.29; do
    call burnish-transfer low.obj slope.obj -o x.exr --size 64 --max-distance $limit --report r.json
    [ "$status" -eq 0 ]
    "${PYTHON3:-python3}" -c 'import sys; got, most = map(float, sys.argv[1:]); assert most - .005 < got <= most, sys.argv' \
      "$(value max_distance r.json)" $limit
  done
}

@test "what is missed is warned of, counted, masked, and keeps the coarse mesh's normal" {
  square 0 1 >low.obj
  square 0.1 1 | sed 's/^v 1 /v 0.5 /' >half.obj
  call burnish-transfer low.obj half.obj -o n.exr -d float --size 8 --samples 1 --max-distance 0.2 --mask-output m.png --report r.json
  [ "$status" -eq 0 ]
  [ "$(wc -l <err)" -eq 1 ]
  grep -qF "burnish-transfer: warning: 24 of 64 covered texels (37.5 %) found no detail of 'half.obj'" err
  [ "$(value covered_texels r.json) $(value missed_texels r.json)" = "64 24" ]
  [ "$("$BURNISH_FIXTURE" texel m.png 0 4 5 4 6 4 7 4 | tr '\n' ' ')" = "1 0 0 0 " ]
  [ "$("$BURNISH_FIXTURE" texel n.exr 7 4)" = "0 0 1" ]
  succeeds burnish-transfer low.obj half.obj -o q.exr -d float --size 8 --samples 1 --max-distance 0.2 -q
  same_bytes n.exr q.exr
}

@test "--padding: gutters round a chart, and none in the mask" {
  square 0 0.5 >low.obj
  printf 'v 0 0 0.1\nv 1 0 0.2\nv 1 1 0.2\nv 0 1 0.1\nf 1 2 3 4\n' >high.obj
  for case in "0 0 1" "3 -0.0995037 0 0.995037"; do
    set -- $case
    succeeds burnish-transfer low.obj high.obj -o n.exr -d float --size 16 --padding "$1" --mask-output m.png --max-distance 1
    [ "$("$BURNISH_FIXTURE" texel n.exr 10 12)" = "$([ "$1" = 0 ] && echo "0 0 1" || echo "-0.0995037 0 0.995037")" ]
    [ "$("$BURNISH_FIXTURE" texel n.exr 11 12)" = "0 0 1" ]
    [ "$("$BURNISH_FIXTURE" texel m.png 7 12 8 12 | tr '\n' ' ')" = "1 0 " ]
  done
  for junk in -1 1.5 many 99999999; do refuses 1 "--padding" burnish-transfer low.obj high.obj -o x.png --padding $junk; done
}

@test "--samples and --rays" {
  mesh torus 4 low.obj
  mesh torus 24 high.obj
  for n in 1 2 4; do succeeds burnish-transfer low.obj high.obj -o n$n.exr --size 48 --samples $n; done
  differ n1.exr n2.exr
  differ n2.exr n4.exr
  same_pixels n2.exr n4.exr 0.2
  succeeds burnish-transfer low.obj high.obj -o halfway.exr --size 48 --rays halfway
  differ n2.exr halfway.exr
  for junk in 0 17 1.5 all; do refuses 1 "--samples" burnish-transfer low.obj high.obj -o x.png --samples $junk; done
  refuses 1 "expected smooth|halfway, got 'up'" burnish-transfer low.obj high.obj -o x.png --rays up
}

@test "junk for --size is refused" {
  sphere
  for junk in 0 -1 1024x 0x5 5x0 x5 1.5 1024x512x2 big "" 99999999999 10cm; do
    refuses 1 "--size" burnish-transfer low.obj high.obj -o x.png --size "$junk"
  done
  refuses 1 "size: expected 1 to 131072" burnish-transfer low.obj high.obj -o x.png --size 200000x1
}

@test "--y, --encoding and -d as everywhere" {
  sphere
  succeeds burnish-transfer low.obj high.obj -o up.exr --size 32 -d float
  succeeds burnish-transfer low.obj high.obj -o down.exr --size 32 -d float --y down
  read -r ux uy uz < <("$BURNISH_FIXTURE" texel up.exr 5 5)
  read -r dx dy dz < <("$BURNISH_FIXTURE" texel down.exr 5 5)
  [ "$ux $uz ${uy#-}" = "$dx $dz ${dy#-}" ]
  [ "$uy" != "$dy" ]
  succeeds burnish-transfer low.obj high.obj -o biased.exr --size 32 -d float --encoding biased
  refuses 5 "signed" burnish-transfer low.obj high.obj -o x.png --encoding signed
  refuses 5 "half" burnish-transfer low.obj high.obj -o x.png -d half
  refuses 5 "'.gif'" burnish-transfer low.obj high.obj -o x.gif
}

@test "meshes that overlap themselves in the map get a warning" {
  square 0 1 >low.obj
  square 1 1 | grep '^v ' >>low.obj
  printf 'f 5/1 6/2 7/3\n' >>low.obj
  square 0 1 >high.obj
  call burnish-transfer low.obj high.obj -o x.png --size 8 --report r.json
  [ "$status" -eq 0 ]
  grep -qF "'low.obj': $(value overlapped_texels r.json) texels are covered by more than one triangle" err
}

@test "faces without area are left out of either mesh, with a warning" {
  square 0 1 >low.obj
  square 0.1 1 >high.obj
  succeeds burnish-transfer low.obj high.obj -o whole.exr --size 8
  echo 'f 1/1 2/2 1/1' >>low.obj
  printf 'f 1/1 1/1 2/2\nf 3/3 4/4 3/3\n' >>high.obj
  call burnish-transfer low.obj high.obj -o n.exr --size 8
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-transfer: warning: 'low.obj': 1 face without area is left out
burnish-transfer: warning: 'high.obj': 2 faces without area are left out" ]
  same_bytes n.exr whole.exr
  succeeds burnish-transfer low.obj high.obj -o n.exr --size 8 -q
}

@test "meshes that do not serve: each with its message, and nothing left behind" {
  square 0 1 >good.obj
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >no-uvs.obj
  square 0 1.5 >outside.obj
  square 0 0 >no-area.obj
  square nan 1 >nan.obj
  : >empty.obj
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >no-faces.obj
  printf 'v 0 0 0\nv 1 0 0\nf 1 2 3\n' >dangling.obj
  mkdir dir.obj
  refuses 3 "'no-uvs.obj': expected texture coordinates, which place the detail in a map (burnish-simplify --atlas makes some)" \
    burnish-transfer no-uvs.obj good.obj -o x.png
  refuses 3 "'outside.obj': expected texture coordinates in [0,1], got (1.5" burnish-transfer outside.obj good.obj -o x.png
  refuses 3 "'no-area.obj': expected triangles with area in the map" burnish-transfer no-area.obj good.obj -o x.png
  for bad in nan empty no-faces dangling; do
    refuses 3 "'$bad.obj'" burnish-transfer $bad.obj good.obj -o x.png
    refuses 3 "'$bad.obj'" burnish-transfer good.obj $bad.obj -o x.png
  done
  refuses 2 "'dir.obj'" burnish-transfer dir.obj good.obj -o x.png
  refuses 2 "'missing.obj'" burnish-transfer good.obj missing.obj -o x.png
  refuses 5 "'good.fbx'" burnish-transfer good.fbx good.obj -o x.png
  refuses 1 "HIGH" burnish-transfer good.obj -o x.png
  refuses 1 "" burnish-transfer good.obj good.obj third.obj -o x.png
}

@test "outputs: none that is an input, none named twice, all or nothing" {
  square 0 1 >low.obj
  square 0.1 1 >high.obj
  refuses 1 "twice" burnish-transfer low.obj high.obj -o x.png --mask-output x.png
  refuses 1 "twice" burnish-transfer low.obj high.obj -o x.exr --displacement ./x.exr
  refuses 2 "'nowhere/m.png'" burnish-transfer low.obj high.obj -o x.png --mask-output nowhere/m.png
  refuses 5 "'m.gif'" burnish-transfer low.obj high.obj -o x.png --mask-output m.gif
  refuses 5 "'low.obj'" burnish-transfer low.obj high.obj -o x.png --displacement low.obj
  refuses 5 "a mask is written as" burnish-transfer low.obj high.obj -o x.png --mask-output m.ktx2
  succeeds burnish-transfer low.obj high.obj -o x.png --size 8 --mask-output m.png --displacement d.exr --depfile x.d --report r.json
  [ "$(cat x.d)" = "x.png: low.obj high.obj" ]
  fits_schema transfer r.json
}
