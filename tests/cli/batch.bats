load helpers

setup() {
  : "${BURNISH_BIN:?run these through ctest, or set BURNISH_BIN and BURNISH_FIXTURE}"
  PATH="$BURNISH_BIN:$PATH"
  cd "$BATS_TEST_TMPDIR"
  mkdir in
  cp "$BURNISH_SOURCE_DIR"/samples/cmake/textures/*.png in
  sed 's/"256"/"64"/; 1,/^$/d' "$BURNISH_SOURCE_DIR/samples/batch/textures.toml" >r.toml
}

batch() { burnish-batch r.toml --directory in --build-dir made "$@"; }

@test "what is out of date is made, and nothing else" {
  succeeds batch --report r.json
  fits_schema batch r.json
  [ "$(value ran r.json)" = 9 ]
  burnish-normals in/waves.png -o n.png -d uint16 --wrap repeat --height 0.1 --size 1
  same_bytes n.png made/waves_n.png
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 0 ]
  touch in/waves.png
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 3 ]
  # Other arguments of one step: that step and those behind it.
  sed -i 's/"64"/"32"/' r.toml
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 6 ]
  cp in/waves.png in/more.png
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 3 ]
  same_bytes made/more.ktx2 made/waves.ktx2
}

@test "--dry-run: the commands that would run" {
  succeeds burnish-batch r.toml --directory in --build-dir none --dry-run --report r.json
  [ ! -e none ]
  [ "$(value jobs r.json)" = 9 ]
}

@test "--dry-run names files, steps and commands, only those that are due" {
  succeeds batch
  touch in/tiles.png
  burnish-batch r.toml --directory in --build-dir made --dry-run >due.json
  "$PYTHON3" - <<'END'
import json, os, shlex
due = json.load(open("due.json"))
assert [d["step"] for d in due] == ["normals", "quantized", "mips"], due
assert all(d["file"] == "tiles.png" and d["directory"] == os.path.abspath("made") for d in due), due
assert due[2]["outputs"] == ["tiles.ktx2"]
assert shlex.split(due[0]["command"])[1] == "../in/tiles.png"
END
  [ made/tiles_n.png -ot in/tiles.png ]
}

@test "a failure names every file, and the next run makes good" {
  head -c 100 in/waves.png >cut.png
  cp cut.png in/waves.png
  cp cut.png in/zebra.png
  call batch --keep-going --report r.json
  [ "$status" -eq 10 ]
  grep -q "^burnish-batch: error: waves_n.png: burnish-normals: error: '../in/waves.png'" err
  grep -q "^burnish-batch: error: zebra_n.png: " err
  grep -q "^burnish-batch: error: 2 of 12 jobs failed$" err
  [ "$(wc -l <err)" -eq 3 ]
  fits_schema batch r.json
  [ -s made/tiles.ktx2 ] && [ -s made/studs.ktx2 ]
  [ ! -e made/waves_n.png ] && [ ! -e made/waves_n.png.d ]
  cp in/tiles.png in/waves.png
  rm in/zebra.png
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 3 ]
}

@test "killed in the middle, run again" {
  for i in $(seq 40); do cp in/waves.png in/w$i.png; done
  burnish-batch r.toml --directory in --build-dir made -q >/dev/null 2>&1 3>&- &
  local batch=$!
  for _ in $(seq 100); do [ -e made/w10_n.png ] && break || sleep 0.05; done
  kill -9 $batch
  wait $batch || true
  succeeds batch --report r.json
  [ "$(value ran r.json)" -gt 0 ]
  succeeds burnish-batch r.toml --directory in --build-dir whole
  for file in whole/*; do same_bytes "$file" "made/${file#whole/}" || [ "$file" = whole/build.ninja ]; done
  [ "$(ls made | grep -cE 'ktx2$')" -eq 43 ]
  [ -z "$(ls -A made | grep -E 'tmp|\.d$' || true)" ]
}

@test "--shard: the parts make what the whole does" {
  succeeds batch
  for i in 0 1 2; do succeeds burnish-batch r.toml --directory in --build-dir parts --shard $i/3; done
  for file in made/*.{png,exr,ktx2}; do same_bytes "$file" "parts/${file#made/}"; done
  refuses 1 "--shard: expected one of N from 0, such as 0/4, got '3/3'" burnish-batch r.toml --directory in --build-dir parts --shard 3/3
  refuses 1 "--shard" burnish-batch r.toml --directory in --build-dir parts --shard x
}

@test "--launcher goes before every command" {
  cat >log-it <<'END'
#!/bin/sh
echo "$1" >>"$LOG"
exec "$@"
END
  chmod +x log-it
  LOG=$PWD/log succeeds burnish-batch r.toml --directory in --build-dir made --launcher "$PWD/log-it"
  [ "$(wc -l <log)" -eq 9 ]
}

@test "names with blanks, quotes and dollars" {
  rm in/*
  cp "$BURNISH_SOURCE_DIR/samples/cmake/textures/waves.png" "in/it's a \$5 map: new.png"
  succeeds batch --report r.json
  [ -s "made/it's a \$5 map: new.ktx2" ]
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 0 ]
}

@test "shared-palette: what one texture changes is its histogram, the palette and the maps" {
  cp "$BURNISH_SOURCE_DIR/samples/batch/shared-palette.toml" r.toml
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 10 ]
  succeeds burnish-quantize made/*_n.png -n 256 --output-dir all --palette-output palette.exr
  same_bytes palette.exr made/palette.exr
  for map in all/*_n.exr; do same_bytes "$map" "made/$(basename "$map" _n.exr)_q.exr"; done
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 0 ]
  cp in/tiles.png in/waves.png
  burnish-batch r.toml --directory in --build-dir made --dry-run >due.json
  "$PYTHON3" - <<'END'
import json
due = json.load(open("due.json"))
made = sorted(output for d in due for output in d["outputs"])
assert made == ["palette.exr", "studs_q.exr", "tiles_q.exr", "waves.histogram", "waves_n.png", "waves_q.exr"], made
END
  succeeds batch --report r.json
  [ "$(value ran r.json)" = 6 ]
  succeeds burnish-quantize made/*_n.png -n 256 --output-dir all --palette-output palette.exr
  same_bytes palette.exr made/palette.exr
  for map in all/*_n.exr; do same_bytes "$map" "made/$(basename "$map" _n.exr)_q.exr"; done
}

@test "more files in one run than a command line holds" {
  mkdir many
  burnish-normals in/waves.png -o n.png
  for i in $(seq 700); do ln n.png "many/$(printf "it's of a long name %0160d" "$i").png"; done
  cat >many.toml <<'TOML'
[[step]]
name = "histogram"
tool = "quantize"
files = "*.png"
together = true
output = "all.histogram"
arguments = ["{input}", "--histogram-output", "{output}"]
TOML
  succeeds burnish-batch many.toml --directory many --build-dir made --report r.json
  [ "$(value ran r.json)" = 1 ]
  [ ! -e made/all.histogram.arguments ]
  burnish-quantize n.png --histogram-output one.histogram --report one.json
  burnish-quantize --histograms made/all.histogram -n 16 --palette-output p.exr --report all.json
  [ "$(value texels all.json)" = "$((700 * $(value texels one.json)))" ]
  succeeds burnish-batch many.toml --directory many --build-dir made --report r.json
  [ "$(value ran r.json)" = 0 ]
}

@test "what is refused, and leaves nothing" {
  refuses 2 "'none.toml'" burnish-batch none.toml
  refuses 2 "'none': is not a directory" burnish-batch r.toml --directory none
  echo '[[step' >bad.toml
  refuses 3 "'bad.toml': line 1" burnish-batch bad.toml
  sed 's/\*\.png/*.jpg/' r.toml >bad.toml
  refuses 3 "'bad.toml': line 4: 'step[0].files': no file of 'in' fits '*.jpg'" burnish-batch bad.toml --directory in
  sed 's/^from/form/' r.toml >bad.toml
  refuses 3 "'bad.toml': line 11: 'step[1].form': unknown key" burnish-batch bad.toml --directory in
  sed 's/{stem}_q/q/' r.toml >bad.toml
  refuses 3 "'bad.toml': line 12: 'step[1].output': 'q.exr' is written by step 'quantized' for 'studs.png' and by" \
    burnish-batch bad.toml --directory in
  sed 's/^from = "normals"/from = "nothing"/' r.toml >bad.toml
  refuses 3 "'bad.toml': line 11: 'step[1].from': there is no step 'nothing'" burnish-batch bad.toml --directory in
}

@test "a tool that is not there" {
  sed 's/^tool = "mipmap"/tool = "mips"/' r.toml >bad.toml
  refuses 3 "'bad.toml': line 17: 'step[2].tool': there is no burnish-mips" burnish-batch bad.toml --directory in
}
