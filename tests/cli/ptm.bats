#!/usr/bin/env bats
# burnish-ptm convert, relight, normals and info

load helpers
load ptm_inputs

lights="0,0,1 0.5,0.3,0.6 -0.7,0.2,0.3"

# shows_same A B TOLERANCE: under all lights, of 255.
shows_same() {
  local light
  for light in $lights; do
    succeeds burnish-ptm relight "$1" --light "$light" -o shown_a.exr -d float
    succeeds burnish-ptm relight "$2" --light "$light" -o shown_b.exr -d float
    same_pixels shown_a.exr shown_b.exr "$("$PYTHON3" -c "print($3 / 255)")" || return 1
  done
}

@test "without a verb, or with another, nothing is done" {
  refuses 1 "required" burnish-ptm
  refuses 1 "" burnish-ptm polish a.ptm -o b.ptm
  refuses 1 "" burnish-ptm info
  make_ptm RGB 4 4 a.ptm
  refuses 1 "" burnish-ptm info a.ptm b.ptm
  refuses 1 "" burnish-ptm convert a.ptm
  refuses 1 "" burnish-ptm convert a.ptm -o b.exr --light 0,0,1
}

@test "each verb has its own help, with an example" {
  for verb in fit brdf convert relight normals info; do
    succeeds burnish-ptm $verb --help
    grep -q "burnish-ptm $verb " out
    grep -q "Example:" out
  done
}

@test "common options stand before or behind the verb" {
  make_ptm RGB 4 4 a.ptm
  succeeds burnish-ptm --report r.json convert a.ptm -o b.exr
  succeeds burnish-ptm convert a.ptm -o b.exr --report s.json --depfile d
  fits_schema ptm r.json s.json
  grep -q '^b.exr: a.ptm' d
}

@test "convert: what is in bytes stays as it is" {
  for kind in LRGB RGB; do
    make_ptm $kind 13 7 a.ptm
    succeeds burnish-ptm convert a.ptm -o b.ptm
    same_bytes a.ptm b.ptm
  done
  succeeds burnish-ptm convert a.ptm -o t/
  [ "$(ls t | tr '\n' ' ')" = "abc_blue.png abc_green.png abc_red.png def_blue.png def_green.png def_red.png ptm.json " ]
  succeeds burnish-ptm convert t/ -o c.ptm
  same_bytes a.ptm c.ptm
  succeeds burnish-ptm convert t -o u/
  diff -r t u
}

@test "convert: floats hold what bytes hold, and bytes nearly what floats hold" {
  for kind in LRGB RGB; do
    make_ptm $kind 33 18 a.ptm
    succeeds burnish-ptm convert a.ptm -o a.exr --report r.json
    fits_schema ptm r.json
    shows_same a.ptm a.exr 0.0001
    succeeds burnish-ptm convert a.exr -o b.ptm
    shows_same a.ptm b.ptm 0.6
    succeeds burnish-ptm convert a.exr -o t/
    shows_same a.ptm t 0.6
  done
}

@test "convert: textures as the shader of the book reads them" {
  make_ptm LRGB 9 5 a.ptm
  succeeds burnish-ptm convert a.ptm -o t/
  succeeds burnish-ptm relight a.ptm --light 0.48,-0.36,0.8 -o lit.exr -d float
  for texel in "0 0" "8 4" "3 2"; do
    for image in abc_red def_red abc_green def_green abc_blue def_blue; do
      "$BURNISH_FIXTURE" texel t/$image.png $texel
    done >texels
    "$BURNISH_FIXTURE" texel lit.exr $texel >>texels
    "$PYTHON3" - <<'PYTHON'
import json, re
j = json.load(open("t/ptm.json"))
assert (j["width"], j["height"], j["type"]) == (9, 5, "lrgb")
rows = [[float(v) for v in re.findall(r"[-+0-9.e]+", line)] for line in open("texels")]
scale = max(max(r) for r in rows[:6]) > 1 and 255 or 1
u, v = 0.48, -0.36
for c in range(3):
    a = [(t / scale - b) * s for t, b, s in zip(rows[2 * c], j["abc_bias"], j["abc_scale"])]
    d = [(t / scale - b) * s for t, b, s in zip(rows[2 * c + 1], j["def_bias"], j["def_scale"])]
    light = a[0] * u * u + a[1] * v * v + a[2] * u * v + d[0] * u + d[1] * v + d[2]
    assert abs(light - rows[6][c]) < 0.004, (light, rows[6][c])
PYTHON
  done
}

@test "convert: JPEG planes are smaller and nearly the same" {
  for kind in LRGB RGB; do
    make_ptm $kind 64 48 a.ptm
    succeeds burnish-ptm convert a.ptm -o j.ptm --jpeg 95
    [ "$(sed -n 2p j.ptm | tr -d '\0')" = PTM_FORMAT_JPEG_$kind ]
    [ "$(stat -c %s j.ptm)" -lt "$(stat -c %s a.ptm)" ]
    shows_same a.ptm j.ptm 2.5
    succeeds burnish-ptm convert j.ptm -o k.ptm
    shows_same j.ptm k.ptm 0.0001
  done
  refuses 1 "--jpeg is for a .ptm" burnish-ptm convert a.ptm -o b.exr --jpeg 95
  refuses 1 "--jpeg: expected an integer from 1 to 100, got '0'" burnish-ptm convert a.ptm -o b.ptm --jpeg 0
}

@test "convert: pipelines through -" {
  make_ptm LRGB 6 5 a.ptm
  burnish-ptm convert - -o - --output-type exr <a.ptm >a.exr
  burnish-ptm convert a.ptm -o b.exr
  same_bytes a.exr b.exr
  burnish-ptm convert - -o - --output-type ptm <a.ptm | cmp - a.ptm
  burnish-ptm relight - --light 0,0,1 -o - --output-type png <a.exr >p.png
  succeeds burnish-ptm relight a.ptm --light 0,0,1 -o q.png
  same_bytes p.png q.png
  refuses 1 "standard output: needs --output-type ptm or exr" burnish-ptm convert a.ptm -o -
  refuses 1 "'x.ptm': --output-type exr is for standard output" burnish-ptm convert a.ptm -o x.ptm --output-type exr
}

@test "convert: outputs that are none" {
  make_ptm LRGB 6 5 a.ptm
  refuses 5 "'x.png': a polynomial texture map is written as .ptm, .exr or textures behind a PREFIX/, not '.png'" \
    burnish-ptm convert a.ptm -o x.png
  refuses 5 "not a file without extension" burnish-ptm convert a.ptm -o x
  refuses 1 "a.ptm" burnish-ptm convert a.ptm -o a.ptm
  refuses 2 "none" burnish-ptm convert a.ptm -o none/x.ptm
  cp a.ptm file
  refuses 2 "file" burnish-ptm convert a.ptm -o file/
}

@test "a map that is cut short is refused, and nothing left behind" {
  make_ptm LRGB 40 40 a.ptm
  head -c 5000 a.ptm >cut.ptm
  refuses 3 "'cut.ptm': expected 14400 bytes for 40x40 texels" burnish-ptm convert cut.ptm -o t/
  refuses 3 "'cut.ptm'" burnish-ptm relight cut.ptm --light 0,0,1 -o x.png
  refuses 3 "'cut.ptm'" burnish-ptm normals cut.ptm -o x.png
  refuses 3 "'cut.ptm'" burnish-ptm info cut.ptm
}

@test "files of other kinds are refused by name" {
  make_image bumps 8 8 n.png
  make_image bumps 8 8 n.exr
  refuses 3 "'n.png': expected a polynomial texture map, which begins with PTM_1.2" burnish-ptm info n.png
  refuses 3 "'n.exr': expected a polynomial texture map, whose attribute burnish:ptm is lrgb or rgb, got none" burnish-ptm info n.exr
  refuses 2 "'none.ptm'" burnish-ptm info none.ptm
  for format in LUM PTM_LUT PTM_C_LUT JPEGLS_RGB JPEGLS_LRGB; do
    printf 'PTM_1.2\nPTM_FORMAT_%s\n1\n1\n1 1 1 1 1 1\n0 0 0 0 0 0\nabcdefghi' $format >a.ptm
    refuses 5 "got PTM_FORMAT_$format" burnish-ptm info a.ptm
  done
}

@test "textures whose ptm.json or images do not fit are refused" {
  make_ptm RGB 6 5 a.ptm
  succeeds burnish-ptm convert a.ptm -o good/
  damage() { # SED-SCRIPT: of ptm.json, on one line
    rm -rf t && cp -r good t
    tr -d '\n' <good/ptm.json | sed "$1" >t/ptm.json
  }
  damage 's/"width"/"with"/' && refuses 3 "'t/ptm.json': expected a member width, got none" burnish-ptm info t
  damage 's/"width": *6/"width": 7/' && refuses 3 "'t/abc_red.png': expected 7x5 texels as in 't/ptm.json', got 6x5" burnish-ptm info t
  damage 's/"height": *5/"height": -5/' && refuses 3 "expected height from 1 to 1048576, got -5" burnish-ptm info t
  damage 's/"height": *5/"height": 1e9/' && refuses 3 "expected height from 1 to 1048576" burnish-ptm info t
  damage 's/"type": *"rgb"/"type": "lum"/' && refuses 3 "expected type lrgb or rgb" burnish-ptm info t
  damage 's/"abc_scale": *\[[^]]*\]/"abc_scale": [1, 2]/' && refuses 3 "expected abc_scale of three numbers, got [1,2]" burnish-ptm info t
  damage 's/"def_bias": *\[[^]]*\]/"def_bias": [1, 2, "3"]/' && refuses 3 "expected def_bias of three numbers" burnish-ptm info t
  damage 's/"abc_scale": *\[/&1e300, /; s/\(1e300, [^]]*\),[^],]*\]/\1]/' &&
    refuses 3 "'t/ptm.json': expected coefficients that floats hold" burnish-ptm relight t --light 0,0,1 -o x.png
  damage 's/}//' && refuses 3 "'t/ptm.json': expected a JSON object" burnish-ptm info t
  damage '' && rm t/def_blue.png && refuses 2 "'t/def_blue.png'" burnish-ptm info t
  damage '' && make_image bumps 6 5 t/def_red.png uint16 && refuses 3 "'t/def_red.png': expected 3 channels of uint8" burnish-ptm info t
  damage '' && rm t/ptm.json && refuses 2 "'t/ptm.json'" burnish-ptm info t
  rm -rf t && mkdir t && refuses 2 "'t/ptm.json'" burnish-ptm relight t --light 0,0,1 -o x.png
}

@test "textures of other programs may have any bias" {
  make_ptm RGB 6 5 a.ptm
  succeeds burnish-ptm convert a.ptm -o t/
  succeeds burnish-ptm relight t --light 0,0,1 -o a.exr -d float
  tr -d '\n' <t/ptm.json | sed 's/"def_bias": *\[[^]]*\]/"def_bias": [0.5, 0.5, 0.5]/' >j && mv j t/ptm.json
  succeeds burnish-ptm relight t --light 0,0,1 -o b.exr -d float
  # (−300/255 − 0.5) · 0.3 less
  texel=$("$BURNISH_FIXTURE" texel a.exr 2 2)
  "$BURNISH_FIXTURE" texel b.exr 2 2 >b
  "$PYTHON3" -c "
import re, sys
a, b = ([float(v) for v in re.findall(r'[-+0-9.e]+', t)] for t in (sys.argv[1], open('b').read()))
assert all(abs(x - y - (300 / 255 + 0.5) * 0.3) < 1e-5 for x, y in zip(a, b)), (a, b)" "$texel"
}

@test "relight: closed form, clipped in integers and whole in floats" {
  # L = 100 + 200 u, colour 255, 51, 0.
  printf 'PTM_1.2\nPTM_FORMAT_LRGB\n1\n1\n1 1 1 200 1 100\n0 0 0 0 0 0\n\0\0\0\1\0\1\377\063\0' >a.ptm
  succeeds burnish-ptm relight a.ptm --light 0.6,0,0.8 -o a.exr -d float
  texel_is "0.862745 0.172549 0" a.exr 0 0 0.00001
  succeeds burnish-ptm relight a.ptm --light 3,0,4 -o b.exr -d float
  same_bytes a.exr b.exr
  succeeds burnish-ptm relight a.ptm --light -0.8,0,0.6 -o n.exr -d float --report r.json
  texel_is "-0.235294 -0.0470588 0" n.exr 0 0 0.00001
  [ "$(value clipped_samples r.json)" = 0 ]
  succeeds burnish-ptm relight a.ptm --light -0.8,0,0.6 -o n.png --report r.json
  fits_schema ptm r.json
  texel_is "0 0 0" n.png 0 0
  [ "$(value clipped_samples r.json)" = 2 ]
}

@test "relight: lights that are none" {
  make_ptm RGB 4 4 a.ptm
  for light in 0,0,0 0,0,-1 1,0,0 0,0 a,b,c 0,0,nan 0,0,inf 1e-320,0,1e-320 0,0,1,0 ""; do
    refuses 1 "--light: expected a direction from above the surface" burnish-ptm relight a.ptm --light "$light" -o x.png
  done
  refuses 1 "--light" burnish-ptm relight a.ptm -o x.png
  refuses 5 "half" burnish-ptm relight a.ptm --light 0,0,1 -o x.png -d half
}

@test "normals: of a matte plane its own, of nothing (0,0,1)" {
  # L = 255 (n·l) where l_z = √(1 − u² − v²) is near 1 − ½(u² + v²): brightest at (n_x, n_y)/n_z.
  printf 'PTM_1.2\nPTM_FORMAT_LRGB\n2\n1\n60 60 1 72 48 1\n2 2 0 0 0 0\n\1\1\0\1\0\377\2\2\0\0\0\377\1\1\1\1\1\1' >a.ptm
  succeeds burnish-ptm normals a.ptm -o n.exr -d float --report r.json
  fits_schema ptm r.json
  texel_is "0.6 0 0.8" n.exr 0 0 0.00001
  texel_is "0 0 1" n.exr 1 0 0
  [ "$(value flat_texels r.json) $(value horizon_texels r.json)" = "1 0" ]
  succeeds burnish-ptm normals a.ptm -o d.exr -d float --y down
  succeeds burnish-ptm normals a.ptm -o n.png
  texel_is "0.8 0.501961 0.901961" n.png 0 0 0.00001
  call burnish-quantize n.png -o q.exr  # whose space the file says
  [ "$status" -eq 0 ]
  refuses 5 "uint8" burnish-ptm normals a.ptm -o x.png --encoding signed
}

@test "info: for people and for programs" {
  make_ptm LRGB 12 5 a.ptm
  succeeds burnish-ptm info a.ptm --report r.json
  fits_schema ptm r.json
  grep -q '^PTM_1.2 LRGB, lrgb, 12x5 texels$' out
  grep -qE '^u\^2 .* 0.25 +260$' out
  [ "$(value format r.json)" = "PTM_1.2 LRGB" ]
  succeeds burnish-ptm info a.ptm --report -
  "$PYTHON3" -c "import json; json.load(open('out'))"
  succeeds burnish-ptm convert a.ptm -o t/
  succeeds burnish-ptm info t --report r.json
  fits_schema ptm r.json
  grep -q '^textures, lrgb, 12x5 texels$' out
  succeeds burnish-ptm convert a.ptm -o a.exr
  succeeds burnish-ptm info a.exr --report r.json
  fits_schema ptm r.json
  grep -q '^EXR, lrgb, 12x5 texels$' out
  succeeds burnish-ptm convert a.ptm -o j.ptm --jpeg 90
  succeeds burnish-ptm info j.ptm
  grep -q '^PTM_1.2 JPEG_LRGB' out
}

@test "the same bytes for any thread count, run and folder" {
  make_ptm LRGB 300 200 a.ptm
  mkdir elsewhere
  for threads in 1 2 7; do
    (
      cd elsewhere
      burnish-ptm convert ../a.ptm -o $threads.exr -j $threads
      burnish-ptm convert $threads.exr -o $threads.ptm -j $threads
      burnish-ptm convert $threads.exr -o j$threads.ptm --jpeg 90 -j $threads
      burnish-ptm convert $threads.exr -o t$threads/ -j $threads
      burnish-ptm normals $threads.exr -o n$threads.png -j $threads
      burnish-ptm relight $threads.exr --light 1,1,1 -o r$threads.png -j $threads
    )
  done
  cd elsewhere
  for threads in 2 7; do
    for file in 1.exr 1.ptm j1.ptm n1.png r1.png; do same_bytes $file ${file/1/$threads}; done
    diff -r t1 t$threads
  done
}
