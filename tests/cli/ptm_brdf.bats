#!/usr/bin/env bats
# burnish-ptm brdf, and the renderer's paths over polynomial texture maps.

load helpers

# A .brdf of 40 samples, red where light and view are near, and a MERL table of one value.
measurements() {
  LC_ALL=C awk 'BEGIN {
    print "# made\n4\n420 500 560 650"
    for (i = 0; i < 40; i++) {
      a = 0.03 * i; b = 1.4 - 0.9 * a
      printf "%.4f 0 %.4f %.4f 0.01 0.02 0.05 %.4f\n", a, b, 0.07 * i, 0.4 / (1 + 4 * (a - b) * (a - b))
    }
  }' >paint.brdf
  "${PYTHON3:-python3}" -c '
import struct
open("grey.binary", "wb").write(struct.pack("<3i", 4, 4, 4) + b"".join(struct.pack("<64d", *[v] * 64) for v in (300, 300 / 1.15, 300 / 1.66)))
open("grey.mbsdf", "wb").write(b"NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n" + struct.pack("<3I64f", 0, 4, 4, *[0.2] * 64))'
}

# brdf_scene LINE…: a torus, with these lines in its [object.ptm].
brdf_scene() {
  {
    printf 'path = "ptm-brdf"\n[image]\nwidth = 64\nheight = 64\n[camera]\nheight = 1.1\n[[light]]\ndirection = [-0.5, 0.6, 1]\n'
    printf '[tables]\nlight_factor = "lf.exr"\n[validate]\nmin_psnr_db = %s\n' "${PSNR:-30}"
    printf '[[object]]\nsurface = "torus"\nrotate_deg = [-40, 0, 0]\n[object.ptm]\n'
    printf '%s\n' "$@"
  } >s.toml
}

@test "brdf: textures say what they are, and the report what each reading loses" {
  succeeds burnish-ptm brdf ward:ax=0.2,ay=0.5,ks=1 --size 24 -o w/ --report r.json
  fits_schema ptm r.json
  for f in abc_red def_red abc_green def_green abc_blue def_blue; do [ -s w/$f.png ]; done
  "${PYTHON3:-python3}" - <<'PYTHON'
import json
t, r = json.load(open("w/ptm.json")), json.load(open("r.json"))
assert (t["width"], t["height"], t["type"], t["parameters"], t["noise_factor"], t["source"]) == \
    (24, 24, "rgb", "half-difference", 0.9, "ward:ax=0.2,ay=0.5,ks=1"), t
of = {(x["parameters"], x["type"]): x["relative"] for x in r["stats"]["readings"]}
assert len(of) == 6 and of["half-difference", "rgb"] < 0.5 * of["difference-half", "rgb"], of
assert abs(of["half-difference", "rgb"] - of["half-difference", "lrgb"]) < 1e-6, "grey is one colour"
assert r["inputs"] == [], r["inputs"]
PYTHON
}

@test "brdf: bytes depend on neither threads nor run; .exr holds floats" {
  for n in 1 2; do burnish-ptm brdf ward: --size 16 -j $n -o w$n/; burnish-ptm brdf ward: --type lrgb --size 16 -j $n -o w$n.exr; done
  for f in w1/*; do same_bytes "$f" "w2/${f#w1/}"; done
  same_bytes w1.exr w2.exr
  succeeds burnish-ptm info w1.exr
}

@test "brdf: measurements of three kinds, with a depfile" {
  measurements
  for m in paint.brdf grey.binary grey.mbsdf; do
    succeeds burnish-ptm brdf $m --size 8 --ceiling 1 -o m/ --depfile d --report r.json
    grep -q "$m" d
    fits_schema ptm r.json
  done
  # The best quadratic in u and v for n·l = z over the hemisphere is 3/16 + 15/16 z², whose error is 1/8 of z.
  burnish-ptm brdf grey.mbsdf --parameters light-view --size 8 --noise-factor 1 -o m/ --report r.json
  "${PYTHON3:-python3}" -c 'import json; s = json.load(open("r.json"))["stats"]; assert s["parameters"] == "light-view" and abs(s["relative"] - 0.125) < 0.002, s'
}

@test "brdf: wrong sources and options" {
  refuses 1 "SOURCE: expected the model ward, banks or blinn-phong, got 'wrad'" burnish-ptm brdf wrad:ax=1 -o x/
  refuses 1 "expected parameters out of ax, ay, kd, ks, got 'az'" burnish-ptm brdf ward:az=1 -o x/
  refuses 1 "expected a model such as ward" burnish-ptm brdf paint.txt -o x/
  refuses 2 "'none.brdf'" burnish-ptm brdf none.brdf -o x/
  refuses 5 "a BRDF PTM is written as textures behind a PREFIX/, or as .exr" burnish-ptm brdf ward: -o x.ptm
  refuses 1 "--jpeg" burnish-ptm brdf ward: -o x/ --jpeg 90
  refuses 5 "standard output: a BRDF PTM is written as textures" burnish-ptm brdf ward: -o - --output-type ptm
  refuses 1 "--size" burnish-ptm brdf ward: --size 0 -o x/
  refuses 1 "--noise-factor" burnish-ptm brdf ward: --noise-factor 1.5 -o x/
  refuses 1 "--parameters" burnish-ptm brdf ward: --parameters view -o x/
}

@test "brdf: damaged measurements" {
  measurements
  head -c 700 grey.binary >short.binary
  refuses 3 "'short.binary': expected 1548 bytes of 4x4x4 cells, got 700" burnish-ptm brdf short.binary -o x/
  printf '\377\377\377\177\377\377\377\177\377\377\377\177' >giant.binary
  refuses 3 "expected counts of cells from 1 to 4096, got 2147483647" burnish-ptm brdf giant.binary -o x/
  head -c 100 grey.mbsdf >short.mbsdf
  refuses 3 "'short.mbsdf': expected 256 bytes" burnish-ptm brdf short.mbsdf -o x/
  sed '5s/ 0 / zero /' paint.brdf >bad.brdf
  refuses 3 "'bad.brdf': line 5: expected an angle about the normal" burnish-ptm brdf bad.brdf -o x/
  head -n 8 paint.brdf >few.brdf
  refuses 3 "expected more than 10 samples, got 5" burnish-ptm brdf few.brdf -o x/
}

@test "render: a torus by a BRDF PTM, from model and measurements" {
  measurements
  burnish-lut light-factor -o lf.exr
  burnish-ptm brdf ward:ax=0.3,ay=0.5,ks=0.5 --weights projected -o w/
  brdf_scene 'map = "w/"' 'brdf = "ward:ax=0.3,ay=0.5,ks=0.5"'
  succeeds burnish-render --validate s.toml --report-dir report --report r.json --depfile d
  fits_schema render r.json
  grep -q w/abc_red.png d
  grep -q w/ptm.json d
  burnish-ptm brdf grey.mbsdf --noise-factor 1 --weights projected -o g/
  PSNR=45 brdf_scene 'map = "g/"' 'brdf = "grey.mbsdf"'
  succeeds burnish-render --validate s.toml --report-dir report
  sed -i 's/"half-difference"/"angles"/' g/ptm.json
  refuses 3 "g/ptm.json': expected parameters half-difference or light-view" burnish-render s.toml -o x.png
  brdf_scene 'map = "w/"' 'brdf = "ward:ax=0"'
  refuses 3 "'s.toml': line 18: 'object[0].ptm.brdf': SOURCE: expected ax as a number above 0, got '0'" burnish-render s.toml -o x.png
  brdf_scene 'map = "w/"' 'brdf = "paint.txt"'
  refuses 3 "'s.toml': line 18: 'object[0].ptm.brdf': 'paint.txt': expected a model such as" burnish-render s.toml -o x.png
  burnish-ptm convert g/ -o g.exr
  brdf_scene 'map = "g.exr"' 'brdf = "grey.mbsdf"'
  refuses 3 "expected the PREFIX/ of textures beside 'brdf'" burnish-render s.toml -o x.png
}

@test "render: a spatial map is what relight shows" {
  "${PYTHON3:-python3}" -c '
import struct
n = 16
body = b"".join(bytes([100 + 3 * x, 120 + 2 * y, 128, 140 + x, 120 + y, 200 - x]) for y in range(n) for x in range(n))
rgb = b"".join(bytes([255 - x, 200, 90 + 5 * y]) for y in range(n) for x in range(n))
open("m.ptm", "wb").write(b"PTM_1.2\nPTM_FORMAT_LRGB\n16\n16\n1 1 1 1 1 1\n128 128 128 128 128 0\n" + body + rgb)'
  burnish-lut light-factor --ambient 0 --transition 0 -o lf.exr
  for map in m.ptm m.exr m/; do
    burnish-ptm convert m.ptm -o $map 2>/dev/null || true
    cat >s.toml <<END
path = "ptm"
[image]
width = 16
height = 16
[[light]]
direction = [0.3, -0.2, 0.9]
[tables]
light_factor = "lf.exr"
[[object]]
[object.ptm]
map = "$map"
END
    succeeds burnish-render s.toml -o x.png
    burnish-ptm relight m.ptm --light 0.3,-0.2,0.9 -o y.png
    "$BURNISH_FIXTURE" texel x.png 5 11 >a
    "$BURNISH_FIXTURE" texel y.png 5 11 >b
    texel_is "$(cat a)" y.png 5 11 0.005
  done
}
