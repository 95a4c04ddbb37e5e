#!/usr/bin/env bats
# burnish-render: scenes, paths, frames, auxiliary images, validation, and their wrong uses.

load helpers

# indexed FILE: a 4×4 PNG with a palette of four normals, one material; the first is (0,0,1) up to what 8 bits hold.
indexed() {
  "${PYTHON3:-python3}" - "$1" <<'PYTHON'
import struct, sys, zlib
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
palette = bytes([128, 128, 255, 200, 128, 230, 60, 128, 230, 128, 200, 230])
rows = b"".join(b"\0" + bytes((x + y) % 4 for x in range(4)) for y in range(4))
open(sys.argv[1], "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 3, 0, 0, 0))
                              + chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PYTHON
}

# differ A B [TOLERANCE]: pictures that must not be the same (a bare `!` would not fail a test).
differ() { if same_pixels "$@" >/dev/null; then echo "the same: $*"; return 1; fi; }

# scene [LINE…]: a small quad with both maps, and further lines in its [[object]] table.
scene() {
  [ -e n.png ] || make_image normals 16 16 n.png
  [ -e i.png ] || indexed i.png
  {
    printf '[image]\nwidth = 24\nheight = 16\n[[light]]\ndirection = [1, 1, 2]\n'
    printf '[[object]]\nnormal_map = "n.png"\nindexed_map = "i.png"\n'
    printf '%s\n' "$@"
  } >s.toml
}

@test "a picture as PNG in sRGB and as linear EXR" {
  scene
  succeeds burnish-render s.toml -o x.png
  [ "$("$BURNISH_FIXTURE" info x.png)" = "24 16 3 uint8" ]
  succeeds burnish-render s.toml -o x.exr
  [ "$("$BURNISH_FIXTURE" info x.exr)" = "24 16 3 half" ]
  succeeds burnish-render s.toml -o x.exr -d float
  succeeds burnish-render s.toml -o x16.png -d uint16
  same_pixels x.png x16.png 0.003
  differ x.png x.exr 0.01
}

@test "a flat map under a light at 60 degrees is cos 60" {
  make_image flat 8 8 h.png
  succeeds burnish-normals h.png -o flat.exr
  printf '[image]\nwidth = 2\nheight = 2\n[[light]]\ndirection = [0.8660254037844386, 0, 0.5]\n' >s.toml
  printf '[[object]]\nnormal_map = "flat.exr"\n' >>s.toml
  succeeds burnish-render s.toml -o x.exr -d float
  [ "$("$BURNISH_FIXTURE" texel x.exr 0 0)" = "0.5 0.5 0.5" ]
}

@test "faces without area and texels without a direction are named" {
  "$BURNISH_FIXTURE" mesh sphere 8 ball.obj
  echo "f 1/1 2/2 2/2" >>ball.obj
  make_image holed-normals 8 8 n.exr
  printf '[image]\nwidth = 8\nheight = 8\n[[light]]\ndirection = [0, 0, 1]\n' >s.toml
  printf '[[object]]\nsurface = "mesh"\nmesh = "ball.obj"\nnormal_map = "n.exr"\n' >>s.toml
  call burnish-render s.toml -o x.png
  [ "$(cat err)" = "burnish-render: warning: 'ball.obj': 1 face without area is left out
burnish-render: warning: 'n.exr': 1 texel holds no direction and counts as (0,0,1)" ]
}

@test "--path overrides the scene's" {
  scene
  succeeds burnish-render s.toml -o a.png --report a.json
  [ "$(value path a.json)" = analytic ]
  succeeds burnish-render s.toml --path palette -o p.png --report p.json
  [ "$(value path p.json)" = palette ]
  fits_schema render a.json p.json
  differ a.png p.png
}

@test "the palette without a normal map beside it equals its twin" {
  scene
  sed -i '/^normal_map/d' s.toml
  succeeds burnish-render s.toml --path analytic -o a.exr -d float
  succeeds burnish-render s.toml --path palette -o p.exr -d float
  same_pixels a.exr p.exr 1e-6
}

@test "frames are numbered, and the first is the scene itself" {
  scene
  succeeds burnish-render s.toml -o one.png
  succeeds burnish-render s.toml --frames 3 -o f_%04d.png --report r.json
  same_bytes one.png f_0000.png
  differ f_0000.png f_0001.png
  [ -s f_0002.png ]
  [ ! -e f_0003.png ]
  fits_schema render r.json
  refuses 1 "%d or %04d" burnish-render s.toml --frames 2 -o g.png
  refuses 1 "" burnish-render s.toml --frames 0 -o g_%d.png
  refuses 1 "--frames: expected at most 4000 files in one run, got 8000" burnish-render s.toml --frames 4000 --aov uv -o g_%d.png
}

@test "auxiliary images beside the picture" {
  scene
  succeeds burnish-render s.toml --path palette --aov normal,index,uv -o x.png --report r.json
  [ "$("$BURNISH_FIXTURE" info x.normal.exr)" = "24 16 3 float" ]
  [ "$("$BURNISH_FIXTURE" info x.index.exr)" = "24 16 1 float" ]
  [ "$("$BURNISH_FIXTURE" texel x.index.exr 0 0)" = "-1" ]
  [ "$("$BURNISH_FIXTURE" texel x.index.exr 5 1)" = "0" ]
  [ -s x.uv.exr ]
  fits_schema render r.json
  refuses 1 "got 'albedo'" burnish-render s.toml --aov albedo -o y.png
  refuses 1 "twice" burnish-render s.toml --aov uv,uv -o y.png
  refuses 1 "--output: standard output takes one picture" burnish-render s.toml --aov uv -o - --output-type png
}

@test "standard output, and a scene on standard input" {
  scene
  succeeds burnish-render s.toml -o x.png
  burnish-render - -o - --output-type png <s.toml >piped.png
  same_bytes x.png piped.png
}

@test "depfile and report name the scene and every map" {
  scene
  mkdir sub
  mv s.toml n.png i.png sub
  succeeds burnish-render sub/s.toml -o x.png --depfile x.d --report r.json
  [ "$(cat x.d)" = "x.png: sub/s.toml sub/n.png sub/i.png" ]
  fits_schema render r.json
}

@test "the same bytes for any thread count" {
  scene
  for j in 1 2 8; do succeeds burnish-render s.toml --path palette --aov normal -o "$j.png" -j $j; done
  same_bytes 1.png 2.png
  same_bytes 1.png 8.png
  same_bytes 1.normal.exr 8.normal.exr
  for j in 1 2; do succeeds burnish-render --validate --path palette s.toml --report-dir v$j -j $j; done
  for f in palette.png analytic.png difference.png report.html; do same_bytes v1/$f v2/$f; done
}

@test "--validate writes pictures and reports" {
  scene
  printf '[validate]\nmin_psnr_db = 1\n' >>s.toml
  succeeds burnish-render --validate --path palette s.toml --report-dir v --report r.json --depfile v.d
  [ "$(ls v | tr '\n' ' ')" = "analytic.png difference.png palette.png report.html report.json " ]
  fits_schema render r.json
  [ "$(value passed r.json)" = True ]
  [ "$(value max_abs r.json)" = "$(value max_abs v/report.json)" ]
  grep -q '^v/palette.png: s.toml n.png i.png$' v.d
  grep -q 'data:image/png;base64,' v/report.html
  if grep -qF "$BATS_TEST_TMPDIR" v/report.html v/*.png; then return 1; fi
}

@test "--validate of equal pictures: null decibels" {
  scene
  sed -i '/^normal_map/d' s.toml
  printf '[validate]\nmax_abs = 1e-6\nmin_psnr_db = 100\n' >>s.toml
  succeeds burnish-render --validate --path palette s.toml --report-dir v --report r.json
  fits_schema render r.json
  [ "$(value psnr_db r.json)" = None ]
}

@test "a tolerance that is not met: exit 10, and everything but the depfile is written" {
  scene
  printf '[validate]\nmax_abs = 0.001\n' >>s.toml
  call burnish-render --validate --path palette s.toml --report-dir v --report r.json --depfile v.d
  [ "$status" -eq 10 ]
  [ ! -e v.d ]
  [ "$(wc -l <err)" -eq 1 ]
  grep -q "^burnish-render: error: 's.toml': max_abs: expected at most 0.001, got 0\." err
  [ -s v/report.json ]
  [ -s v/report.html ]
  [ -s v/difference.png ]
  [ "$(value passed r.json)" = False ]
}

@test "wrong uses of --validate leave no folder" {
  scene
  refuses 1 "needs --report-dir" burnish-render --validate s.toml
  refuses 1 "goes with --validate" burnish-render s.toml -o x.png --report-dir v
  refuses 1 "does not go with --validate" burnish-render --validate s.toml --report-dir v -o x.png
  refuses 1 "does not go with --validate" burnish-render --validate s.toml --report-dir v --frames 2
  refuses 1 "is the twin itself" burnish-render --validate s.toml --report-dir v
  refuses 2 "'s.toml/v': cannot be made a directory" burnish-render --validate --path palette s.toml --report-dir s.toml/v
  refuses 2 "" burnish-render --validate --path palette s.toml --report-dir s.toml
  echo nonsense >i.png
  refuses 3 "'i.png'" burnish-render --validate --path palette s.toml --report-dir v
  refuses 3 "'i.png'" burnish-render --validate --path palette s.toml --report-dir v/of/this
  indexed i.png
  succeeds burnish-render --validate --path palette s.toml --report-dir v/of/this
  [ -s v/of/this/report.html ]
}

@test "scenes that are wrong: exit 3, with line and key" {
  scene 'colour = 3'
  refuses 3 "'s.toml': line 9: 'object[0].colour': unknown key" burnish-render s.toml -o x.png
  scene 'surface = "cube"'
  refuses 3 "expected quad|sphere|torus|mesh, got 'cube'" burnish-render s.toml -o x.png
  scene 'size = [1, 0]'
  refuses 3 "'object[0].size': expected an array of 2, each a number above 0, got 0" burnish-render s.toml -o x.png
  echo 'this is no TOML' >s.toml
  refuses 3 "'s.toml': line 1" burnish-render s.toml -o x.png
  : >s.toml
  refuses 3 "at least one [[object]]" burnish-render s.toml -o x.png
}

@test "files that are missing: exit 2" {
  scene
  refuses 2 "'none.toml'" burnish-render none.toml -o x.png
  mkdir dir.toml
  refuses 2 "'dir.toml'" burnish-render dir.toml -o x.png
  mv n.png gone.png
  refuses 2 "'n.png'" burnish-render s.toml -o x.png
  mv gone.png n.png
  rm i.png
  refuses 2 "'i.png'" burnish-render s.toml -o x.png
}

@test "a tangent-space palette on a sphere: exit 3" {
  scene 'surface = "sphere"'
  refuses 3 "'i.png': a tangent-space palette can be shaded on a flat surface only" burnish-render s.toml --path palette -o x.png
  succeeds burnish-render s.toml -o x.png
  scene 'surface = "sphere"' 'normal_space = "object"'
  succeeds burnish-render s.toml --path palette -o x.png
}

@test "paths that do not fit: unknown, without their map, table or object" {
  scene
  refuses 1 "--path: expected a path, one of analytic, palette" burnish-render s.toml --path palete -o x.png
  refuses 3 "path 'ptm' needs the table of light-factor, [tables] light_factor" burnish-render s.toml --path ptm -o x.png
  burnish-lut light-factor -o lf.exr
  printf '[tables]\nlight_factor = "lf.exr"\n' >>s.toml
  refuses 3 "path 'ptm-brdf' needs an [object.ptm], and the object with 'i.png' has none" burnish-render s.toml --path ptm-brdf -o x.png
  scene
  sed -i '/^indexed_map/d' s.toml
  refuses 3 "needs an 'indexed_map'" burnish-render s.toml --path palette -o x.png
  scene
  sed -i '1i shadows = "cast"' s.toml
  succeeds burnish-render s.toml --path analytic -o x.png
  refuses 3 "path 'palette' knows no shadows, got shadows = 'cast'" burnish-render s.toml --path palette -o x.png
}

@test "mip levels that are not there: exit 3" {
  scene 'mip = "nearest"'
  refuses 3 "'i.png': expected a chain of mip levels" burnish-render s.toml --path palette -o x.png
}

@test "pictures of other types, and outputs that are inputs" {
  scene
  refuses 5 "'x.tif': a picture is written as PNG or EXR, not TIFF (--output)" burnish-render s.toml -o x.tif
  refuses 5 "standard output: a picture is written as PNG or EXR, not TIFF (--output-type)" \
    burnish-render s.toml -o - --output-type tiff
  refuses 5 "not BMP" burnish-render s.toml -o x.bmp
  refuses 5 "half" burnish-render s.toml -o x.png -d half
  refuses 1 "is an input" burnish-render s.toml -o n.png
  refuses 1 "--output" burnish-render s.toml
}

@test "a key of very many parts is refused" {
  printf '[%s]\n' "$(printf 'a.%.0s' $(seq 50000))a" >deep.toml
  refuses 3 "line 1" burnish-render deep.toml -o x.png
}
