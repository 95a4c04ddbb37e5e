#!/usr/bin/env bats
# burnish-quantize with several maps: one palette for all of them.

load helpers

# Maps of several types and sizes, with ids and masks of their own.
inputs() {
  mkdir -p maps ids masks
  make_image normals 64 48 maps/a.png
  make_image normals 40 100 maps/b.exr half
  make_image colours 30 30 maps/c.tif
  make_image ids 64 48 ids/a.png
  make_image ids 40 100 ids/b.png
  make_image ids 30 30 ids/c.png
  make_image mask 64 48 masks/a.png
  make_image mask 40 100 masks/b.png
  make_image mask 30 30 masks/c.png
}
maps="maps/a.png maps/b.exr maps/c.tif"

@test "A B C --output-dir: a file each under its own stem, one palette, figures of all and of each" {
  inputs
  succeeds burnish-quantize $maps --encoding biased -n 200 --output-dir q --report r.json --palette-output p.exr
  fits_schema quantize r.json
  [ "$(ls q | xargs)" = "a.exr b.exr c.exr" ]
  "${PYTHON3:-python3}" - <<'PYTHON'
import json, math
report = json.load(open("r.json"))
assert report["outputs"] == ["q/a.exr", "q/b.exr", "q/c.exr", "p.exr"], report["outputs"]
assert report["inputs"] == ["maps/a.png", "maps/b.exr", "maps/c.tif"], report["inputs"]
stats, maps = report["stats"], report["stats"]["maps"]
assert [m["input"] for m in maps] == report["inputs"] and [m["output"] for m in maps] == report["outputs"][:3]
assert [m["texels"] for m in maps] == [64 * 48, 40 * 100, 30 * 30] and stats["texels"] == sum(m["texels"] for m in maps)
squares = sum(m["texels"] * m["rms_deg"] ** 2 for m in maps)
assert math.isclose(stats["rms_deg"], math.sqrt(squares / stats["texels"]), rel_tol=1e-6), stats
assert stats["max_deg"] == max(m["max_deg"] for m in maps) and stats["normals"] == 200
PYTHON
  # Each is what that palette makes of the map by itself.
  for m in a.png b.exr c.tif; do
    succeeds burnish-quantize maps/$m --encoding biased --palette p.exr -o alone.exr
    same_bytes alone.exr q/${m%.*}.exr
  done
}

@test "--extension; a single map; a folder that is there already" {
  inputs
  mkdir q
  succeeds burnish-quantize $maps -n 100 --output-dir q --extension png
  succeeds burnish-quantize $maps -n 100 --output-dir q/ --extension ktx2
  succeeds burnish-quantize $maps -n 100 --output-dir q --extension dds --palette-output p.png
  [ "$(ls q | xargs)" = "a.dds a.ktx2 a.png b.dds b.ktx2 b.png c.dds c.ktx2 c.png" ]
  succeeds burnish-quantize maps/a.png -n 64 --output-dir single --report r.json
  fits_schema quantize r.json
  succeeds burnish-quantize maps/a.png -n 64 -o x.exr --report one.json
  same_bytes single/a.exr x.exr
  [ "$(value rms_deg r.json)" = "$(value rms_deg one.json)" ]
  refuses 1 "--palette-output" burnish-quantize $maps --output-dir q --extension dds
  refuses 1 "--extension" burnish-quantize $maps --output-dir q --extension tif
  refuses 1 "--extension" burnish-quantize maps/a.png -o x.exr --extension exr
  refuses 5 "uint8" burnish-quantize $maps -n 300 --output-dir q --extension png -d uint8
}

@test "materials and masks: one for each in their order, or by {stem}" {
  inputs
  succeeds burnish-quantize $maps -n 100 --output-dir each --report r.json \
    --material ids/a.png --material ids/b.png --material ids/c.png --mask masks/a.png --mask masks/b.png --mask masks/c.png
  fits_schema quantize r.json
  [ "$("${PYTHON3:-python3}" -c 'import json; print(*json.load(open("r.json"))["inputs"])')" = \
    "$maps ids/a.png ids/b.png ids/c.png masks/a.png masks/b.png masks/c.png" ]
  succeeds burnish-quantize $maps -n 100 --output-dir stem --material 'ids/{stem}.png' --mask 'masks/{stem}.png' --depfile d
  [ "$(cat d)" = "stem/a.exr: $maps ids/a.png ids/b.png ids/c.png masks/a.png masks/b.png masks/c.png" ] || { cat d; return 1; }
  for m in a b c; do
    same_bytes each/$m.exr stem/$m.exr
    [ "$("$BURNISH_FIXTURE" strays each/$m.exr ids/$m.png)" = 0 ]
  done
  refuses 2 "'ids/b_id.png'" burnish-quantize maps/a.png maps/b.exr --output-dir x --material ids/a.png --material 'ids/{stem}_id.png'
  refuses 1 "--material: expected one file or 3, got 2" burnish-quantize $maps --output-dir x --material ids/a.png --material ids/b.png
  refuses 1 "--mask: expected one file, got 2" burnish-quantize maps/a.png --output-dir x --mask masks/a.png --mask masks/b.png
  refuses 3 "'ids/a.png'" burnish-quantize $maps --output-dir x --material ids/a.png --material ids/a.png --material ids/c.png
}

@test "one material map and one mask for maps of one size; options may stand before the maps" {
  inputs
  make_image colours 64 48 maps/d.png
  succeeds burnish-quantize --material ids/a.png --mask masks/a.png maps/a.png maps/d.png -n 90 --output-dir q --report r.json
  fits_schema quantize r.json
  for m in a d; do [ "$("$BURNISH_FIXTURE" strays q/$m.exr ids/a.png)" = 0 ]; done
  [ "$(value texels r.json)" = $((2 * 3065)) ]
  succeeds burnish-quantize - -n 90 --material ids/a.png -o x.exr <maps/a.png
  refuses 3 "'ids/a.png'" burnish-quantize $maps --material ids/a.png --output-dir x
}

@test "stems that collide name both maps" {
  inputs
  make_image normals 8 8 a.exr half
  refuses 1 "'maps/a.png' and 'a.exr' would both be written to 'x/a.exr'" burnish-quantize maps/a.png a.exr --output-dir x
  refuses 1 "'maps/a.png' and 'maps/a.png' would both" burnish-quantize maps/a.png maps/a.png --output-dir x
}

@test "-o and --output-dir: one of them, and as many maps as it holds" {
  inputs
  refuses 1 "several maps need --output-dir" burnish-quantize $maps -o x.exr
  refuses 1 "--output is one file, not 2" burnish-quantize maps/a.png maps/b.exr -o - --output-type exr
  refuses 1 "--output does not go with --output-dir" burnish-quantize $maps -o x.exr --output-dir q
  refuses 1 "--output-type does not go with --output-dir" burnish-quantize $maps --output-type png --output-dir q
  refuses 1 "--output is required, or --output-dir" burnish-quantize maps/a.png
  refuses 1 "standard input" burnish-quantize - --output-dir q <maps/a.png
  refuses 1 "standard input" burnish-quantize - -o x.exr --mask 'masks/{stem}.png' <maps/a.png
}

@test "all appear together, or nothing does" {
  inputs
  make_image nan 20 20 maps/nan.exr float
  refuses 3 "'maps/nan.exr'" burnish-quantize $maps maps/nan.exr --output-dir q
  refuses 2 "'maps/none.png'" burnish-quantize $maps maps/none.png --output-dir q
  refuses 2 "'maps/a.png'" burnish-quantize $maps --output-dir maps/a.png
  mkdir q
  succeeds burnish-quantize $maps -n 20 --output-dir q
  refuses 3 "'maps/nan.exr'" burnish-quantize $maps maps/nan.exr --output-dir q  # the old ones stay as they are
  refuses 1 "is an input" burnish-quantize maps/b.exr --output-dir maps
}

@test "--output-dir makes every level that is missing, and none stays where anything fails" {
  inputs
  make_image nan 20 20 maps/nan.exr float
  refuses 3 "'maps/nan.exr'" burnish-quantize $maps maps/nan.exr --output-dir deep/er/still
  refuses 5 "uint8" burnish-quantize $maps -n 300 --output-dir maps/deep/er -d uint8
  refuses 2 "'maps/a.png/deep': cannot be made a directory: 'maps/a.png' is a file" burnish-quantize $maps --output-dir maps/a.png/deep
  succeeds burnish-quantize $maps -n 20 --output-dir deep/er/still
  [ "$(ls deep/er/still | xargs)" = "a.exr b.exr c.exr" ]
}

@test "SIGTERM takes the directories away that --output-dir made" {
  make_image noise 2500 2500 n.tif
  burnish-normals n.tif -o n.png
  before=$(inventory)
  burnish-quantize n.png -n 5000 --output-dir deep/er &
  tool=$!
  for _ in $(seq 400); do [ -d deep/er ] && break; sleep 0.01; done
  [ -d deep/er ]
  kill -TERM $tool
  wait $tool || true
  [ "$before" = "$(inventory)" ]
}

@test "the same bytes for any thread count, run and order of the maps" {
  inputs
  for dither in none diffusion blue-noise; do
    succeeds burnish-quantize $maps -n 150 --material 'ids/{stem}.png' --dither $dither --output-dir one -j 1
    succeeds burnish-quantize maps/c.tif maps/a.png maps/b.exr -n 150 --material 'ids/{stem}.png' --dither $dither --output-dir two -j 8
    for m in a b c; do same_bytes one/$m.exr two/$m.exr; done
  done
}

@test "a target error holds over all maps together" {
  inputs
  succeeds burnish-quantize $maps --encoding biased --target-error 3 --output-dir q --report r.json
  n=$(value normals r.json)
  "${PYTHON3:-python3}" -c 'import json; assert json.load(open("r.json"))["stats"]["rms_deg"] <= 3'
  succeeds burnish-quantize $maps --encoding biased -n $((n - 1)) --output-dir q --report r.json
  "${PYTHON3:-python3}" -c 'import json; assert json.load(open("r.json"))["stats"]["rms_deg"] > 3'
}

@test "--histogram-output and --histograms: the palette of all maps, from files of each" {
  inputs
  for m in a b c; do
    file=$(echo maps/$m.*)
    succeeds burnish-quantize "$file" --encoding biased --material ids/$m.png --mask masks/$m.png \
      --histogram-output $m.histogram --report $m.json --depfile $m.d
    fits_schema quantize $m.json
    [ "$(cat $m.d)" = "$m.histogram: $file ids/$m.png masks/$m.png" ]
  done
  for options in "-n 100" "--target-error 4" "-n 90 --engine median-cut" "-n 80 --material-encoding alpha" "-n 70 --space object"; do
    succeeds burnish-quantize $maps --encoding biased --material 'ids/{stem}.png' --mask 'masks/{stem}.png' $options \
      --output-dir all --palette-output all.exr --report all.json
    succeeds burnish-quantize --histograms a.histogram b.histogram c.histogram $options --palette-output p.exr --report r.json
    same_bytes p.exr all.exr
    fits_schema quantize r.json
    for figure in texels normals distinct_input_normals max_deg lossless invalid_texels materials; do
      [ "$(value $figure r.json)" = "$(value $figure all.json)" ] || { echo "$options: $figure"; return 1; }
    done
  done
  # Given one by one, in any order, as PNG; what was read is named.
  succeeds burnish-quantize --histograms c.histogram -n 100 --histograms a.histogram --palette-output p.png --histograms b.histogram \
    --report r.json --depfile d
  succeeds burnish-quantize $maps --encoding biased --material 'ids/{stem}.png' --mask 'masks/{stem}.png' -n 100 \
    --output-dir all --palette-output all.png
  same_bytes p.png all.png
  [ "$(cat d)" = "p.png: c.histogram a.histogram b.histogram" ]
  "${PYTHON3:-python3}" -c 'import json; r = json.load(open("r.json")); assert (r["inputs"], r["outputs"]) == (["c.histogram", "a.histogram", "b.histogram"], ["p.png"]), r'
  # One of several maps is as those of each.
  succeeds burnish-quantize $maps --encoding biased --material 'ids/{stem}.png' --mask 'masks/{stem}.png' --histogram-output - >all.histogram
  cp out all.histogram
  succeeds burnish-quantize --histograms all.histogram -n 100 --palette-output p.png
  same_bytes p.png all.png
}

@test "histograms: the same bytes for any thread count; maps of other codings add up" {
  inputs
  succeeds burnish-quantize maps/a.png --histogram-output one -j 1
  succeeds burnish-quantize maps/a.png --histogram-output two -j 8
  same_bytes one two
  make_image bumps 64 48 h.png
  succeeds burnish-normals h.png --height 9 -d half -o up.exr
  succeeds burnish-normals h.png --height 9 -d half --y down -o down.exr
  succeeds burnish-quantize down.exr --y down --histogram-output down
  succeeds burnish-quantize up.exr --histogram-output up
  succeeds burnish-quantize --histograms up down -n 50 --palette-output both.exr --report r.json
  succeeds burnish-quantize --histograms up -n 50 --palette-output up_p.exr --report up.json
  [ "$(value distinct_input_normals r.json)" = "$(value distinct_input_normals up.json)" ]
  same_bytes both.exr up_p.exr
}

@test "histograms: options that do not go together" {
  inputs
  succeeds burnish-quantize maps/a.png --histogram-output a
  refuses 1 "NORMAL is required, or --histograms" burnish-quantize -o x.exr
  refuses 1 "NORMAL does not go with --histograms" burnish-quantize maps/a.png --histograms a --palette-output p.exr
  refuses 1 "--histograms needs --palette-output" burnish-quantize --histograms a
  refuses 1 "'a' is given twice" burnish-quantize --histograms a a --palette-output p.exr
  refuses 1 "'./a' is given twice" burnish-quantize --histograms a ./a --palette-output p.exr
  refuses 1 "expected files, got the option -n" burnish-quantize --histograms -n 16 --palette-output p.exr
  cp a p.exr
  refuses 1 "'p.exr': is an input" burnish-quantize --histograms p.exr --palette-output p.exr
  rm p.exr
  for option in "-o x.exr" "--output-dir x" "--output-type exr" "--extension png" "-d uint8" "--material ids/a.png" "--mask masks/a.png" \
    "--emit-rgb x.png" "--dither none" "--dither-amount 1" "--palette a" "--y up" "--encoding biased" "--channels xy" \
    "--histogram-output b"; do
    refuses 1 "does not go with --histograms" burnish-quantize --histograms a --palette-output p.exr $option
  done
  for option in "-o x.exr" "--output-dir x" "--output-type exr" "--extension png" "-d uint8" "--palette-output p.exr" "--palette a" "-n 9" \
    "--target-error 1" "--engine spherical" "--material-encoding alpha" "--emit-rgb x.png" "--dither none" "--dither-amount 1"; do
    refuses 1 "does not go with --histogram-output" burnish-quantize maps/a.png --histogram-output x $option
  done
  refuses 5 "--palette-output" burnish-quantize --histograms a --palette-output p.tif
  refuses 1 "is an input" burnish-quantize maps/a.png --histogram-output maps/a.png
}

@test "histograms: files that are none, are damaged, or contradict each other" {
  inputs
  succeeds burnish-quantize maps/a.png --space object --histogram-output object
  succeeds burnish-quantize maps/a.png --space tangent --histogram-output tangent
  refuses 2 "'none'" burnish-quantize --histograms object none --palette-output p.exr
  refuses 3 "'maps/a.png': expected a histogram" burnish-quantize --histograms object maps/a.png --palette-output p.exr
  head -c 300 object >cut
  refuses 3 "'cut': expected a zlib stream" burnish-quantize --histograms cut --palette-output p.exr
  refuses 3 "'tangent': expected normals in object space, as in 'object', got tangent space" \
    burnish-quantize --histograms object tangent --palette-output p.exr
  call burnish-quantize --histograms object tangent --space object --palette-output p.exr
  [ "$status" -eq 0 ]
  grep -qx "burnish-quantize: warning: 'tangent' says that its normals are in tangent space; they are recorded as object, as asked for" err
  refuses 3 "at least one for each of the" burnish-quantize --histograms <(burnish-quantize maps/a.png --material ids/a.png --histogram-output -) -n 2 --palette-output q.exr
}
