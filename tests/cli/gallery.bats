#!/usr/bin/env bats
# The gallery's page in a browser, and the shaders of samples/glsl, which it draws with, against the renderer's paths.

load helpers
load ptm_inputs

needs_browser() {
  needs_node_package playwright-core
  export BURNISH_CHROMIUM="${BURNISH_CHROMIUM:-/usr/bin/chromium}"
  [ -x "$BURNISH_CHROMIUM" ] || skip "there is no $BURNISH_CHROMIUM: scripts/install-packages gallery"
}

gallery() { "$PYTHON3" "$BURNISH_SOURCE_DIR/scripts/gallery" "$@"; }
look() { timeout 300 node "$BURNISH_SOURCE_DIR/tests/cli/gallery.mjs" "$@"; }

# Samples as scripts/demo makes them, but such as take no time: small stones, a sphere for the object, polynomials of the plaque's
# name; and their page.
setup_file() {
  PATH="$BURNISH_BIN:$PATH"
  cd "$BATS_FILE_TMPDIR"
  mkdir -p made/tarini made/ptm/plaque
  make_image bumps 64 64 h.png
  burnish-normals h.png -o made/tarini/stones_n.png --height 6 --wrap repeat
  burnish-quantize made/tarini/stones_n.png -n 300 -o made/tarini/stones_2048.exr
  sed -e 's/= 768/= 96/' "$BURNISH_SOURCE_DIR/samples/tarini/pavement.toml" | sed '/validate/,$d' >made/tarini/pavement.toml
  (cd made/tarini && burnish-render --validate pavement.toml --report-dir pavement --report pavement.json)
  "$BURNISH_FIXTURE" mesh sphere 12 made/tarini/object_low.obj
  make_image normals 64 64 made/tarini/object_n.png
  for n in 16 64 256; do burnish-quantize made/tarini/object_n.png --space object -n $n -o made/tarini/object_$n.png; done
  burnish-quantize made/tarini/object_n.png --space object -n 2048 -o made/tarini/object_2048.exr
  make_ptm RGB 48 40 p.ptm
  burnish-ptm convert p.ptm -o made/ptm/plaque/
  gallery --samples made --output page.html 2>left_out
}

# ours NAME: compares with the picture of NAME.toml by burnish-render, or the one that is there.
ours() {
  [ -e "$1.png" ] || burnish-render "$1.toml" -o "$1.png"
  "$PYTHON3" "$BURNISH_SOURCE_DIR/tests/cli/gallery_scene.py" "$1.toml" >"$1.json"
  scenes+=("$1.json" "$1.png")
}

# What `ours` has gathered, by the shaders; the figures are told.
compare_all() {
  look compare "$BATS_FILE_TMPDIR/page.html" "${scenes[@]}" >figures || { cat figures; return 1; }
  sed 's/^/# /' figures >&3
}

# scene PATH: the head of a scene, the rest from standard input: a quad seen at an angle, a lamp near it and a light
# that grazes it.
scene() {
  cat <<TOML
path = "$1"
ambient = [0.05, 0.06, 0.07]
[image]
width = 120
height = 90
background = [0.1, 0.2, 0.3]
[camera]
type = "perspective"
position = [0.3, -0.9, 1.6]
fov_deg = 32
[[light]]
type = "point"
position = [-0.5, 0.6, 0.7]
color = [1.0, 0.9, 0.7]
intensity = 0.9
[[light]]
direction = [0.9, 0.2, 0.1]
color = [0.4, 0.6, 0.8]
TOML
  cat
}

@test "the page: pictures are lit by hand, sliders slide, nothing is asked of a network" {
  needs_browser
  grep -q "left out, for there is no '.*made/kautz" "$BATS_FILE_TMPDIR/left_out"
  look use "$BATS_FILE_TMPDIR/page.html"
  look without-webgl "$BATS_FILE_TMPDIR/page.html"
}

@test "the page: the same samples give the same bytes; without any there is no page" {
  cp -r "$BATS_FILE_TMPDIR/made" elsewhere
  (cd elsewhere && gallery --samples . --output ../b.html 2>/dev/null)
  same_bytes "$BATS_FILE_TMPDIR/page.html" b.html
  [ -z "$(grep -oE '(src|href)="[^"]{0,5}' b.html | grep -vE '="(#|data:)')" ]
  mkdir nothing
  call gallery --samples nothing --output c.html
  [ "$status" -eq 1 ] && grep -q "holds no sample" err && [ ! -e c.html ]
}

@test "shaders: quantized normals, and normals, are shaded as the renderer does" {
  needs_browser
  scenes=()
  make_image normals 64 48 n.png
  make_image ids 64 48 ids.png
  burnish-quantize n.png -n 200 -o few.exr
  burnish-quantize n.png -n 1000 --material ids.png -o many.exr
  burnish-mipmap few.exr -o few.ktx2
  burnish-mipmap many.exr -o many.ktx2
  material='[[material]]
model = "phong"
diffuse = [0.6, 0.5, 0.4]
specular = [0.5, 0.4, 0.3]
exponent = 12'
  of_one_material() { scene "$1" <<<"[[object]]
$2
$material"; }
  of_one_material palette 'indexed_map = "few.ktx2"' >few.toml
  ours few
  make_image rgba 64 48 base.png
  for blend in exact approximate; do
    of_one_material palette "indexed_map = \"few.ktx2\"
base_color_map = \"base.png\"
filter = \"bilinear\"
blend = \"$blend\"" >blended-$blend.toml
    ours blended-$blend
  done
  # Four materials; object space; levels.
  {
    cat <<'TOML'
[[object]]
indexed_map = "many.ktx2"
normal_space = "object"
filter = "bilinear"
mip = "linear"
repeat = [3, 2]
rotate_deg = [-20, 30, 10]
TOML
    for id in 0 1 2 3; do
      printf '[[material]]\nid = %d\nmodel = "phong"\ndiffuse = [0.%d, 0.5, 0.3]\nexponent = %d\n' $id $((2 * id + 1)) $((10 * id))
    done
  } | scene palette >many.toml
  ours many
  "$BURNISH_FIXTURE" mesh sphere 12 ball.obj
  of_one_material palette 'surface = "mesh"
mesh = "ball.obj"
scale = 0.4
rotate_deg = [20, 30, 0]
indexed_map = "few.ktx2"
normal_space = "object"' >mesh.toml
  ours mesh
  of_one_material analytic 'normal_map = "n.png"
rotate_deg = [10, -20, 30]' >normals.toml
  ours normals
  of_one_material analytic 'normal_map = "n.png"
normal_space = "object"
rotate_deg = [10, -20, 30]' >object.toml
  ours object
  compare_all
}

@test "shaders: anisotropic reflectance and strands are shaded as the renderer does" {
  needs_browser
  scenes=()
  make_image normals 64 48 n.png
  make_image flow 64 48 flow.png
  make_image rgba 64 48 base.png
  burnish-tangents flow.png --from flow -o t.exr -q
  for function in banks-r blinn-phong-f ward-s ward-e; do burnish-lut $function -o ${function//-/_}.exr; done
  tables='[tables]
banks_r = "banks_r.exr"
blinn_phong_f = "blinn_phong_f.exr"
ward_s = "ward_s.exr"
ward_e = "ward_e.exr"'
  for model in banks blinn-phong ward; do
    bake="burnish-material --model $model --normal n.png --direction t.exr --ks 0.6"
    if [ $model != banks ]; then bake="$bake --alpha-x 0.3 --alpha-y 0.8"; fi
    $bake --encode float --extension exr -o $model
    $bake -o ${model}_8
  done
  for path in banks banks-approximate blinn-phong blinn-phong-eq1 ward; do
    model=${path%-approximate} model=${model%-eq1}
    for textures in $model ${model}_8; do
      name=$path-${textures#$model}
      scene $path >"$name.toml" <<TOML
$tables
[[object]]
filter = "bilinear"
base_color_map = "base.png"
[object.reflectance]
model = "$path"
diffuse = [0.3, 0.3, 0.4]
textures = "$textures"
TOML
      ours "$name"
    done
  done
  for layout in offset-half cube-z; do burnish-lut strand --exponent 24 --layout $layout -o strand_$layout.exr; done
  strands='[object.reflectance]
model = "strand"
exponent = 24
diffuse = [0.5, 0.4, 0.3]
specular = [0.4, 0.4, 0.5]
direction_map = "t.exr"'
  scene strand-ps14 >strand.toml <<TOML
[tables]
strand = "strand_offset-half.exr"
[[object]]
filter = "bilinear"
base_color_map = "base.png"
$strands
TOML
  ours strand
  scene strand-bump >strand-bump.toml <<TOML
[tables]
strand = "strand_cube-z.exr"
[[object]]
filter = "bilinear"
base_color_map = "base.png"
normal_map = "n.png"
$strands
gloss = "base-alpha"
TOML
  ours strand-bump
  compare_all
}

@test "shaders: polynomial texture maps are relit as the tools do" {
  needs_browser
  scenes=()
  burnish-lut light-factor -o light_factor.exr
  make_ptm LRGB 48 40 l.ptm
  for map in l.ptm "$BATS_FILE_TMPDIR/made/ptm/plaque/"; do
    name=spatial-$(basename "$map")
    scene ptm >"$name.toml" <<TOML
[tables]
light_factor = "light_factor.exr"
[[object]]
filter = "bilinear"
[object.ptm]
map = "$map"
TOML
    ours "$name"
    # A texel a pixel, straight from above: what relight writes.
    name=relit-$(basename "$map")
    burnish-ptm relight "$map" --light -0.4,0.5,0.8 -o "$name.png"
    cat >"$name.toml" <<TOML
path = "ptm"
[image]
width = 48
height = 40
[camera]
height = 40
[[light]]
direction = [-0.4, 0.5, 0.8]
[[object]]
size = [48, 40]
[object.ptm]
map = "$map"
TOML
    ours "$name"
  done
  for parameters in half-difference light-view; do
    burnish-ptm brdf ward:ax=0.3,ay=0.6,ks=0.4,kd=0.3 --parameters $parameters --size 32 -o $parameters/
    for surface in quad torus; do
      scene ptm-brdf >$parameters-$surface.toml <<TOML
[tables]
light_factor = "light_factor.exr"
[[object]]
surface = "$surface"
[object.ptm]
map = "$parameters/"
brdf = "ward:ax=0.3,ay=0.6,ks=0.4,kd=0.3"
TOML
      ours $parameters-$surface
    done
  done
  compare_all
}
