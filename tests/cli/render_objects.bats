#!/usr/bin/env bats
# burnish-render: meshes, materials and lighting models, base colours, and their wrong uses.

load helpers

# A square mesh of two triangles with texture coordinates, its object-space normals with 9 of them in a palette, a panorama
# and a base colour.
setup_file() {
  cd "$BATS_FILE_TMPDIR"
  PATH="$BURNISH_BIN:$PATH"
  printf '%s\n' 'v -.5 -.5 0' 'v .5 -.5 0' 'v .5 .5 0' 'v -.5 .5 0' 'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' \
    'f 1/1 2/2 3/3 4/4' >square.obj
  "$BURNISH_FIXTURE" make normals 16 16 n.png
  "$BURNISH_FIXTURE" make normals 16 8 sky.exr half
  "$BURNISH_FIXTURE" make normals 8 8 base.png
  burnish-quantize n.png -n 9 --space object -o q.exr
  burnish-mipmap q.exr -o q.dds --palette-output p.exr
}

# scene MATERIAL [LINE…]: the square as a mesh, the material's lines (\n between them), further lines of its [[object]].
scene() {
  cp "$BATS_FILE_TMPDIR"/* .
  local material=$1
  shift
  {
    printf 'path = "palette"\nambient = [0.1, 0.1, 0.1]\n[image]\nwidth = 24\nheight = 16\n'
    printf '[[light]]\ndirection = [1, 1, 2]\n[[light]]\ndirection = [-1, 0, 1]\nintensity = 0.5\n'
    printf '[[object]]\nsurface = "mesh"\nmesh = "square.obj"\nrotate_deg = [10, 20, 30]\nscale = [1, 0.5, 1]\n'
    grep -q indexed_map <<<"$*" || printf 'indexed_map = "q.exr"\n'
    printf '%s\n' "$@"
    printf '[[material]]\n%b\n[validate]\nmax_abs = 1e-6\n' "$material"
  } >s.toml
}

@test "every lighting model by the colour table equals its twin" {
  for model in lambert phong npr-double cartoon chrome 'environment"\nmap = "sky.exr'; do
    scene "model = \"$model\""
    succeeds burnish-render --validate s.toml --report-dir v --report r.json
    fits_schema render r.json
    succeeds burnish-render --validate --path palette-expanded s.toml --report-dir v
  done
}

@test "a sum of models, and what it reads" {
  scene '[[material.term]]\nmodel = "phong"\n[[material.term]]\nmodel = "environment"\nmap = "sky.exr"\nturn_deg = 30' \
    'base_color_map = "base.png"'
  succeeds burnish-render --validate s.toml --report-dir v
  succeeds burnish-render s.toml -o x.png --depfile x.d
  grep -q '^x.png: s.toml square.obj q.exr base.png sky.exr$' x.d
}

@test "a panorama of integers is taken as linear light, with a warning" {
  scene 'model = "environment"\nmap = "sky.png"'
  make_image normals 16 8 sky.png uint16
  call burnish-render s.toml -o x.png
  [ "$status" -eq 0 ]
  grep -q "^burnish-render: warning: 'sky.png' holds integers, which are taken as linear light" err
  [ "$(wc -l <err)" -eq 1 ]
  succeeds burnish-render s.toml -o x.png -q
}

@test "each way of blending equals its twin and differs from the others" {
  for blend in exact approximate; do
    scene 'model = "phong"' 'base_color_map = "base.png"' "blend = \"$blend\""
    succeeds burnish-render --validate s.toml --report-dir v
    succeeds burnish-render s.toml -o $blend.png
  done
  scene 'model = "phong"'
  succeeds burnish-render s.toml -o material.png
  for pair in 'exact approximate' 'exact material'; do
    set -- $pair
    if same_pixels $1.png $2.png 0.01 >/dev/null; then echo "the same: $pair"; return 1; fi
  done
}

@test "a base colour's samples are sRGB in integers unless said otherwise" {
  scene 'model = "lambert"' 'base_color_map = "base.png"'
  succeeds burnish-render s.toml -o default.png
  scene 'model = "lambert"' 'base_color_map = "base.png"' 'base_color_transfer = "srgb"'
  succeeds burnish-render s.toml -o srgb.png
  scene 'model = "lambert"' 'base_color_map = "base.png"' 'base_color_transfer = "linear"'
  succeeds burnish-render s.toml -o linear.png
  same_bytes default.png srgb.png
  if same_pixels srgb.png linear.png 0.01 >/dev/null; then return 1; fi
  oiiotool base.png --mulc 4 -d float -o bright.exr
  scene 'model = "lambert"' 'base_color_map = "bright.exr"' 'base_color_transfer = "srgb"'
  refuses 3 "'bright.exr': expected sRGB colours of at most 1, got " burnish-render s.toml -o x.png
  oiiotool base.png --ch 0,1 -o two.png
  scene 'model = "lambert"' 'base_color_map = "two.png"'
  refuses 3 "'two.png': expected 1 channel, or 3 and more, got 2" burnish-render s.toml -o x.png
}

@test "a DDS with the palette beside it is the EXR it was made of" {
  scene 'model = "phong"'
  succeeds burnish-render s.toml -o exr.png
  scene 'model = "phong"' 'indexed_map = "q.dds"' 'palette = "p.exr"'
  succeeds burnish-render s.toml -o dds.png
  same_bytes exr.png dds.png
  sed -i '/^palette/d' s.toml
  refuses 3 "'object[0].palette': expected the file of the palette" burnish-render s.toml -o x.png
  mv q.dds q.bin
  sed -i 's/q.dds/q.bin/' s.toml
  refuses 3 "'s.toml': palette: expected the file of the palette of 'q.bin'" burnish-render s.toml -o x.png
  burnish-mipmap q.exr -o q.ktx2
  for own in q.exr q.ktx2; do
    scene 'model = "phong"' "indexed_map = \"$own\"" 'palette = "p.exr"'
    refuses 3 "'s.toml': palette: '$own' holds its own palette" burnish-render s.toml -o x.png
  done
}

@test "the same bytes for any number of threads" {
  scene 'model = "phong"' 'base_color = [0.5, 0.6, 0.7]'
  for j in 1 2 8; do succeeds burnish-render s.toml -o "$j.png" -j $j; done
  same_bytes 1.png 2.png
  same_bytes 1.png 8.png
}

@test "meshes that are missing, broken or without texture coordinates" {
  scene 'model = "phong"'
  rm square.obj
  refuses 2 "'square.obj'" burnish-render s.toml -o x.png
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n' >square.obj
  refuses 3 "'square.obj': line 3" burnish-render s.toml -o x.png
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >square.obj
  refuses 3 "'square.obj': expected texture coordinates" burnish-render s.toml -o x.png
}

@test "scenes whose objects and materials make no sense" {
  scene 'model = "phnog"'
  refuses 3 "expected lambert|phong|npr-double|cartoon|chrome|environment, got 'phnog'" burnish-render s.toml -o x.png
  scene 'model = "environment"'
  refuses 3 "expected the panorama's file name" burnish-render s.toml -o x.png
  scene 'model = "environment"\nmap = "none.exr"'
  refuses 2 "'none.exr'" burnish-render s.toml -o x.png
  scene 'model = "phong"' 'blend = "multiply"'
  refuses 3 "expected exact|approximate|material, got 'multiply'" burnish-render s.toml -o x.png
  scene 'model = "phong"' 'base_color_map = "none.png"'
  refuses 2 "'none.png'" burnish-render s.toml -o x.png
}
