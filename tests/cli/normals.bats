#!/usr/bin/env bats
# burnish-normals: every option, and every way of using it wrongly. What holds for all tools is in every_tool.bats; that the
# planes are the right ones is tested in unit/height_map_test.cpp.

load helpers

@test "the defaults of each file type" {
  make_image bumps 20 10 h.tif
  while read -r file expected; do
    succeeds burnish-normals h.tif -o "$file"
    [ "$("$BURNISH_FIXTURE" info "$file")" = "20 10 3 $expected" ] || { "$BURNISH_FIXTURE" info "$file"; return 1; }
  done <<'TABLE'
x.png uint8
x.tga uint8
x.bmp uint8
x.tif uint16
x.tiff uint16
x.exr half
X.PNG uint8
TABLE
}

@test "-d and --format choose the samples" {
  make_image bumps 20 10 h.tif
  while read -r file format; do
    for flag in -d --format; do
      succeeds burnish-normals h.tif -o "$file" "$flag" "$format"
      [ "$("$BURNISH_FIXTURE" info "$file")" = "20 10 3 $format" ]
    done
  done <<'TABLE'
x.png uint16
x.tif uint8
x.tif float
x.exr float
TABLE
}

@test "heights of every type and sample" {
  make_image bumps 20 10 reference.exr float
  succeeds burnish-normals reference.exr -o reference_n.exr -d float --height 4
  while read -r file sample tolerance; do
    make_image bumps 20 10 "$file" "$sample"
    succeeds burnish-normals "$file" -o x.exr -d float --height 4
    same_pixels x.exr reference_n.exr "$tolerance"
  done <<'TABLE'
h.png uint8 0.02
h.png uint16 0.0001
h.tga uint8 0.02
h.bmp uint8 0.02
h.tif uint8 0.02
h.tif uint16 0.0001
h.tif float 0
h.exr half 0.005
h.exr float 0
TABLE
}

@test "plain PGM and PPM are heights too" {
  printf 'P2\n3 2\n255\n0 51 102\n0 51 102\n' >h.pgm
  succeeds burnish-normals h.pgm -o x.exr -d float --height 5
  [ "$("$BURNISH_FIXTURE" texel x.exr 1 0)" = "-0.707107 0 0.707107" ]
}

@test "a flat map is (128, 128, 255) in every eight-bit file" {
  make_image flat 5 4 h.png
  for ext in png tga bmp tif; do
    succeeds burnish-normals h.png -o x.$ext -d uint8
    [ "$("$BURNISH_FIXTURE" texel x.$ext 2 2)" = "0.501961 0.501961 1" ]
  done
  succeeds burnish-normals h.png -o x.exr
  [ "$("$BURNISH_FIXTURE" texel x.exr 2 2)" = "0 0 1" ]
}

@test "--height and --size take units, and mean the same in each" {
  make_image bumps 20 10 h.tif
  succeeds burnish-normals h.tif -o a.exr --height 0.1 --size 2
  for arguments in "--height 10cm --size 2m" "--height 100mm --size 200cm" "--height 0.1m --size 2mx1m" \
    "--height 1e-1 --size 2x1" "--height 10cm --size 2000mmx100cm"; do
    # shellcheck disable=SC2086
    succeeds burnish-normals h.tif -o b.exr $arguments
    same_bytes a.exr b.exr
  done
  succeeds burnish-normals h.tif -o b.exr --height 10cm --size 2mx2m
  ! same_pixels a.exr b.exr >/dev/null
  succeeds burnish-normals h.tif -o b.exr --height -10cm --size 2m
}

@test "a slope of one is 45 degrees in any units" {
  make_image slope-u 16 16 h.exr float
  for arguments in "--height 16" "--height 2m --size 2m" "--height 1cm --size 10mm"; do
    # shellcheck disable=SC2086
    succeeds burnish-normals h.exr -o x.exr -d float --report r.json $arguments
    [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "-0.707107 0 0.707107" ]
    [[ "$(value max_slope_deg r.json)" == 45.000* || "$(value max_slope_deg r.json)" == 44.999* ]]
  done
}

@test "junk for --height and --size is refused, never clamped" {
  make_image bumps 8 8 h.png
  for junk in nan inf -inf NAN junk 2km 2m2 1,5 0x 1e999 "" " " "2 m m"; do
    refuses 1 "--height" burnish-normals h.png -o x.png --height "$junk"
  done
  for junk in nan inf 0 -1 junk 2mx 2mx0 x2 2x-1 2x3x4 2km 2m,1m "" 0x2; do
    refuses 1 "--size" burnish-normals h.png -o x.png --size "$junk"
  done
}

@test "--neighbors takes five numbers and no other" {
  make_image bumps 24 24 h.tif
  for q in 4 8 24 48 80; do
    succeeds burnish-normals h.tif -o n$q.tif --neighbors $q
    for other in 4 8 24 48 80; do
      [ "$other" -ge "$q" ] || differ n$q.tif n$other.tif
    done
  done
  succeeds burnish-normals h.tif -o default.tif
  same_bytes default.tif n4.tif
  for junk in 0 3 5 9 25 81 120 -8 8.5 many; do
    refuses 1 "--neighbors" burnish-normals h.tif -o x.png --neighbors "$junk"
  done
}

@test "--weights" {
  make_image bumps 24 24 h.tif
  succeeds burnish-normals h.tif -o default.tif --neighbors 24
  succeeds burnish-normals h.tif -o uniform.tif --neighbors 24 --weights uniform
  succeeds burnish-normals h.tif -o gaussian.tif --neighbors 24 --weights gaussian
  same_bytes default.tif uniform.tif
  differ uniform.tif gaussian.tif
  refuses 1 "expected uniform|gaussian, got 'box'" burnish-normals h.tif -o x.png --weights box
}

@test "--wrap is both --wrap-u and --wrap-v, which go before it" {
  make_image bumps 24 24 h.tif
  for wrap in fit clamp repeat mirror; do
    succeeds burnish-normals h.tif -o both.tif --neighbors 24 --wrap $wrap
    succeeds burnish-normals h.tif -o each.tif --neighbors 24 --wrap-u $wrap --wrap-v $wrap
    same_bytes both.tif each.tif
    succeeds burnish-normals h.tif -o one.tif --neighbors 24 --wrap $wrap --wrap-u repeat
    succeeds burnish-normals h.tif -o two.tif --neighbors 24 --wrap-u repeat --wrap-v $wrap
    same_bytes one.tif two.tif
  done
  succeeds burnish-normals h.tif -o default.tif --neighbors 24
  succeeds burnish-normals h.tif -o fit.tif --neighbors 24 --wrap fit
  same_bytes default.tif fit.tif
  for flag in --wrap --wrap-u --wrap-v; do
    refuses 1 "expected fit|clamp|repeat|mirror, got 'around'" burnish-normals h.tif -o x.png $flag around
  done
}

@test "a repeated map has no seam: the normals of a shifted map are the shifted normals" {
  printf 'P2\n4 3\n255\n10 200 30 90\n70 20 160 240\n50 130 220 5\n' >a.pgm
  printf 'P2\n4 3\n255\n240 70 20 160\n5 50 130 220\n90 10 200 30\n' >b.pgm # right by one, up by one
  for q in 4 8 80; do
    succeeds burnish-normals a.pgm -o a.exr -d float --wrap repeat --neighbors $q
    succeeds burnish-normals b.pgm -o b.exr -d float --wrap repeat --neighbors $q
    here=() there=()
    for y in 0 1 2; do
      for x in 0 1 2 3; do
        here+=("$x" "$y") there+=($(((x + 1) % 4)) $(((y + 2) % 3)))
      done
    done
    "$BURNISH_FIXTURE" texel a.exr "${here[@]}" >a
    "$BURNISH_FIXTURE" texel b.exr "${there[@]}" >b
    cmp a b
  done
}

@test "--mask: what is 0 stores (0,0,1), takes no part, and may be NaN" {
  make_image nan 16 16 nan.exr
  make_image mask 16 16 m.png
  refuses 3 "got NaN or infinity at column 8, row 8 (--mask can exclude it)" burnish-normals nan.exr -o x.exr
  succeeds burnish-normals nan.exr -o x.exr --mask m.png --report r.json
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "0 0 1" ]
  [ "$("$BURNISH_FIXTURE" texel x.exr 0 0)" = "0 0 1" ]
  [ "$("$BURNISH_FIXTURE" texel x.exr 9 8)" != "0 0 1" ]
  [ "$(value degenerate_texels r.json)" = 0 ]
  make_image empty-mask 16 16 none.png
  succeeds burnish-normals nan.exr -o x.exr --mask none.png --report r.json
  [ "$(value mean_tilt_deg r.json)" = 0 ] || [ "$(value mean_tilt_deg r.json)" = 0.0 ]
}

@test "texels with no three points off a line are counted" {
  make_image noise 1 1 one.png
  make_image noise 7 1 row.png
  make_image noise 2 2 four.png
  for expected in "one 1" "row 7" "four 0"; do
    set -- $expected
    succeeds burnish-normals "$1.png" -o x.exr --report r.json
    [ "$(value degenerate_texels r.json)" = "$2" ]
  done
  succeeds burnish-normals row.png -o x.exr --report r.json --wrap-v clamp
  [ "$(value degenerate_texels r.json)" = 0 ]
}

@test "a mask of another size, or none" {
  make_image bumps 8 8 h.png
  make_image mask 8 9 m.png
  refuses 3 "'m.png': expected 8x8" burnish-normals h.png --mask m.png -o x.png
  refuses 2 "'no.png'" burnish-normals h.png --mask no.png -o x.png
  refuses 5 "" burnish-normals h.png --mask h.png -o x
}

@test "--mid-level changes no slope, and is a number" {
  make_image bumps 8 8 h.png
  succeeds burnish-normals h.png -o a.png
  succeeds burnish-normals h.png -o b.png --mid-level 0.5
  same_bytes a.png b.png
  refuses 1 "--mid-level" burnish-normals h.png -o x.png --mid-level half
  refuses 1 "mid-level" burnish-normals h.png -o x.png --mid-level nan
}

@test "--channel by name and number; differing colours get a warning" {
  make_image colours 12 8 rgb.png
  call burnish-normals rgb.png -o default.png
  [ "$status" -eq 0 ]
  grep -q "^burnish-normals: warning: 'rgb.png': colour channels differ" err
  for channel in 0 R r; do
    succeeds burnish-normals rgb.png -o x.png --channel $channel
    same_bytes x.png default.png
  done
  for channel in 2 B b; do
    succeeds burnish-normals rgb.png -o x.png --channel $channel
    differ x.png default.png
  done
  for wrong in 3 A Z -1 99999999999; do
    refuses 3 "channel" burnish-normals rgb.png -o x.png --channel "$wrong"
  done
  make_image grey 12 8 grey.png
  succeeds burnish-normals grey.png -o x.png
}

@test "--y down is the other green" {
  make_image bumps 12 8 h.tif
  succeeds burnish-normals h.tif -o up.exr -d float --y up
  succeeds burnish-normals h.tif -o default.exr -d float
  succeeds burnish-normals h.tif -o down.exr -d float --y down
  same_bytes up.exr default.exr
  read -r ux uy uz < <("$BURNISH_FIXTURE" texel up.exr 5 5)
  read -r dx dy dz < <("$BURNISH_FIXTURE" texel down.exr 5 5)
  [ "$ux $uz" = "$dx $dz" ]
  [ "${uy#-}" = "${dy#-}" ]
  [ "$uy" != "$dy" ]
  refuses 1 "expected up|down" burnish-normals h.tif -o x.png --y left
}

@test "--encoding" {
  make_image slope-u 16 16 h.exr float
  succeeds burnish-normals h.exr -o x.exr -d float --height 16 --encoding biased
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "0.146447 0.5 0.853553" ]
  succeeds burnish-normals h.exr -o x.exr -d float --height 16 --encoding signed
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "-0.707107 0 0.707107" ]
  refuses 5 "signed" burnish-normals h.exr -o x.png --encoding signed
  refuses 1 "expected biased|signed" burnish-normals h.exr -o x.png --encoding other
}

@test "alpha beside the height is no matter" {
  make_image rgba 12 8 h.png uint16
  call burnish-normals h.png -o x.exr -d float --channel R
  [ "$status" -eq 0 ]
  make_image noise 12 8 one.png uint16
  succeeds burnish-normals one.png -o y.exr -d float
  same_bytes x.exr y.exr
}

@test "the report holds its figures and fits the schema" {
  make_image slope-u 32 16 h.exr float
  succeeds burnish-normals h.exr -o x.exr --height 32 --report r.json
  fits_schema normals r.json
  [ "$(value width r.json) $(value height r.json) $(value degenerate_texels r.json)" = "32 16 0" ]
}

@test "maps one texel wide or high, of every wrap and neighbourhood" {
  for size in "1 1" "1 9" "9 1" "2 1"; do
    # shellcheck disable=SC2086
    make_image noise $size h.png
    for wrap in fit clamp repeat mirror; do
      succeeds burnish-normals h.png -o x.png --neighbors 80 --wrap $wrap
    done
  done
}

@test "a large map passes in little memory" {
  needs_bare_memory
  # 1000 × 30000 heights are 120 MB as floats, their normals 360 MB; bands need a few of their rows.
  make_image flat 1000 30000 h.png uint8
  "${PYTHON3:-python3}" - <<'PYTHON'
import resource, subprocess, sys
subprocess.run(["burnish-normals", "h.png", "-o", "x.png", "-j", "2"], check=True)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
print(f"{peak:.0f} MiB")
sys.exit(peak > 180)
PYTHON
}

@test "slopes beyond floating point are refused" {
  make_image bumps 8 8 h.png
  refuses 3 "'h.png': slopes are too steep" burnish-normals h.png -o x.exr --size 1e-100
  refuses 3 "'h.png': slopes are too steep" burnish-normals h.png -o x.png --height 1e200
}

# Two triangles over the unit square, which is the left half of the map.
half_square() {
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n'
}

@test "--mesh: object-space normals, in the mesh's units" {
  make_image slope-u 16 16 h.exr float
  # The square stands upright: u runs along x, v along z; so it faces −y. Heights rise by 1 over the map.
  printf 'v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n' >wall.obj
  succeeds burnish-normals h.exr -o x.exr -d float --mesh wall.obj --report r.json
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "-0.707107 -0.707107 0" ]
  fits_schema normals r.json
  [ "$(value covered_texels r.json) $(value overlapped_texels r.json) $(value degenerate_texels r.json)" = "256 0 0" ]
  [[ "$(value max_slope_deg r.json)" == 45.0* || "$(value max_slope_deg r.json)" == 44.999* ]]
  succeeds burnish-normals h.exr -o y.exr -d float --mesh wall.obj --space object
  same_bytes x.exr y.exr
  succeeds burnish-normals h.exr -o y.exr -d float --mesh wall.obj --height 50cm
  [ "$("$BURNISH_FIXTURE" texel y.exr 8 8)" = "-0.447214 -0.894427 0" ]
}

@test "--mesh: on a level square the same as without, but for what lies beyond" {
  make_image bumps 32 16 h.tif
  half_square | sed 's/vt 0.5/vt 1/' >square.obj
  succeeds burnish-normals h.tif -o mesh.exr -d float --mesh square.obj --height 0.3 --neighbors 24
  succeeds burnish-normals h.tif -o plain.exr -d float --size 1x1 --height 0.3 --neighbors 24
  same_pixels mesh.exr plain.exr 1e-6
}

@test "--mid-level matters on a mesh that bends" {
  make_image bumps 32 16 h.tif
  "$BURNISH_FIXTURE" mesh torus 8 m.obj
  succeeds burnish-normals h.tif -o a.exr -d float --mesh m.obj --height 0.2
  succeeds burnish-normals h.tif -o b.exr -d float --mesh m.obj --height 0.2 --mid-level 0.5
  differ a.exr b.exr
  succeeds burnish-normals h.tif -o flat.exr -d float --mesh m.obj --height 0 --mid-level 0.5
  succeeds burnish-normals h.tif -o flat2.exr -d float --mesh m.obj --height 0
  same_bytes flat.exr flat2.exr
}

@test "--mesh: faces without area are left out, with a warning" {
  make_image bumps 16 16 h.png
  half_square >half.obj
  { half_square; echo 'f 1/1 2/2 2/2'; } >more.obj
  succeeds burnish-normals h.png -o whole.exr --mesh half.obj
  call burnish-normals h.png -o n.exr --mesh more.obj
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-normals: warning: 'more.obj': 1 face without area is left out" ]
  same_bytes n.exr whole.exr
}

@test "--padding: gutters of the mesh's charts" {
  make_image slope-u 16 8 h.exr float
  half_square >half.obj
  for case in "0 8" "3 11"; do
    set -- $case
    succeeds burnish-normals h.exr -o x.exr -d float --mesh half.obj --padding "$1"
    [ "$("$BURNISH_FIXTURE" texel x.exr $(($2 - 1)) 4)" = "$("$BURNISH_FIXTURE" texel x.exr 7 4)" ]
    [ "$("$BURNISH_FIXTURE" texel x.exr "$2" 4)" = "0 0 1" ]
    [ "$("$BURNISH_FIXTURE" texel x.exr 7 4)" != "0 0 1" ]
  done
  for junk in -1 1.5 many; do refuses 1 "--padding" burnish-normals h.exr -o x.exr --mesh half.obj --padding $junk; done
  refuses 1 "--padding" burnish-normals h.exr -o x.exr --padding 3
}

@test "--mesh with --mask, --channel, --y, standard input and output, and any number of threads" {
  make_image nan 16 16 nan.exr float
  make_image mask 16 16 m.png
  half_square | sed 's/vt 0.5/vt 1/' >square.obj
  refuses 3 "got NaN or infinity at column 8, row 8 (--mask can exclude it)" burnish-normals nan.exr -o x.exr --mesh square.obj
  succeeds burnish-normals nan.exr -o x.exr --mesh square.obj --mask m.png --depfile x.d
  [ "$(cat x.d)" = "x.exr: nan.exr square.obj m.png" ]
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "0 0 1" ]
  # What is excluded holds the mesh's own normal, wherever that points.
  printf 'v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n' >wall.obj
  succeeds burnish-normals nan.exr -o x.exr --mesh wall.obj --mask m.png
  [ "$("$BURNISH_FIXTURE" texel x.exr 8 8)" = "0 -1 0" ]
  make_image colours 40 30 rgb.png
  call burnish-normals rgb.png -o a.exr --mesh square.obj -j 1
  [ "$status" -eq 0 ]
  grep -q "colour channels differ" err
  succeeds burnish-normals rgb.png -o b.exr --mesh square.obj --channel R -j 4
  same_bytes a.exr b.exr
  burnish-normals - -o - --output-type exr --mesh square.obj --channel 0 <rgb.png >c.exr
  same_bytes a.exr c.exr
  succeeds burnish-normals rgb.png -o down.exr --mesh square.obj --channel 0 --y down
  differ a.exr down.exr
}

@test "--mesh and --space used wrongly, and meshes that do not serve" {
  make_image bumps 8 8 h.png
  half_square >half.obj
  refuses 1 "--space object needs --mesh" burnish-normals h.png -o x.png --space object
  refuses 1 "--space tangent goes without --mesh" burnish-normals h.png -o x.png --space tangent --mesh half.obj
  refuses 1 "--space" burnish-normals h.png -o x.png --space world
  refuses 1 "--size" burnish-normals h.png -o x.png --mesh half.obj --size 2
  succeeds burnish-normals h.png -o a.png --space tangent
  succeeds burnish-normals h.png -o b.png
  same_bytes a.png b.png
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >no-uvs.obj
  refuses 3 "'no-uvs.obj': expected texture coordinates" burnish-normals h.png -o x.png --mesh no-uvs.obj
  half_square | sed 's/vt 0.5/vt 1.5/' >outside.obj
  refuses 3 "'outside.obj': expected texture coordinates in [0,1]" burnish-normals h.png -o x.png --mesh outside.obj
  half_square | sed 's/vt 0.5/vt 0/' >no-area.obj
  refuses 3 "'no-area.obj'" burnish-normals h.png -o x.png --mesh no-area.obj
  refuses 2 "'missing.obj'" burnish-normals h.png -o x.png --mesh missing.obj
  refuses 5 "'h.png'" burnish-normals h.png -o x.png --mesh h.png
  refuses 1 "is an input" burnish-normals h.png -o half.obj.png --mesh half.obj --report half.obj
  refuses 3 "'h.png': slopes are too steep" burnish-normals h.png -o x.png --mesh half.obj --height 1e300
  refuses 5 "signed" burnish-normals h.png -o x.png --mesh half.obj --encoding signed
  half_square | sed 's/vt 0.5/vt 1/; s/^f 1\/1 3.*/&\nf 1\/1 2\/2 3\/3/' >twice.obj
  call burnish-normals h.png -o x.png --mesh twice.obj
  [ "$status" -eq 0 ]
  grep -q "'twice.obj': 3[0-9] texels are covered by more than one triangle" err
}
