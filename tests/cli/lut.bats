#!/usr/bin/env bats
# burnish-lut: every option, and every way of using it wrongly. That tables hold their functions, and err as they say, is
# tested in unit/brdf_tables_test.cpp, their files in unit/brdf_table_file_test.cpp and unit/brdf_table_c_header_test.cpp.

load helpers

teardown() {
  if mountpoint -q "$BATS_TEST_TMPDIR/disk" 2>/dev/null; then umount "$BATS_TEST_TMPDIR/disk"; fi
}

info() { "$BURNISH_FIXTURE" info "$@"; }
texel() { "$BURNISH_FIXTURE" texel "$@"; }

# attribute NAME FILE: of a PNG or TIFF, as it is written in the JSON of the description.
attribute() { grep -aoE "\"burnish:$1\":(\"[^\"]*\"|\[[^]]*\]|\{[^}]*\}|[^,}]*)" "$2" | head -1 | cut -d: -f3-; }

@test "every function: its default size and channels, and a report" {
  for case in "banks-r 256 1 1" "blinn-phong-f 256 256 1" "ward-s 256 1 1" "ward-e 256 256 1" "strand 256 256 4" \
    "light-factor 256 1 3"; do
    set -- $case
    succeeds burnish-lut "$1" -o t.exr --report r.json
    [ "$(info t.exr)" = "$2 $3 $4 half" ]
    fits_schema lut r.json
    [ "$(value width r.json) $(value height r.json)" = "$2 $3" ]
    succeeds burnish-lut "$1" -o t.png
    [ "$(info t.png)" = "$2 $3 $4 uint8" ]
    [ "$(attribute function t.png)" = "\"$1\"" ]
  done
}

@test "--size and --domain: rows run over the second argument, row 0 its low end, both ends exact" {
  succeeds burnish-lut banks-r -o t.exr -d float --size 5
  [ "$(texel t.exr 0 0 3 0 4 0 | tr '\n' ' ')" = "1 0.5 0 " ]
  succeeds burnish-lut ward-s -o t.exr -d float --size 2 --domain 0.25:1
  [ "$(texel t.exr 0 0 1 0 | tr '\n' ' ')" = "2 1 " ]
  succeeds burnish-lut blinn-phong-f -o t.exr -d float --size 2x3 --domain 2:4,0:1
  [ "$(texel t.exr 0 0 0 1 1 1 1 2 | tr '\n' ' ')" = "0 0.5 0.25 1 " ]
  succeeds burnish-lut ward-e -o t.exr -d float --size 2 --domain 0:1,-0.5:0
  [ "$(info t.exr)" = "2 2 1 float" ]
  [ "$(texel t.exr 0 0 1 0 0 1 1 1 | tr '\n' ' ')" = "1 0.0183156 1 0.135335 " ]
  succeeds burnish-lut strand -o t.exr -d float --size 3
  [ "$(texel t.exr 0 0 1 1 2 0 | tr '\n' ' ')" = "0 0 0 0 1 1 1 1 0 0 0 1 " ]
  succeeds burnish-lut light-factor -o t.exr -d float --size 3 --domain=-1:1
  [ "$(texel t.exr 0 0 1 0 2 0 | tr '\n' ' ')" = "0.1 0.1 0.1 0.1 0.1 0.1 1 1 1 " ]
}

@test "--sampling centre: half a texel inside" {
  succeeds burnish-lut banks-r -o t.exr -d float --size 2 --sampling centre --domain 0:1
  [ "$(texel t.exr 0 0 1 0 | tr '\n' ' ')" = "0.866025 0.5 " ]
  succeeds burnish-lut banks-r -o edge.exr
  succeeds burnish-lut banks-r -o default.exr --sampling edge
  same_bytes edge.exr default.exr
}

@test "--max-error: the smallest power of two that errs no more, as stored" {
  succeeds burnish-lut banks-r -o t.exr -d float --max-error 0.02 --report r.json
  [ "$(info t.exr)" = "256 1 1 float" ]
  "${PYTHON3:-python3}" -c 'import sys; assert .0156 < float(sys.argv[1]) < .0158' "$(value max_abs_error r.json)"
  succeeds burnish-lut ward-e -o t.png --max-error 0.01 --report r.json
  "${PYTHON3:-python3}" -c 'import sys; assert .002 < float(sys.argv[1]) <= .01' "$(value max_abs_error r.json)"
  refuses 1 "--max-error: no table of up to 2^22 texels errs by at most 1e-04" \
    burnish-lut banks-r -o x.png --max-error 1e-4
  for junk in 0 -1 nan; do
    refuses 1 "--max-error: expected a number above 0, got $junk" burnish-lut banks-r -o x.exr --max-error $junk
  done
  refuses 1 "--max-error: expected a number, got 'little'" burnish-lut banks-r -o x.exr --max-error little
  refuses 1 "excludes" burnish-lut banks-r -o x.exr --max-error 0.1 --size 16
}

@test "PNG and TIFF hold value / scale, and all that a lookup needs" {
  succeeds burnish-lut ward-s -o t.png --size 2 --domain 0.25:1
  [ "$(texel t.png 0 0 1 0 | tr '\n' ' ')" = "1 0.501961 " ]
  succeeds burnish-lut ward-s -o t.tif --size 2 --domain 0.25:1
  [ "$(info t.tif)" = "2 1 1 uint16" ]
  [ "$(attribute scale t.png) $(attribute scale t.tif)" = "2.0 2.0" ]
  for ext in png tif h; do
    succeeds burnish-lut ward-s -o t2.$ext -d uint16 --size 2 --domain 0.25:1 --report r.json
    fits_schema lut r.json
    [ "$(value scale r.json)" = 2.0 ]
  done
  succeeds burnish-lut ward-s -o t.exr --report r.json
  if grep -q '"scale"' r.json; then return 1; fi
  [ "$(attribute domain t.png)" = "[0.25,1.0]" ]
  [ "$(attribute sampling t.png) $(attribute layout t.png)" = '"edge" "plain"' ]
  succeeds burnish-lut strand -o t.png --exponent 50 --layout cube-z --size 8
  [ "$(attribute parameters t.png)" = '{"exponent":50.0}' ]
  [ "$(attribute sampling t.png) $(attribute layout t.png)" = '"centre" "cube-z"' ]
  succeeds burnish-lut light-factor -o t.png --light 2,1,0.5 --size 8
  [ "$(attribute parameters t.png)" = '{"light":[2.0,1.0,0.5],"ambient":0.1,"transition":0.25}' ]
  [ "$(attribute scale t.png)" = "[2.0,2.0,2.0]" ]
  succeeds burnish-lut banks-r -o t.tif -d float
  [ -z "$(attribute scale t.tif)" ]
}

@test "EXR says the same in attributes of its own" {
  succeeds burnish-lut strand -o t.exr --size 8
  for text in burnish:function burnish:domain burnish:sampling burnish:layout burnish:parameters '{"exponent":16.0}'; do
    grep -aqF "$text" t.exr || { echo "no $text"; return 1; }
  done
  [ "$(grep -aoF floatvector t.exr | wc -l)" -eq 1 ]  # the domain
}

# The numbers of a header's array, a line each, as a program has them that includes it.
numbers_of_header() {
  cat >print.c <<C
#include "$1"
#include <stdio.h>
int main(void) {
  for (int i = 0; i < $2_width * $2_height * $2_channels; i++) printf("%.9g\n", (double)$2[i]);
  return 0;
}
C
  cc -std=c99 -pedantic -Wall -Wextra -Werror print.c -o print && c++ -x c++ -Wall -Wextra -Werror print.c -o print++
  ./print >c.txt
  ./print++ | cmp - c.txt
  cat c.txt
}

@test "a C header compiles, and holds what the images hold" {
  command -v cc >/dev/null && command -v c++ >/dev/null || skip "there is no compiler"
  succeeds burnish-lut ward-e -o t.h --size 9x5 --report r.json
  fits_schema lut r.json
  [ "$(value height r.json)" = 5 ]
  succeeds burnish-lut ward-e -o t.exr -d float --size 9x5
  numbers_of_header t.h burnish_ward_e >header.txt
  [ "$(wc -l <header.txt)" -eq 45 ]
  [ "$(sed -n 15p header.txt | xargs printf %.6g)" = "$(texel t.exr 5 1)" ]
  succeeds burnish-lut strand -o t.h -d uint8 --size 5
  succeeds burnish-lut strand -o t.png --size 5
  numbers_of_header t.h burnish_strand >header.txt
  [ "$(sed -n '29,32p' header.txt | tr '\n' ' ')" = "$(texel t.png 2 1 | awk '{ for (i = 1; i < 5; i++) printf "%d ", $i * 255 + .5 }')" ]
  succeeds burnish-lut banks-r -o t.h -d half --size 5
  [ "$(numbers_of_header t.h burnish_banks_r | tr '\n' ' ')" = "15360 15086 14760 14336 0 " ]
  refuses 1 "--output-type png is for standard output" burnish-lut strand -o x.h --output-type png
}

@test "TGA and BMP hold a table's texels where no scale is to be recorded" {
  for type in tga bmp; do
    for function in banks-r strand light-factor; do
      succeeds burnish-lut $function -o t.$type
      succeeds burnish-lut $function -o t.png
      same_pixels t.$type t.png 0
    done
    refuses 5 "'x.$type': the table is stored divided by its largest value, 10, which" burnish-lut ward-s -o x.$type
  done
  refuses 5 "use PNG, TIFF or EXR" burnish-lut light-factor --light 2,1,1 -o x.tga
}

@test "--layout: shifted by half, and as a face of a cube map" {
  succeeds burnish-lut strand -o plain.exr -d float --size 8x4 --sampling centre --exponent 50
  succeeds burnish-lut strand -o half.exr -d float --size 8x4 --layout offset-half --exponent 50 --report half.json
  succeeds burnish-lut strand -o cube.exr -d float --size 8x4 --layout cube-z --exponent 50 --report cube.json
  [ "$(texel half.exr 4 2 7 3 0 0 1 3)" = "$(texel plain.exr 0 0 3 1 4 2 5 1)" ]
  [ "$(texel cube.exr 0 0 3 1 7 3)" = "$(texel plain.exr 0 3 3 2 7 0)" ]
  fits_schema lut half.json cube.json
  # The corners (1,-1) and (-1,1) hold 1, the other two 0: a repeat filter has the mean of all four there.
  "${PYTHON3:-python3}" -c 'import sys; a, b = map(float, sys.argv[1:]); assert .45 < a <= b' \
    "$(value wrap_error half.json)" "$(value max_abs_error half.json)"
  if grep -q wrap_error cube.json; then return 1; fi
  refuses 1 "--sampling: the layout cube-z needs centre, got edge" \
    burnish-lut strand -o x.exr --layout cube-z --sampling edge
  refuses 1 "--size: the layout offset-half needs an even width, got 15" \
    burnish-lut strand -o x.exr --layout offset-half --size 15
  for layout in offset-half cube-z; do
    refuses 1 "--domain: the layout $layout needs -1:1,-1:1, got 0:1,-1:1" \
      burnish-lut strand -o x.exr --layout $layout --domain 0:1,-1:1
  done
  succeeds burnish-lut strand -o half.exr --max-error 0.2 --layout offset-half --report half.json
  "${PYTHON3:-python3}" -c 'import sys; n, wrap = map(float, sys.argv[1:]); assert n < 256 and wrap > .4' \
    "$(value width half.json)" "$(value wrap_error half.json)"
  refuses 1 "expected plain|offset-half|cube-z, got 'cube'" burnish-lut strand -o x.exr --layout cube
}

@test "--approximate: 1 - s, its errors against the root" {
  succeeds burnish-lut banks-r -o t.exr -d float --size 5 --approximate --report r.json
  [ "$(texel t.exr 0 0 3 0 4 0 | tr '\n' ' ')" = "1 0.25 0 " ]
  [ "$(value max_abs_error r.json)" = 0.25 ]
  refuses 1 "excludes" burnish-lut banks-r -o x.exr --approximate --max-error 0.3
}

@test "--light, --ambient and --transition" {
  succeeds burnish-lut light-factor -o t.exr -d float --size 5 --light 2,1,0 --ambient 0.5 --transition 1
  [ "$(texel t.exr 2 0 3 0 4 0 | tr '\n' ' ')" = "0.5 0.5 0.5 1.25 0.75 0.25 2 1 0 " ]
  succeeds burnish-lut light-factor -o t.exr -d float --size 5 --transition 0
  [ "$(texel t.exr 2 0 3 0 | tr '\n' ' ')" = "0.1 0.1 0.1 1 1 1 " ]
  for junk in 1 1,2 1,2,3,4 1,,1 red "" 1:1:1; do
    refuses 1 "--light: expected a colour such as 1,0.9,0.8, got '$junk'" \
      burnish-lut light-factor -o x.exr --light "$junk"
  done
  refuses 1 "--light: expected at least 0, got -1" burnish-lut light-factor -o x.exr --light 1,-1,1
  refuses 1 "--light: expected at least 0, got nan" burnish-lut light-factor -o x.exr --light nan,1,1
  refuses 1 "--ambient: expected at least 0, got inf" burnish-lut light-factor -o x.exr --ambient inf
  refuses 1 "--transition: expected at least 0, got -0.1" burnish-lut light-factor -o x.exr --transition -0.1
  refuses 1 "--transition: expected a number, got 'soft'" burnish-lut light-factor -o x.exr --transition soft
}

@test "options of one function are refused with another" {
  refuses 1 "--exponent is for strand, not for ward-s" burnish-lut ward-s -o x.exr --exponent 16
  refuses 1 "--layout is for strand, not for ward-e" burnish-lut ward-e -o x.exr --layout plain
  refuses 1 "--approximate is for banks-r, not for strand" burnish-lut strand -o x.exr --approximate
  for option in "--light 1,1,1" "--ambient 0.1" "--transition 0.25"; do
    refuses 1 "${option% *} is for light-factor, not for banks-r" burnish-lut banks-r -o x.exr $option
  done
  for junk in 0 -1 nan inf; do
    refuses 1 "--exponent: expected a number above 0, got $junk" burnish-lut strand -o x.exr --exponent $junk
  done
}

@test "domains that cross a singularity, or are none, are refused" {
  refuses 1 "--domain: ward-s, p: expected more than 0, got 0:1" burnish-lut ward-s -o x.exr --domain 0:1
  refuses 1 "--domain: ward-e, d: expected more than -1, got -1:1" burnish-lut ward-e -o x.exr --domain 0:16,-1:1
  refuses 1 "--domain: ward-e, m: expected at least 0, got -1:16" burnish-lut ward-e -o x.exr --domain -1:16,0:1
  refuses 1 "--domain: banks-r, s: expected at most 1, got 0:1.5" burnish-lut banks-r -o x.exr --domain 0:1.5
  refuses 1 "--domain: blinn-phong-f, e: expected at least 0" burnish-lut blinn-phong-f -o x.exr --domain 1:128,-1:1
  refuses 1 "--domain: strand, L·T: expected from -1 to 1" burnish-lut strand -o x.exr --domain -2:1,-1:1
  refuses 1 "expected two numbers, the lower first, got 1:0.5" burnish-lut ward-s -o x.exr --domain 1:0.5
  refuses 1 "expected two numbers, the lower first, got 1:1" burnish-lut ward-s -o x.exr --domain 1:1
  refuses 1 "expected two numbers, the lower first, got nan:1" burnish-lut ward-s -o x.exr --domain nan:1
  refuses 1 "expected two numbers, the lower first, got 0.1:inf" burnish-lut ward-s -o x.exr --domain 0.1:inf
  refuses 1 "single precision" burnish-lut ward-s -o x.exr --domain 1:1.000000001
  refuses 1 "--domain: ward-e: expected 2 range(s) A:B, got 1" burnish-lut ward-e -o x.exr --domain 0:16
  refuses 1 "--domain: banks-r: expected 1 range(s) A:B, got 2" burnish-lut banks-r -o x.exr --domain 0:1,0:1
  for junk in "" 1 0:1: 0:1, ,0:1 a:b 0-1 0:1:2 0:1e999 "0: 1"; do
    refuses 1 "--domain: expected ranges such as 0:1 or 0:16,0:1, got '$junk'" \
      burnish-lut ward-s -o x.exr --domain "$junk"
  done
}

@test "junk for --size, and tables that are too large, are refused" {
  for junk in 0 -1 8x 0x5 x5 1.5 8x8x8 big "" 99999999999; do
    refuses 1 "--size: expected texels such as 1024 or 1024x512, got '$junk'" burnish-lut strand -o x.exr --size "$junk"
  done
  refuses 1 "--size: expected a width of 2 to 32768, got 1" burnish-lut banks-r -o x.exr --size 1
  refuses 1 "--size: expected a width of 2 to 32768, got 40000" burnish-lut banks-r -o x.exr --size 40000
  refuses 1 "--size: expected at most 2^26 texels, got 32768x32768" burnish-lut strand -o x.exr --size 32768
  refuses 1 "--size: banks-r has one argument; expected N, got 16x2" burnish-lut banks-r -o x.exr --size 16x2
  succeeds burnish-lut banks-r -o x.exr --size 1 --sampling centre
}

@test "a table that finds no memory is an error like any other" {
  needs_bare_memory
  tight() { (ulimit -v 600000 && exec burnish-lut "$@"); }
  call tight strand -o x.exr --size 8192 -j 2
  [ "$status" -eq 4 ] || skip "memory cannot be limited here"
  [ "$(cat err)" = "burnish-lut: error: out of memory" ]
  [ -z "$(find . -name '*.exr' -o -name '*tmp*')" ]
}

@test "values beyond the samples, and samples beyond the file, are refused" {
  refuses 5 "--format: expected values within 65504, which half holds, got 1e+05" \
    burnish-lut ward-s -o x.exr --domain 1e-10:1
  succeeds burnish-lut ward-s -o x.exr --domain 1e-10:1 -d float
  refuses 5 "EXR holds half or float, not uint8" burnish-lut ward-s -o x.exr -d uint8
  refuses 5 "a lookup table is written as PNG, TIFF, EXR, TGA, BMP or C header (.h), not '.gif'" \
    burnish-lut ward-s -o x.gif
  refuses 5 "indexed normal maps" burnish-lut ward-s -o x.ktx2
}

@test "the function: one, and one that there is" {
  refuses 1 "FUNCTION: expected banks-r|blinn-phong-f|ward-s|ward-e|strand|light-factor, got 'phong'" \
    burnish-lut phong -o x.exr
  refuses 1 "" burnish-lut banks-r ward-s -o x.exr
  refuses 1 "FUNCTION is required" burnish-lut -o x.exr
  refuses 1 "--output is required" burnish-lut banks-r
  refuses 2 "'nowhere/x.exr'" burnish-lut banks-r -o nowhere/x.exr
  refuses 2 "'nowhere/x.h'" burnish-lut banks-r -o nowhere/x.h
}

@test "the same bytes on any number of threads, to standard output and in any folder; a depfile of no inputs" {
  mkdir sub
  for ext in exr png tif h; do
    succeeds burnish-lut strand -o one.$ext --size 64x48 -j 1
    (cd sub && succeeds burnish-lut strand -o all.$ext --size 64x48 -j 4)
    same_bytes one.$ext sub/all.$ext
  done
  burnish-lut strand -o - --output-type exr --size 64x48 >stream.exr
  same_bytes one.exr stream.exr
  refuses 1 "needs --output-type" burnish-lut strand -o -
  succeeds burnish-lut strand -o x.exr --depfile x.d --report r1.json -j 1
  succeeds burnish-lut strand -o x.exr --report r4.json -j 4
  [ "$(cat x.d)" = "x.exr:" ]
  [ "$(value rms_error r1.json)" = "$(value rms_error r4.json)" ]
}

@test "a full disk leaves nothing behind" {
  small_disk disk
  for ext in exr h; do
    refuses 2 "disk/x.$ext'" burnish-lut strand -o disk/x.$ext -d float --size 256
    [ -z "$(ls -A disk)" ]
  done
}
