#!/usr/bin/env bats
# What holds for every tool, tried on each that is built; where inputs are needed, on burnish-normals.

load helpers

every_tool() {
  local tool
  for tool in "$BURNISH_BIN"/burnish-*; do
    [ -x "$tool" ] && basename "$tool"
  done
}

teardown() {
  if mountpoint -q "$BATS_TEST_TMPDIR/disk" 2>/dev/null; then umount "$BATS_TEST_TMPDIR/disk"; fi
}

@test "there are tools" {
  every_tool | grep -q '^burnish-normals$'
}

@test "--version: exit 0, on standard output, with the versions of what is linked" {
  for tool in $(every_tool); do
    succeeds "$tool" --version
    grep -qE '^burnish [0-9]+\.[0-9]+\.[0-9]+ \(.+\), .+, (oneTBB [0-9.]+|std::thread), CLI11 [0-9.]+$' out || { cat out; return 1; }
    if [ "$tool" != burnish-batch ]; then  # which reads no images
      grep -qE ', OpenImageIO [0-9.]+, OpenEXR [0-9.]+, libpng [0-9.]+' out || { cat out; return 1; }
    fi
  done
}

@test "no tool waits for OpenImageIO at its start" {
  for tool in $(every_tool); do
    ldd "$BURNISH_BIN/$tool" >libraries
    if grep -q libOpenImageIO libraries; then return 1; fi
    [ "$(wc -l <libraries)" -le 25 ] || { cat libraries; return 1; }
  done
}

@test "without the module of further image types: PNG and EXR, and exit 2 for others" {
  make_image bumps 8 8 h.png
  make_image bumps 8 8 h.tif
  cp "$BURNISH_BIN/burnish-normals" .  # which does not find it from here
  succeeds ./burnish-normals h.png -o n.exr
  refuses 2 "'h.tif': expected the module burnish-openimageio.so for files of its type, got none" ./burnish-normals h.tif -o x.png
  refuses 2 "'x.tif': expected the module burnish-openimageio.so" ./burnish-normals h.png -o x.tif
}

@test "--help and -h: exit 0, on standard output, with the exit codes" {
  for tool in $(every_tool); do
    for flag in --help -h; do
      succeeds "$tool" "$flag"
      grep -q -- '--report' out
      grep -q -- '--depfile' out
      grep -q 'Exit codes: 0 ok, 1 usage, 2' out
    done
  done
}

@test "--help wins over whatever else is wrong" {
  for tool in $(every_tool); do succeeds "$tool" --help; done
}

@test "no arguments is a usage error" {
  for tool in $(every_tool); do refuses 1 "required" "$tool"; done
}

@test "an unknown option is a usage error" {
  make_image bumps 8 8 h.png
  for tool in $(every_tool); do
    refuses 1 "" "$tool" h.png -o x.exr --no-such-option
    refuses 1 "" "$tool" h.png -o x.exr -z
  done
}

@test "options are not abbreviated, and a value does not come with a second one" {
  make_image bumps 8 8 h.png
  refuses 1 "" burnish-normals h.png -o x.png --heigh 2
  refuses 1 "" burnish-normals h.png -o x.png --height 2 --height 3
  refuses 1 "" burnish-normals h.png -o x.png -o y.png
}

@test "an extra positional is a usage error, never an output" {
  make_image bumps 8 8 h.png
  refuses 1 "" burnish-normals h.png y.png -o x.png
  refuses 1 "" burnish-normals h.png y.png
}

@test "without -o there is nothing to write to" {
  make_image bumps 8 8 h.png
  refuses 1 "--output" burnish-normals h.png
}

@test "--arguments-from: more arguments, in its place" {
  burnish-normals "$BURNISH_SOURCE_DIR/samples/cmake/textures/waves.png" -o n.png
  printf "n.png -n '16'\n-o \"q x.exr\"" >a
  succeeds burnish-quantize --arguments-from a --report r.json
  grep -q '"q x.exr"' r.json && ! grep -q arguments-from r.json
  burnish-quantize n.png -n 16 -o q.exr
  same_bytes q.exr "q x.exr"
  : >empty
  refuses 1 "" burnish-quantize --arguments-from=empty
  refuses 2 "'none': cannot be read" burnish-quantize --arguments-from none
  printf "n.png 'open" >a
  refuses 3 "'a': expected quotes in pairs" burnish-quantize --arguments-from a
  printf 'n.png\0' >a
  refuses 3 "'a': expected text" burnish-quantize --arguments-from a
  echo "n.png --arguments-from a" >a
  refuses 1 "--arguments-from" burnish-quantize --arguments-from a
}

@test "threads out of range are refused" {
  make_image bumps 8 8 h.png
  for j in -1 x 1.5 99999999999; do refuses 1 "" burnish-normals h.png -o x.png -j "$j"; done
  for j in 0 1 2 8; do succeeds burnish-normals h.png -o x.png -j "$j"; done
}

@test "numbers that are none are refused in our own words, with the option and the range" {
  make_image bumps 8 8 h.png
  refuses 1 "--threads: expected an integer from 0 to 4096, got 'x'" burnish-normals h.png -o x.png -j x
  refuses 1 "--threads: expected an integer from 0 to 4096, got '-1'" burnish-normals h.png -o x.png -j -1
  refuses 1 "--mid-level: expected a number, got 'abc'" burnish-normals h.png -o x.png --mid-level abc
  refuses 1 "--normals: expected an integer from 2 to 65536, got '1.5'" burnish-quantize h.png -o x.exr -n 1.5
  refuses 1 "--dither-amount: expected a number from 0 to 1, got '1.01'" burnish-quantize h.png -o x.exr --dither-amount 1.01
  refuses 1 "--target-error: expected a number from 0 to 180, got 'nan'" burnish-quantize h.png -o x.exr --target-error nan
  refuses 1 "--format: expected uint8|uint16|half|float, got 'int7'" burnish-normals h.png -o x.png -d int7
}

@test "what the library calls by name is shown as the option that it is" {
  make_image bumps 8 8 h.png
  burnish-normals h.png -o n.png
  burnish-quantize n.png -o q.exr
  refuses 1 "error: --levels: expected 1 to 4 for 8x8 texels, got 5" burnish-mipmap q.exr --levels 5 -o m.exr
  "$BURNISH_FIXTURE" mesh sphere 4 m.obj
  refuses 1 "error: --cage: expected a number of at least 0, got -1" burnish-transfer m.obj m.obj -o x.png --cage -1
}

@test "inputs that cannot be read: exit 2" {
  mkdir dir.png
  refuses 2 "'missing.png'" burnish-normals missing.png -o x.png
  refuses 2 "'dir.png'" burnish-normals dir.png -o x.png
  make_image bumps 8 8 h.png
  refuses 2 "'h.png/h.png'" burnish-normals h.png/h.png -o x.png
  refuses 2 "'missing.png'" burnish-normals h.png --mask missing.png -o x.png
}

@test "a file without permission: exit 2" {
  [ "$(id -u)" -ne 0 ] || skip "root may read anything"
  make_image bumps 8 8 h.png
  chmod 000 h.png
  refuses 2 "Permission denied" burnish-normals h.png -o x.png
}

@test "inputs that are damaged: exit 3, and the codec says nothing of its own" {
  make_image noise 64 64 good.png
  make_image noise 64 64 good.tif
  make_image noise 64 64 good.exr
  make_image noise 64 64 good.tga
  make_image noise 64 64 good.bmp
  : >empty.png
  echo "not an image" >text.png
  echo "not an image" >text.tga
  for type in png tif exr tga bmp; do
    size=$(stat -c %s good.$type)
    for part in 1 10 50 85; do  # a TGA ends in a footer that can be missed
      head -c $((size * part / 100)) good.$type >cut.$type
      refuses 3 "'cut.$type'" burnish-normals cut.$type -o x.exr
    done
  done
  cp good.png crc.png
  printf '\377\000\377' | dd of=crc.png bs=1 seek=$(($(stat -c %s crc.png) / 2)) conv=notrunc status=none
  refuses 3 "'empty.png'" burnish-normals empty.png -o x.png
  refuses 3 "'text.png'" burnish-normals text.png -o x.png
  refuses 3 "'text.tga'" burnish-normals text.tga -o x.png
  refuses 3 "'crc.png'" burnish-normals crc.png -o x.png
  refuses 3 "standard input" burnish-normals - -o x.png <text.png
  refuses 3 "standard input" burnish-normals - -o x.png </dev/null
}

@test "what a codec says of a damaged file is said once, and of no temporary" {
  make_image noise 64 64 good.png
  make_image noise 64 64 good.exr
  head -c 2000 good.png >cut.png
  refuses 3 "'cut.png': Read error: hit end of file" burnish-normals cut.png -o x.png
  [ "$(grep -o 'end of file' err | wc -l)" -eq 1 ] || { cat err; return 1; }
  head -c 2000 good.exr >cut.exr
  refuses 3 'standard input: ' burnish-normals - -o x.png <cut.exr
  if grep burnish-tmp err; then return 1; fi
  burnish-normals good.exr -o n.exr
  burnish-quantize n.exr -o q.exr
  head -c 1000 q.exr >cut.exr
  refuses 3 'standard input: ' burnish-mipmap - -o x.exr <cut.exr
  if grep burnish-tmp err; then return 1; fi
}

@test "outputs that cannot be written: exit 2, before any work" {
  make_image bumps 8 8 h.png
  mkdir dir.png
  refuses 2 "'nowhere/x.png'" burnish-normals h.png -o nowhere/x.png
  refuses 2 "'dir.png'" burnish-normals h.png -o dir.png
  refuses 2 "'h.png/x.png'" burnish-normals h.png -o h.png/x.png
  refuses 2 "'nowhere/r.json'" burnish-normals h.png -o x.png --report nowhere/r.json
  refuses 2 "'nowhere/x.d'" burnish-normals h.png -o x.png --depfile nowhere/x.d
}

@test "a folder without permission: exit 2" {
  make_image bumps 8 8 h.png
  mkdir locked
  chmod 555 locked
  if touch locked/probe 2>/dev/null; then
    rm -f locked/probe
    # Root passes by permissions; a read-only mount stops it too.
    mkdir disk
    mount -t tmpfs -o size=64k,ro tmpfs disk 2>/dev/null || skip "root may write anywhere here"
    refuses 2 "Read-only file system" burnish-normals h.png -o disk/x.png
  else
    refuses 2 "Permission denied" burnish-normals h.png -o locked/x.png
  fi
}

@test "types and samples that are not provided: exit 5" {
  make_image bumps 8 8 h.png
  refuses 5 "half" burnish-normals h.png -o x.png -d half
  refuses 5 "float" burnish-normals h.png -o x.png -d float
  refuses 5 "uint8" burnish-normals h.png -o x.exr -d uint8
  refuses 5 "half" burnish-normals h.png -o x.tif -d half
  refuses 5 "uint16" burnish-normals h.png -o x.tga -d uint16
  refuses 5 ".gif" burnish-normals h.png -o x.gif
  refuses 5 "'x'" burnish-normals h.png -o x
  refuses 1 "--format" burnish-normals h.png -o x.png -d int7
}

@test "a refusal of a type offers only those that the option takes" {
  make_image bumps 8 8 h.png
  burnish-normals h.png -o n.png
  burnish-quantize n.png -o q.exr
  refuses 5 "'x.gif': an image is written as PNG, TIFF, EXR, TGA or BMP, not '.gif' (--output)" burnish-normals h.png -o x.gif
  refuses 5 "'x': an image is written as PNG, TIFF, EXR, TGA or BMP, not a file without extension (--output)" burnish-normals h.png -o x
  indexed="an indexed normal map is written as EXR, PNG, KTX2 or DDS, not"
  refuses 5 "'x.gif': $indexed '.gif' (--output)" burnish-quantize n.png -o x.gif
  refuses 5 "'x_0.gif': $indexed '.gif' (--split)" burnish-mipmap q.exr --split 'x_%d.gif'
  refuses 5 "standard output: $indexed TIFF (--output-type)" burnish-mipmap q.exr -o - --output-type tiff
  refuses 5 "'p.gif': a palette is written as EXR or PNG, not '.gif' (--palette-output)" burnish-quantize n.png -o x.exr --palette-output p.gif
  refuses 5 "'c.gif': an image of colours is written as PNG, not '.gif' (--emit-rgb)" \
    burnish-quantize n.png -o x.exr --material-encoding alpha --emit-rgb c.gif
  refuses 1 "--output-type: expected png|exr, got 'ktx2'" burnish-quantize n.png -o - --output-type ktx2
  refuses 1 "standard output: needs --output-type png or exr" burnish-quantize n.png -o -
  refuses 1 "standard output: needs --output-type png, exr or tiff" burnish-normals h.png -o -
}

@test "help offers standard output the types that a tool can write there, and says what cannot go there" {
  for tool in quantize mipmap; do
    succeeds burnish-$tool --help
    grep -qE -- '--output-type png\|exr +.*KTX2 and DDS go to files only' out
  done
  succeeds burnish-render --help
  grep -qE -- '--output-type png\|exr ' out
  succeeds burnish-normals --help
  grep -qE -- '--output-type png\|exr\|tiff ' out
}

@test "an output that is an input is refused, by any name" {
  make_image bumps 8 8 h.png
  make_image mask 8 8 m.png
  ln -s h.png link.png
  ln h.png hard.png
  mkdir sub
  refuses 1 "is an input" burnish-normals h.png -o h.png
  refuses 1 "is an input" burnish-normals h.png -o ./h.png
  refuses 1 "is an input" burnish-normals h.png -o sub/../h.png
  refuses 1 "is an input" burnish-normals h.png -o link.png
  refuses 1 "is an input" burnish-normals link.png -o h.png
  refuses 1 "is an input" burnish-normals h.png -o hard.png
  refuses 1 "is an input" burnish-normals h.png --mask m.png -o m.png
  refuses 1 "is an input" burnish-normals h.png -o x.png --report h.png
  refuses 1 "is an input" burnish-normals h.png -o x.png --depfile h.png
}

@test "two outputs of one name are refused" {
  make_image bumps 8 8 h.png
  refuses 1 "twice" burnish-normals h.png -o x.png --report x.png
  refuses 1 "twice" burnish-normals h.png -o x.png --depfile ./x.png
  refuses 1 "twice" burnish-normals h.png -o x.png --depfile x.d --report x.d
  refuses 1 "twice" burnish-normals h.png -o - --output-type png --report -
}

@test "on failure an old output, report and depfile are untouched" {
  make_image bumps 8 8 h.exr
  make_image nan 64 64 nan.exr
  succeeds burnish-normals h.exr -o x.png --report r.json --depfile x.d
  refuses 3 "NaN" burnish-normals nan.exr -o x.png --report r.json --depfile x.d
}

@test "a full disk: exit 2, and the old output is untouched" {
  make_image noise 256 256 h.png
  make_image bumps 8 8 small.png
  small_disk disk
  for type in png tif exr tga bmp; do
    succeeds burnish-normals small.png -o disk/x.$type
    refuses 2 "No space left on device" burnish-normals h.png -o disk/x.$type
    rm disk/x.$type
  done
}

@test "a disk that a small output alone fills, so that only closing shows it" {
  make_image bumps 24 24 h.png
  small_disk disk
  dd if=/dev/zero of=disk/filler bs=4k status=none 2>/dev/null || true
  for type in png tif exr tga bmp; do
    refuses 2 "No space left on device" burnish-normals h.png -o disk/x.$type
  done
  burnish-normals h.png -o n.png
  burnish-quantize n.png -n 16 -o q.exr
  for type in png exr; do
    refuses 2 "No space left on device" burnish-quantize n.png -n 16 -o disk/x.$type
    refuses 2 "No space left on device" burnish-quantize n.png -n 16 -o x.exr --palette-output disk/p.$type
  done
  refuses 2 "No space left on device" burnish-mipmap q.exr -o disk/m.exr
  refuses 2 "No space left on device" burnish-normals h.png -o x.png --report disk/r.json
  refuses 2 "No space left on device" burnish-normals h.png -o x.png --depfile disk/x.d
}

@test "standard output on a full device: exit 2" {
  [ -e /dev/full ] || skip "no /dev/full"
  make_image noise 64 64 h.png
  rc=0
  burnish-normals h.png -o - --output-type png >/dev/full 2>err || rc=$?
  [ "$rc" -eq 2 ]
  grep -q "standard output: cannot be written: No space left on device" err
  [ "$(wc -l <err)" -eq 1 ]
  rc=0
  burnish-normals --version >/dev/full 2>err || rc=$?
  [ "$rc" -eq 2 ]
}

@test "a closed pipe: exit 2, one line, nothing left behind" {
  make_image noise 512 512 h.png
  mkdir tmp
  { sleep 0.3; TMPDIR=$PWD/tmp burnish-normals h.png -o - --output-type tiff 2>err || echo $? >rc; } | true
  [ "$(cat rc)" -eq 2 ]
  grep -q "standard output: cannot be written: Broken pipe" err
  [ "$(wc -l <err)" -eq 1 ]
  [ -z "$(ls -A tmp)" ]
}

@test "a closed pipe takes no report or second output with it" {
  make_image noise 512 512 h.png
  echo old >x.png
  { sleep 0.3; burnish-normals h.png -o x.png --report - 2>err || echo $? >rc; } | true
  [ "$(cat rc)" -eq 2 ]
  [ "$(cat x.png)" = old ]
}

@test "SIGTERM, SIGINT and SIGHUP in the middle leave no temporary and the old output" {
  make_image noise 2500 2500 h.tif
  echo old >x.png
  for signal in TERM INT HUP; do
    before=$(inventory)
    # In the foreground of a shell of its own: background jobs ignore SIGINT.
    "${PYTHON3:-python3}" - "$signal" <<'PYTHON'
import os, signal, subprocess, sys, time
number = getattr(signal, "SIG" + sys.argv[1])
p = subprocess.Popen(["burnish-normals", "h.tif", "-o", "x.png", "--neighbors", "80", "--report", "r.json"])
deadline = time.time() + 20
while time.time() < deadline and not any(f.endswith(".burnish-tmp") and os.stat(f).st_size > 0 for f in os.listdir(".")):
    time.sleep(0.005)
p.send_signal(number)
code = p.wait()
sys.exit(0 if code == -number else f"ended with {code} instead of the signal")
PYTHON
    [ "$before" = "$(inventory)" ]
  done
}

@test "SIGTERM while standard input is awaited leaves no temporary" {
  mkdir tmp
  mkfifo pipe
  sleep 30 >pipe &
  sleeper=$!
  TMPDIR=$PWD/tmp burnish-normals - -o x.png <pipe &
  tool=$!
  for _ in $(seq 100); do [ -n "$(ls -A tmp)" ] && break; sleep 0.05; done
  [ -n "$(ls -A tmp)" ]
  kill -TERM $tool
  wait $tool || true
  kill $sleeper
  [ -z "$(ls -A tmp)" ]
  [ ! -e x.png ]
}

@test "success leaves the outputs and nothing else" {
  make_image bumps 8 8 h.png
  mkdir tmp
  export TMPDIR=$PWD/tmp
  succeeds burnish-normals h.png -o x.png --report r.json --depfile x.d
  succeeds burnish-normals - -o y.png <h.png
  rm out err
  [ "$(ls -A | tr '\n' ' ')" = "h.png r.json tmp x.d x.png y.png " ] || { ls -A; return 1; }
  [ -z "$(ls -A tmp)" ]
}

@test "a temporary is hidden from every *.png" {
  make_image noise 2500 2500 h.tif
  burnish-normals h.tif -o x.png --neighbors 80 &
  tool=$!
  for _ in $(seq 400); do
    compgen -G '.*.burnish-tmp' >/dev/null && break
    sleep 0.01
  done
  [ "$(compgen -G '*.png' || true)" = "" ] || [ -s x.png ]
  wait $tool
}

@test "an output keeps the permissions that the umask gives" {
  make_image bumps 8 8 h.png
  (umask 027; burnish-normals h.png -o x.png)
  [ "$(stat -c %a x.png)" = 640 ]
}

@test "names with spaces, quotes, dashes and letters beyond ASCII" {
  mkdir "a dir" -- "-dash"
  make_image bumps 8 8 "a dir/it's é.png"
  succeeds burnish-normals "a dir/it's é.png" -o "a dir/ü \"n\".png"
  [ -s "a dir/ü \"n\".png" ]
  succeeds burnish-normals -o ./-n.png -- "a dir/it's é.png"
  [ -s ./-n.png ]
}

@test "names as long as the file system allows" {
  make_image bumps 8 8 h.png
  long=$(printf 'x%.0s' $(seq 251)).png
  succeeds burnish-normals h.png -o "$long"
  [ -s "$long" ]
}

@test "-q says nothing but errors; without it warnings are one line" {
  make_image colours 8 8 h.png
  call burnish-normals h.png -o x.png
  [ "$status" -eq 0 ]
  [ "$(wc -l <err)" -eq 1 ]
  grep -q '^burnish-normals: warning: ' err
  succeeds burnish-normals h.png -o x.png -q
  refuses 2 "missing" burnish-normals missing.png -o x.png -q
}

@test "-v adds the command line, quoted for a shell, to an error" {
  call burnish-normals "missing file.png" -o x.png -v
  [ "$status" -eq 2 ]
  [ "$(wc -l <err)" -eq 2 ]
  sed -n 2p err | grep -qF "burnish-normals: command: burnish-normals 'missing file.png' -o x.png -v"
}

@test "no progress bar where standard error is no terminal" {
  make_image noise 2000 2000 h.tif
  succeeds burnish-normals h.tif -o x.png --neighbors 80
}

@test "a progress bar on a terminal, wiped at the end, and none with -q" {
  script -qec true /dev/null >/dev/null 2>&1 </dev/null || skip "no script(1), or no terminal for it to make"
  make_image noise 2500 2500 h.tif
  script -qec "burnish-normals h.tif -o x.png --neighbors 80" typescript >/dev/null </dev/null
  grep -q '%' typescript
  grep -q "$(printf '\033')\[K" typescript
  script -qec "burnish-normals h.tif -o x.png --neighbors 80 -q" typescript >/dev/null </dev/null
  if grep -v '^Script ' typescript | grep -q '%'; then return 1; fi
}

@test "--report: to a file and to standard output, and as the schema says" {
  make_image bumps 12 8 h.png
  succeeds burnish-normals h.png -o x.png --report r.json
  [ ! -s out ]
  fits_schema normals r.json
  succeeds burnish-normals h.png -o x.png --report -
  cp out stdout.json
  fits_schema normals stdout.json
  "${PYTHON3:-python3}" - <<'PYTHON'
import json
r = json.load(open("r.json"))
assert r["tool"] == "burnish-normals", r
assert r["command"] == ["burnish-normals", "h.png", "-o", "x.png", "--report", "r.json"], r["command"]
assert r["inputs"] == ["h.png"] and r["outputs"] == ["x.png"], r
assert r["stats"]["width"] == 12 and r["stats"]["height"] == 8, r
PYTHON
}

@test "--report with names that JSON must escape, even such as are no UTF-8" {
  make_image bumps 8 8 h.png
  name=$'quote\"back\\slash\ttab.png'
  cp h.png "$name"
  succeeds burnish-normals "$name" -o x.png --report r.json
  fits_schema normals r.json
  name=$'latin-\xe9.png'
  cp h.png "$name" || skip "the file system wants UTF-8"
  succeeds burnish-normals "$name" -o x.png --report r.json
  fits_schema normals r.json
}

@test "--depfile: the output, then every file that was read" {
  make_image bumps 8 8 h.png
  make_image mask 8 8 m.png
  succeeds burnish-normals h.png --mask m.png -o x.png --depfile x.d
  [ "$(cat x.d)" = "x.png: h.png m.png" ]
  succeeds burnish-normals - --mask m.png -o x.png --depfile x.d <h.png
  [ "$(cat x.d)" = "x.png: m.png" ]
}

@test "--depfile: names that Make must escape, read back by GNU make" {
  command -v make >/dev/null || skip "no make"
  make_image bumps 8 8 h.png
  for name in 'a b.png' 'a#b.png' 'a$b.png' 'a $(b) #c.png' 'back\slash.png' 'back\ space.png'; do
    cp h.png "$name"
    succeeds burnish-normals "$name" -o x.png --depfile x.d
    printf 'include x.d\nx.png:\n\t@touch made\n' >Makefile
    touch -d '2001-01-01' "$name"
    rm -f made
    make -s x.png
    [ ! -e made ] || { echo "up to date, and made again: $name"; cat x.d; return 1; }
    touch -d '2035-01-01' "$name"
    make -s x.png
    [ -e made ] || { echo "newer input not seen: $name"; cat x.d; return 1; }
    rm "$name"
  done
}

@test "--depfile: the same names, read back by ninja" {
  command -v ninja >/dev/null || skip "no ninja"
  make_image bumps 8 8 h.png
  for name in 'a b.png' 'a#b.png' 'a$b.png' 'a $(b) #c.png' 'back\slash.png'; do
    cp h.png "$name"
    cat >build.ninja <<NINJA
rule normals
  command = burnish-normals "\$\$INPUT" -o x.png --depfile x.d && echo run >>runs
  depfile = x.d
  deps = gcc
build x.png: normals
NINJA
    rm -f .ninja_deps .ninja_log runs x.png
    INPUT="$name" ninja >/dev/null
    INPUT="$name" ninja >/dev/null
    [ "$(wc -l <runs)" -eq 1 ] || { echo "made again without need: $name"; return 1; }
    touch -d '2035-01-01' "$name"
    INPUT="$name" ninja >/dev/null
    [ "$(wc -l <runs)" -eq 2 ] || { echo "newer input not seen: $name"; ninja -t deps; return 1; }
    rm "$name"
  done
}

@test "standard input and output, of every type" {
  make_image bumps 16 16 h.png
  make_image bumps 16 16 h.tif
  make_image bumps 16 16 h.exr
  for type in png exr tiff; do
    ext=$type
    [ $type = tiff ] && ext=tif
    succeeds burnish-normals h.$ext -o direct.$ext
    burnish-normals - -o - --output-type $type <h.$ext >piped 2>err
    [ ! -s err ]
    same_bytes piped direct.$ext
    cat h.$ext | burnish-normals - -o - --output-type $type | cat >piped
    same_bytes piped direct.$ext
  done
}

@test "standard output needs a type, and one that it can be" {
  make_image bumps 8 8 h.png
  refuses 1 "--output-type" burnish-normals h.png -o -
  refuses 1 "" burnish-normals h.png -o - --output-type gif
  refuses 5 "half" burnish-normals h.png -o - --output-type png -d half
}

@test "the same bytes for any thread count, run and folder" {
  make_image noise 300 200 h.tif
  mkdir a b
  for ext in png exr tif tga bmp; do
    succeeds burnish-normals h.tif -o a/x.$ext -j 1 --neighbors 24
    sleep 1.1
    (cd b && succeeds burnish-normals ../h.tif -o x.$ext -j 2 --neighbors 24)
    same_bytes a/x.$ext b/x.$ext
    succeeds burnish-normals "$PWD/h.tif" -o a/x.$ext -j 8 --neighbors 24
    same_bytes a/x.$ext b/x.$ext
  done
}

@test "no output holds a path or a name of this machine" {
  make_image bumps 16 16 h.png
  for ext in png exr tif tga bmp; do
    succeeds burnish-normals "$PWD/h.png" -o "$PWD/x.$ext"
    if grep -aqF "$BATS_TEST_TMPDIR" x.$ext; then return 1; fi
    ! grep -aqF "$(hostname)" x.$ext || [ "$(hostname | wc -c)" -lt 6 ]
  done
}

@test "devices, pipes and links are written through, never replaced" {
  make_image bumps 8 8 h.png
  burnish-normals h.png -o x.png --report /dev/stdout >report.json
  grep -q '"tool": "burnish-normals"' report.json
  [ ! -f /dev/stdout ] || [ -L /dev/stdout ]
  burnish-normals h.png -o x.png --report /dev/null --depfile /dev/null
  [ -c /dev/null ]
  mkfifo pipe
  cat pipe >from_pipe.json &
  burnish-normals h.png -o x.png --report pipe
  wait
  [ -p pipe ]
  grep -q '"tool": "burnish-normals"' from_pipe.json
  mkdir elsewhere
  ln -s elsewhere/real.png link.png
  burnish-normals h.png -o link.png
  [ -L link.png ]
  cmp elsewhere/real.png x.png
}

@test "standard input cannot be read twice" {
  make_image bumps 8 8 h.png
  refuses 1 "standard input: is named as an input twice" burnish-normals - --mask - -o x.png <h.png
}

@test "--output-type does not change what a name says" {
  make_image bumps 8 8 h.png
  refuses 1 "--output-type" burnish-normals h.png -o x.png --output-type exr
  succeeds burnish-normals h.png -o x.png --output-type png
}
