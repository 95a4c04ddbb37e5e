#!/usr/bin/env bats
# burnish-mipmap of polynomial texture maps

load helpers
load ptm_inputs

@test "light of a coarser texel is the mean of the light under it" {
  for kind in LRGB RGB; do
    make_ptm $kind 6 4 a.ptm
    succeeds burnish-mipmap a.ptm --split 'm_%d.exr' -o chain.exr --report r.json
    fits_schema mipmap r.json
    [ "$(ls m_*.exr | wc -l)" -eq 3 ]
    for light in 0,0,1 0.5,-0.3,0.4; do
      burnish-ptm relight a.ptm --light $light -o fine.exr -d float
      burnish-ptm relight m_1.exr --light $light -o coarse.exr -d float
      for at in "0 0" "1 0" "2 1"; do
        read -r x y <<<"$at"
        "$BURNISH_FIXTURE" texel fine.exr $((2 * x)) $((2 * y)) $((2 * x + 1)) $((2 * y)) \
          $((2 * x)) $((2 * y + 1)) $((2 * x + 1)) $((2 * y + 1)) >four
        mean=$("$PYTHON3" -c "
import re
v = [float(t) for t in re.findall(r'[-+0-9.e]+', open('four').read())]
print(*(sum(v[c::3]) / 4 for c in range(3)))")
        texel_is "$mean" coarse.exr $x $y 0.00001
      done
    done
  done
}

@test "an .exr holds the chain, and its base is the map" {
  make_ptm RGB 130 70 a.ptm
  succeeds burnish-mipmap a.ptm -o chain.exr
  succeeds burnish-ptm relight a.ptm --light 1,2,3 -o a.exr -d float
  succeeds burnish-ptm relight chain.exr --light 1,2,3 -o b.exr -d float
  same_pixels a.exr b.exr 0.000001
  succeeds burnish-mipmap chain.exr -o again.exr
  same_bytes chain.exr again.exr
}

@test "textures of all levels have one scale and bias" {
  make_ptm LRGB 32 16 a.ptm
  succeeds burnish-mipmap a.ptm --split 'm_%d/'
  for level in 1 2 3 4 5; do
    for key in type abc_scale abc_bias def_scale def_bias; do
      "$PYTHON3" -c "
import json
a, b = (json.load(open(f'm_{l}/ptm.json')) for l in (0, $level))
assert a['$key'] == b['$key'] and b['width'] == 32 >> $level"
    done
  done
  # Of textures, the base is theirs.
  succeeds burnish-mipmap m_0 --split 'n_%d/'
  diff -r m_0 n_0
  make_ptm RGB 8 8 b.ptm
  succeeds burnish-mipmap b.ptm --split 'b_%d.ptm' --levels 2
  same_bytes b.ptm b_0.ptm
  [ ! -e b_2.ptm ]
}

@test "what cannot be is refused" {
  make_ptm LRGB 8 8 a.ptm
  refuses 5 "'x.ptm': holds one level, not 4" burnish-mipmap a.ptm -o x.ptm
  refuses 5 "holds one level, not 4" burnish-mipmap a.ptm -o x/
  refuses 5 "EXR holds one level or all 4, not 2" burnish-mipmap a.ptm -o x.exr --levels 2
  refuses 5 "a polynomial texture map is written as" burnish-mipmap a.ptm -o x.png --levels 1
  refuses 1 "--levels: expected 1 to 4" burnish-mipmap a.ptm -o x.exr --levels 9
  refuses 1 "--format does not go with --kind ptm" burnish-mipmap a.ptm -o x.exr -d half
  refuses 1 "--khr goes with --kind material" burnish-mipmap a.ptm -o x.exr --khr
  head -c 100 a.ptm >cut.ptm
  refuses 3 "'cut.ptm'" burnish-mipmap cut.ptm -o x.exr
  mkdir d
  refuses 2 "'d/ptm.json'" burnish-mipmap d -o x.exr
}
