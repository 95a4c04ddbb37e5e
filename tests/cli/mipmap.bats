#!/usr/bin/env bats
# burnish-mipmap: every option, and every way of using it wrongly. What holds for all tools is in every_tool.bats; that indices are
# the best ones is tested in unit/palette_index_mips_test.cpp.

load helpers

# A negated command never fails a test: differ A B does.
differ() { if cmp -s "$1" "$2"; then echo "$1 is $2"; return 1; fi; }

inputs() {
  make_image normals 64 48 n.png
  make_image ids 64 48 ids.png
  burnish-quantize n.png -n 64 -o q.exr
  burnish-quantize n.png -n 64 -o q.png
}

# levels REPORT: width x height of each.
levels() {
  "${PYTHON3:-python3}" -c 'import json, sys
print(*("%dx%d" % (l["width"], l["height"]) for l in json.load(open(sys.argv[1]))["stats"]["levels"]))' "$1"
}

# no_worse A B: whether no level of one report has a larger error than in another.
no_worse() {
  "${PYTHON3:-python3}" - "$@" <<'PYTHON'
import json, sys
a, b = ([l["rms_deg"] for l in json.load(open(f))["stats"]["levels"]] for f in sys.argv[1:])
assert len(a) == len(b) and all(x <= y + 1e-4 for x, y in zip(a[1:], b[1:])), (a, b)
PYTHON
}

@test "the whole chain by default, down to one texel" {
  inputs
  succeeds burnish-mipmap q.exr -o m.exr --report r.json
  fits_schema mipmap r.json
  [ "$(levels r.json)" = "64x48 32x24 16x12 8x6 4x3 2x1 1x1" ]
  for size in "1 1" "1 9" "7 1" "33 17"; do
    # shellcheck disable=SC2086
    make_image normals $size odd.png
    succeeds burnish-quantize odd.png -n 16 -o odd.exr
    succeeds burnish-mipmap odd.exr -o m.exr --report r.json
    fits_schema mipmap r.json
  done
}

@test "EXR and PNG give the same chain, and a chain is as good as its base" {
  inputs
  succeeds burnish-mipmap q.exr -o a.exr
  succeeds burnish-mipmap q.png -o b.exr
  same_bytes a.exr b.exr
  succeeds burnish-mipmap a.exr -o b.exr
  same_bytes a.exr b.exr
}

@test "--levels" {
  inputs
  succeeds burnish-mipmap q.exr --levels 3 --split 'm_%d.png' --report r.json
  fits_schema mipmap r.json
  [ "$(levels r.json)" = "64x48 32x24 16x12" ]
  [ -e m_2.png ]
  [ ! -e m_3.png ]
  succeeds burnish-mipmap q.exr --levels 7 -o all.exr
  succeeds burnish-mipmap q.exr -o m.exr
  same_bytes all.exr m.exr
  succeeds burnish-mipmap q.exr --levels 1 -o one.exr
  same_bytes one.exr q.exr
  succeeds burnish-mipmap q.exr --levels 1 -o one.png
  same_bytes one.png q.png
  refuses 1 "1 to 7" burnish-mipmap q.exr --levels 8 -o x.exr
  for junk in 0 -1 33 some 1.5 ""; do refuses 1 "--levels" burnish-mipmap q.exr --levels "$junk" -o x.exr; done
  refuses 5 "one level or all" burnish-mipmap q.exr --levels 3 -o x.exr
}

@test "--split writes one file a level, beside -o or alone" {
  inputs
  succeeds burnish-mipmap q.exr --split 'm_%d.png' -o m.exr --report r.json
  fits_schema mipmap r.json
  same_bytes m_0.png q.png
  for l in 0 1 2 3 4 5 6; do [ -s m_$l.png ]; done
  [ "$("$BURNISH_FIXTURE" info m_1.png | cut -d' ' -f1,2)" = "32 24" ]
  succeeds burnish-mipmap q.exr --split 'e_%02d.exr' --levels 2
  same_bytes e_00.exr q.exr
  [ -s e_01.exr ]
  for pattern in m.png 'm_%s.png' 'm_%d_%d.png' 'm_%' 'm_%d%%.png' 'm_%1234d.png' 'm_%-2d.png'; do
    refuses 1 "--split" burnish-mipmap q.exr --split "$pattern"
  done
  refuses 5 "EXR, PNG, KTX2 or DDS" burnish-mipmap q.exr --split 'm_%d.tif'
  refuses 5 "'f_0.png': PNG holds indices" burnish-mipmap q.exr --split 'f_%d.png' -d float
  refuses 1 "is an input" burnish-mipmap m_1.png --split 'm_%d.png'
  refuses 1 "twice" burnish-mipmap q.exr --split 'x_%d.exr' -o x_1.exr
  refuses 2 "'nowhere/x_0.png'" burnish-mipmap q.exr --split 'nowhere/x_%d.png'
}

@test "--from and --source" {
  inputs
  succeeds burnish-mipmap q.exr -o m.exr --report level.json
  succeeds burnish-mipmap q.exr -o x.exr --from level
  same_bytes m.exr x.exr
  succeeds burnish-mipmap q.exr -o x.exr --from base --report base.json
  no_worse base.json level.json
  succeeds burnish-mipmap q.exr -o x.exr --source n.png --report source.json
  fits_schema mipmap source.json
  differ m.exr x.exr
  refuses 1 "--source" burnish-mipmap q.exr -o y.exr --source n.png --from level
  refuses 1 "expected level|base" burnish-mipmap q.exr -o y.exr --from above
  make_image normals 64 47 small.png
  refuses 3 "'small.png'" burnish-mipmap q.exr -o y.exr --source small.png
  refuses 3 "3 channels" burnish-mipmap q.exr -o y.exr --source ids.png
  refuses 2 "'none.png'" burnish-mipmap q.exr -o y.exr --source none.png
}

@test "--y, --encoding and --channels are those of the source" {
  inputs
  make_image normals 64 48 biased.exr float
  succeeds burnish-mipmap q.exr -o a.exr --source n.png
  succeeds burnish-mipmap q.exr -o b.exr --source n.png --y up --encoding biased --channels rgb
  same_bytes a.exr b.exr
  succeeds burnish-mipmap q.exr -o b.exr --source n.png --y down
  differ a.exr b.exr
  succeeds burnish-mipmap q.exr -o b.exr --source biased.exr --encoding biased --report r.json
  succeeds burnish-mipmap q.exr -o b.exr --source n.png --channels xy
  refuses 1 "expected up|down" burnish-mipmap q.exr -o y.exr --y left
}

@test "materials never mix" {
  inputs
  succeeds burnish-quantize n.png --material ids.png -n 32 -o q.exr
  for option in "--from level" "--from base" "--source n.png"; do
    # shellcheck disable=SC2086
    succeeds burnish-mipmap q.exr $option --split 'm_%d.png' --report r.json
    fits_schema mipmap r.json
    "${PYTHON3:-python3}" - <<'PYTHON'
import json, struct, zlib
for level in range(4):  # four stripes: down to 8 texels across, every one lies in one of them
    data, at, pixels = open(f"m_{level}.png", "rb").read(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR": width, height = struct.unpack(">II", body[:8])
        if kind == b"iTXt": materials = json.loads(zlib.decompress(body[len(b"burnish") + 5:]))["materials"]
        if kind == b"IDAT": pixels += body
        at += size + 12
    pixels = zlib.decompress(pixels)
    for y in range(height):
        row = pixels[y * (width + 1):(y + 1) * (width + 1)]
        assert row[0] == 0, "a filter"
        for x in range(width):
            m = [m["id"] for m in materials if m["first"] <= row[1 + x] < m["first"] + m["count"]]
            assert m == [4 * x // width], (level, x, y, row[1 + x], m)
PYTHON
  done
}

@test "--kind" {
  inputs
  succeeds burnish-mipmap q.exr -o a.exr
  succeeds burnish-mipmap q.exr -o b.exr --kind indexed
  same_bytes a.exr b.exr
  refuses 1 "--kind: expected indexed|normal|material|ptm|colour, got 'picture'" burnish-mipmap q.exr -o x.exr --kind picture
  refuses 5 "--kind colour is not there yet" burnish-mipmap q.exr -o x.exr --kind colour
  refuses 3 "expected a polynomial texture map" burnish-mipmap q.exr -o x.exr --kind ptm
  succeeds burnish-mipmap --help
  grep -q -- '--kind indexed|normal|material|ptm|colour' out
}

@test "the kind is told from the map" {
  inputs
  burnish-material --model ward --alpha-x 0.2 --alpha-y 0.4 --normal n.png --encode float --extension exr -o m
  burnish-mipmap q.exr -o chain.exr --palette-output p.exr
  for map in q.exr q.png chain.exr n.png m; do
    case $map in n.png) kind=normal ;; m) kind=material ;; *) kind=indexed ;; esac
    mkdir -p told given
    succeeds burnish-mipmap $map -o told/x.exr
    succeeds burnish-mipmap $map -o given/x.exr --kind $kind
    diff -r told given
    rm -r told given
  done
  refuses 1 "'ids.png': expected --kind to say what it is, which 1 channel does not" burnish-mipmap ids.png -o x.exr
  refuses 1 "'m_t.exr': expected the PREFIX of material textures, got one of them" burnish-mipmap m_t.exr -o x.exr
  refuses 2 "'none'" burnish-mipmap none -o x.exr
  refuses 3 "expected an indexed normal map" burnish-mipmap p.exr -o x.exr
  cp q.exr old.ptm
  succeeds burnish-mipmap old.ptm -o x.exr  # its bytes say what it is
  cp n.png old.ptm
  succeeds burnish-mipmap old.ptm -o y.exr
  succeeds burnish-mipmap n.png -o z.exr
  same_bytes y.exr z.exr
}

@test "options of another kind are refused" {
  inputs
  refuses 1 "--roughness goes with --kind normal" burnish-mipmap q.exr -o x.exr --roughness 0.2 --roughness-output y.exr
  refuses 1 "--khr goes with --kind material" burnish-mipmap q.exr -o x.exr --khr
  for option in "--from base" "--source n.png" "--palette q.exr" "--palette-output y.exr"; do
    # shellcheck disable=SC2086
    refuses 1 "${option% *} goes with --kind indexed" burnish-mipmap n.png -o x.exr $option
  done
  refuses 1 "--khr goes with --kind material" burnish-mipmap n.png -o x.exr --khr
}

@test "what cannot be written: exit 5" {
  inputs
  refuses 5 "PNG holds one level" burnish-mipmap q.exr -o x.png
  for ext in tif tga bmp; do refuses 5 "EXR, PNG, KTX2 or DDS" burnish-mipmap q.exr -o x.$ext; done
  refuses 5 "EXR, PNG, KTX2 or DDS" burnish-mipmap q.exr -o - --output-type tiff
  for d in uint8 uint16 half float; do refuses 5 "not $d" burnish-mipmap q.exr -o x.exr -d $d; done
  refuses 5 "not uint16" burnish-mipmap q.exr --levels 1 -o x.png -d uint16
  succeeds burnish-mipmap q.exr --levels 1 -o x.png -d uint8
}

@test "inputs that are no indexed map, damaged or missing" {
  inputs
  refuses 3 "expected an indexed normal map" burnish-mipmap ids.png -o x.exr --kind indexed
  echo "not an image" >junk.png
  refuses 3 "'junk.png'" burnish-mipmap junk.png -o x.exr --kind indexed
  refuses 2 "'none.exr'" burnish-mipmap none.exr -o x.exr
  for type in exr png; do
    size=$(stat -c %s q.$type)
    for part in 10 50 90; do
      head -c $((size * part / 100)) q.$type >cut.$type
      refuses 3 "'cut.$type'" burnish-mipmap cut.$type -o x.exr --kind indexed
    done
  done
}

@test "without -o or --split there is nothing to write to" {
  inputs
  refuses 1 "--output or --split" burnish-mipmap q.exr
  refuses 1 "is an input" burnish-mipmap q.exr -o q.exr
}

@test "pipelines through -" {
  inputs
  succeeds burnish-mipmap q.exr -o m.exr
  for type in exr png; do
    burnish-mipmap - -o - --output-type exr <q.$type >piped
    same_bytes piped m.exr
  done
  burnish-mipmap - -o - --output-type png --levels 1 <q.png | cmp - q.png
  refuses 1 "--output-type" burnish-mipmap q.exr -o -
}

@test "the same bytes for any thread count, run and folder" {
  make_image normals 301 205 n.png
  make_image ids 301 205 ids.png
  succeeds burnish-quantize n.png --material ids.png -n 300 -o q.exr
  mkdir a b
  for option in "--from level" "--from base" "--source n.png"; do
    # shellcheck disable=SC2086
    succeeds burnish-mipmap q.exr $option -o a/m.exr -j 1
    for j in 2 8; do
      (cd b && succeeds burnish-mipmap "$OLDPWD/q.exr" ${option/n.png/$OLDPWD/n.png} -o m.exr -j $j)
      same_bytes a/m.exr b/m.exr
    done
  done
}

@test "--depfile names every file that was read" {
  inputs
  succeeds burnish-mipmap q.exr --source n.png -o m.exr --depfile m.d
  [ "$(cat m.d)" = "m.exr: q.exr n.png" ]
}
