#!/usr/bin/env bats
# What goes wrong around a tool while it works: a disk that is full or read-only, a pipe that closes, signals, inputs that
# shrink, memory that ends. Whatever writes a file is tried: the old one stays as it was, byte for byte, nothing is left
# behind, and one line says what was wrong.

load helpers
load ptm_inputs

# A way of each tool to write each type that it has a writer for; @ is the folder that it writes to.
writers() {
  cat <<'END'
burnish-normals h.tif -o @/n.png --depfile @/n.d
burnish-normals h.tif -o @/n.tif
burnish-normals h.tif -o @/n.exr
burnish-normals h.tif -o @/n.tga
burnish-normals h.tif -o @/n.bmp
burnish-normals h.tif --mesh low.obj -o @/m.png
burnish-quantize n.png -n 64 -o @/q.exr --palette-output @/p.png
burnish-quantize n.png -n 64 -o @/q.png --palette-output @/p.exr
burnish-quantize n.png --histogram-output @/n.histogram
burnish-quantize n.png m.png -n 64 --output-dir @/new --extension ktx2
burnish-quantize n.png m.png -n 64 --output-dir @ --extension dds --palette-output @/p.exr
burnish-mipmap n.png --kind normal -o @/m.exr --roughness 0.3 --roughness-output @/r.exr
burnish-mipmap q.exr -o @/m.exr
burnish-mipmap q.exr -o @/m.ktx2
burnish-mipmap q.exr --split @/l_%d.png
burnish-mipmap a.ptm -o @/a.exr
burnish-render s.toml -o @/s.png
burnish-render s.toml -o @/s.exr --aov normal
burnish-render --validate s.toml --report-dir @/report
burnish-simplify m.ply --faces 900 -o @/low.obj
burnish-simplify m.ply --faces 900 -o @/low.ply
burnish-transfer low.obj m.ply -o @/t.png --size 128 --displacement @/d.exr --mask-output @/c.png
burnish-lut strand -o @/s.exr -d float --size 128
burnish-lut strand -o @/s.h --size 128
burnish-tangents n.png --from vector -o @/t.png
burnish-tangents n.png --from vector --rotate 90 -o @/t.exr
burnish-material --model ward --alpha-x 0.3 --alpha-y 0.8 --normal n.png -o @/m
burnish-ptm fit l.lp -o @/a.ptm
burnish-ptm convert a.ptm -o @/a.exr
burnish-ptm convert a.ptm -o @/a/
burnish-ptm convert a.ptm --jpeg 95 -o @/a.ptm
burnish-ptm brdf ward:ax=0.2,ay=0.5,ks=1 --size 64 -o @/b/
burnish-ptm relight a.ptm --light 0,0,1 -o @/l.png
burnish-ptm normals a.ptm -o @/n.png
END
}

setup_file() {
  PATH="$BURNISH_BIN:$PATH"
  cd "$BATS_FILE_TMPDIR"
  make_image noise 160 160 h.tif
  burnish-normals h.tif -o n.png
  burnish-normals h.tif --neighbors 24 -o m.png
  burnish-quantize n.png -n 64 -o q.exr
  "$BURNISH_FIXTURE" mesh sphere 40 m.ply
  "$BURNISH_FIXTURE" mesh sphere 5 low.obj
  make_ptm RGB 100 80 a.ptm
  for i in 1 2 3 4 5 6 7; do burnish-ptm relight a.ptm --light "0.$i,0.$((i * i % 7)),1" -o "p$i.png"; done
  { echo 7 && for i in 1 2 3 4 5 6 7; do echo "p$i.png 0.$i 0.$((i * i % 7)) 1"; done; } >l.lp
  cat >s.toml <<'END'
path = "palette"
[image]
width = 160
height = 120
[[light]]
direction = [1, 1, 2]
[[object]]
normal_map = "n.png"
indexed_map = "q.exr"
[[material]]
model = "lambert"
[validate]
min_psnr_db = 1
END
  # What each writes where nothing goes wrong, in folders by the number of the line.
  local -a line
  local number=0
  while read -r -a line; do
    mkdir -p whole/$((++number))
    "${line[@]//@/whole/$number}" -q >/dev/null || { echo "fails: ${line[*]}"; return 1; }
  done < <(writers)
}

setup() {
  PATH="$BURNISH_BIN:$PATH"
  cd "$BATS_TEST_TMPDIR"
  ln -s "$BATS_FILE_TMPDIR"/* .
  mkdir tmp disk
  export TMPDIR=$PWD/tmp
}

teardown() {
  if mountpoint -q "$BATS_TEST_TMPDIR/disk"; then umount "$BATS_TEST_TMPDIR/disk"; fi
}

# each FUNCTION: called for every writer, whose words are in the array `line` and whose outputs in the folder $whole.
each() {
  local -a line
  local number=0 whole
  while read -r -a line; do
    whole=$BATS_FILE_TMPDIR/whole/$((++number))
    "$1" || { echo "with: ${line[*]}"; return 1; }
  done < <(writers)
}

# The files of the writer at hand, relative to the folder that it writes to.
outputs() { (cd "$whole" && find . -type f); }

# The same files in the folder disk, as an older run has left them.
old_outputs() {
  local file
  for file in $(outputs); do
    mkdir -p "disk/$(dirname "$file")"
    echo "an older $file" >"disk/$file"
  done
}

# Whether disk holds what the writer at hand writes; depfiles say where that is, and reports how long it took.
same_outputs() { diff -r --exclude='.*.burnish-tmp' --exclude='*.d' --exclude='report.*' "$whole" disk; }

on_full_disks() {
  local pages room
  pages=$(find "$whole" -type f -printf '%s\n' | awk '{ n += int(($1 + 4095) / 4096) } END { print n }')
  for room in 0 $((pages / 2)) $((pages - 1)); do
    mount -t tmpfs -o size=$(((room + $(outputs | wc -l)) * 4096)) tmpfs disk
    old_outputs
    refuses 2 "No space left on device" "${line[@]//@/disk}" || { echo "$room of $pages pages"; return 1; }
    umount disk
  done
}

@test "a disk that is full at once, in the middle and at the last page: exit 2" {
  small_disk disk && umount disk
  each on_full_disks
}

on_full_device() {
  old_outputs
  ln -sf /dev/full "disk/$(outputs | tail -n 1)"
  refuses 2 "No space left on device" "${line[@]//@/disk}"
  rm -r disk/*
}

@test "one of the outputs on a full device: exit 2, and the others stay too" {
  [ -e /dev/full ] || skip "no /dev/full"
  each on_full_device
}

on_locked_disk() {
  old_outputs
  if [ "$(id -u)" -eq 0 ]; then mount -o remount,ro disk; else chmod -R a-w disk; fi
  refuses 2 "$expected" "${line[@]//@/disk}"
  if [ "$(id -u)" -eq 0 ]; then mount -o remount,rw disk; else chmod -R u+w disk; fi
  rm -r disk/*
}

@test "a folder that nobody may write to: exit 2, before any work" {
  expected="Permission denied"
  if [ "$(id -u)" -eq 0 ]; then
    expected="Read-only file system"
    small_disk disk
    mount -o remount,size=1m disk
  fi
  each on_locked_disk
}

# A pipe that is closed already; the last words of standard error are in err.
into_closed_pipe() {
  "${PYTHON3:-python3}" - "$@" <<'PYTHON'
import os, subprocess, sys
read, write = os.pipe()
os.close(read)
sys.exit(subprocess.run(sys.argv[1:], stdout=write, stderr=open("err", "w")).returncode)
PYTHON
}

breaks_pipe() {
  local before status=0
  before=$(inventory)
  into_closed_pipe "$@" || status=$?
  [ "$status $(cat err)" = "2 $1: error: standard output: cannot be written: Broken pipe" ] || { echo "$status"; cat err; return 1; }
  [ "$before" = "$(inventory)" ]
}

with_closed_report() {
  old_outputs
  breaks_pipe "${line[@]//@/disk}" --report -
  rm -r disk/*
}

@test "a pipe that closes: exit 2, of an image and of a report" {
  each with_closed_report
  for command in "normals h.tif" "quantize n.png -n 64" "mipmap q.exr" "render s.toml" "lut strand" \
    "tangents n.png --from vector" "ptm relight a.ptm --light 0,0,1" "ptm normals a.ptm"; do
    for type in png exr; do
      [ "$command $type" = "mipmap q.exr png" ] || breaks_pipe burnish-$command -o - --output-type $type
    done
  done
  breaks_pipe burnish-ptm info a.ptm
}

at_moment() { "${PYTHON3:-python3}" "$BURNISH_SOURCE_DIR/tests/cli/at_moment.py" "$@"; }

# What a kill leaves is hidden from every glob of images, and the next run goes as if nothing had been.
on_signals() {
  local moment before left
  for moment in "begun SIGTERM" "written SIGINT" "written SIGKILL"; do
    old_outputs
    before=$(inventory)
    at_moment disk $moment "${line[@]//@/disk}" || { echo "$moment"; return 1; }
    rm report
    if [[ $moment = *KILL ]]; then
      left=$(find disk tmp -name '.*.burnish-tmp')
      [ -n "$left" ]
      succeeds "${line[@]//@/disk}" -q
      same_outputs
      old_outputs
      rm $left
    fi
    [ "$before" = "$(inventory)" ] || { diff <(echo "$before") <(inventory); echo "$moment"; return 1; }
  done
  rm -r disk/*
}

@test "SIGTERM, SIGINT and SIGKILL while outputs are written, and when they are" {
  each on_signals
}

@test "inputs that shrink or go while they are read: exit 2 or 3, never a crash" {
  make_image noise 1500 1500 wide.tif
  burnish-normals wide.tif -o wide.png
  burnish-normals wide.tif -o wide.exr
  local line before
  while read -r -a line; do
    file=$BATS_TEST_TMPDIR/${line[-1]}
    cp "$file" kept
    echo old >disk/o.tif
    before=$(inventory)
    status=0
    at_moment disk half "shorten:${line[-1]}" "${line[@]:0:${#line[@]}-1}" 2>err || status=$?
    [ "$status" -eq 2 ] || [ "$status" -eq 3 ] || { echo "exit $status: ${line[*]}"; cat err; return 1; }
    [ "$(wc -l <err)" -eq 1 ] && grep -q "^${line[0]}: error: '${line[-1]}': " err || { cat err; return 1; }
    cp kept "$file"
    [ "$before" = "$(inventory)" ] || { diff <(echo "$before") <(inventory); return 1; }
  done <<'END'
burnish-normals wide.tif -o disk/o.tif -j 1 --neighbors 80 wide.tif
burnish-normals wide.png -o disk/o.tif -j 1 --neighbors 80 wide.png
burnish-normals wide.exr -o disk/o.tif -j 1 --neighbors 80 wide.exr
burnish-mipmap wide.png --kind normal -o disk/o.exr -j 1 wide.png
burnish-tangents wide.png --from vector -o disk/o.tif -j 1 wide.png
END
}

# least_memory TOOL: KiB of address space that the tool itself takes, up to 16 MiB.
least_memory() {
  local low=0 high=4194304 middle
  while [ $((high - low)) -gt 16384 ]; do
    middle=$(((low + high) / 2))
    if (ulimit -v $middle && exec "$1" --version >/dev/null 2>&1); then high=$middle; else low=$middle; fi
  done
  echo $high
}

on_little_memory() {
  local limit least before
  [ -e "least-${line[0]}" ] || least_memory "${line[0]}" >"least-${line[0]}"
  least=$(<"least-${line[0]}")
  old_outputs
  before=$(inventory)
  for limit in $((least + 4096)) $((least + 49152)) $((least + 163840)); do
    status=0
    (ulimit -v $limit && exec "${line[@]//@/disk}" -q -j 2 >out 2>err) || status=$?
    if [ "$status" -eq 0 ]; then
      same_outputs
      old_outputs
    else
      [ "$status" -eq 4 ] || [ "$status" -eq 5 ] || { echo "exit $status at $limit"; cat err; return 1; }
      [ "$(wc -l <err)" -eq 1 ] && grep -q "^${line[0]}: error: " err || { echo "at $limit"; cat err; return 1; }
      ran_out=$((ran_out + 1))
    fi
    [ "$before" = "$(inventory)" ] || { diff <(echo "$before") <(inventory); echo "at $limit"; return 1; }
  done
  rm -r disk/*
}

@test "memory that ends, at once or later: exit 4 or 5, one line, in whatever thread that is" {
  if grep -qa __asan_init "$BURNISH_BIN/burnish-normals"; then skip "sanitizers need memory of their own"; fi
  ran_out=0
  each on_little_memory
  [ "$ran_out" -gt 10 ]
}

@test "a folder for temporary files that is full or missing: exit 2" {
  make_image noise 700 700 wide.tif
  burnish-normals wide.tif -o wide.png
  small_disk disk
  for command in "normals -" "normals wide.tif -o - --output-type tiff" "mipmap wide.png --kind normal -o x.exr" \
    "tangents wide.png --from vector --rotate 90 -o x.tif" "ptm fit l.lp -o x.ptm --memory 1"; do
    [[ $command = *"-o "* ]] || command+=" -o x.png"
    TMPDIR=none refuses 2 "'none'" burnish-$command <wide.tif
    dd if=/dev/zero of=disk/filler bs=4k status=none 2>/dev/null || true
    TMPDIR=disk refuses 2 "No space left on device" burnish-$command <wide.tif
  done
}

@test "a directory of outputs that fills up: burnish-batch names what failed, and the next run makes good" {
  mkdir in
  for i in 1 2 3; do cp "$BURNISH_SOURCE_DIR/samples/cmake/textures/waves.png" in/$i.png; done
  sed '1,/^$/d' "$BURNISH_SOURCE_DIR/samples/batch/textures.toml" >r.toml
  small_disk disk
  refuses 2 "cannot be made" burnish-batch r.toml --directory in --build-dir r.toml/build
  call burnish-batch r.toml --directory in --build-dir disk --keep-going
  [ "$status" -eq 10 ] && grep -q "No space left on device" err || { cat err; return 1; }
  [ -z "$(find disk -name '*.burnish-tmp')" ]
  mount -o remount,size=64m disk
  succeeds burnish-batch r.toml --directory in --build-dir disk
  [ "$(ls disk/*.ktx2 | wc -l)" -eq 3 ]
}
