#!/usr/bin/env bats
# burnish-render: anisotropic reflectance, from baked textures and tables, against the formulas.

load helpers

# Bump normals, a direction a texel, and scene.toml of an object that reflects by MODEL: reflective MODEL PATH [LINE…].
# Further lines go to its [object.reflectance].
reflective() {
  local model=$1 path=$2
  shift 2
  [ -e n.png ] || make_image normals 32 32 n.png
  {
    printf 'path = "%s"\n[image]\nwidth = 48\nheight = 48\n[camera]\nheight = 1\n' "$path"
    printf '[[light]]\ndirection = [-0.5, 0.6, 1]\n[validate]\nmin_psnr_db = 45\n[tables]\n'
    for table in banks_r blinn_phong_f ward_s ward_e strand; do
      [ ! -e $table.exr ] || printf '%s = "%s.exr"\n' $table $table
    done
    printf '[[object]]\nnormal_map = "n.png"\n%s\n[object.reflectance]\nmodel = "%s"\n' "${OBJECT:-}" "$model"
    printf '%s\n' "$@"
  } >s.toml
}

tables() {
  burnish-lut banks-r -o banks_r.exr
  burnish-lut blinn-phong-f -o blinn_phong_f.exr
  burnish-lut ward-s -o ward_s.exr
  burnish-lut ward-e -o ward_e.exr
}

material() { burnish-material "$@" --normal n.png --angle 30 -o m; }
in_float='--encode float --extension exr -d float'

valid() {
  call burnish-render --validate s.toml --report-dir report --report r.json
  [ "$status" -eq 0 ] || { cat err; return 1; }
  fits_schema render r.json
}

@test "every model from textures and tables is within 45 dB of its formula" {
  tables
  make_image normals 32 32 n.png
  local widths='alpha_x = 0.3
alpha_y = 0.8'
  for surface in 'surface = "quad"' 'surface = "sphere"' 'rotate_deg = [-75, 0, 0]'; do
    OBJECT=$surface
    material --model banks --ks 0.5 $in_float
    for path in banks banks-approximate; do
      reflective $path $path 'ks = 0.5' 'angle_deg = 30' 'textures = "m"'
      valid
    done
    material --model blinn-phong --ks 0.5 --exponent 40 --alpha-x 0.3 --alpha-y 0.8 $in_float
    for path in blinn-phong blinn-phong-eq1; do
      reflective $path $path 'ks = 0.5' 'angle_deg = 30' 'textures = "m"' "$widths"
      [ $path != blinn-phong ] || echo 'exponent = 40' >>s.toml
      valid
    done
    material --model ward --ks 0.5 --alpha-x 0.3 --alpha-y 0.8 $in_float
    reflective ward ward 'ks = 0.5' 'angle_deg = 30' 'textures = "m"' "$widths"
    valid
  done
}

@test "register combiners and imaging subset from 8-bit textures" {
  make_image normals 32 32 n.png
  material --model blinn-phong --ks 0.5 --alpha-x 0.4 --alpha-y 0.8
  for path in combiner imaging; do
    reflective blinn-phong-eq1 $path 'ks = 0.5' 'angle_deg = 30' 'textures = "m"' 'alpha_x = 0.4' 'alpha_y = 0.8'
    sed -i 's/min_psnr_db = 45/min_psnr_db = 34/' s.toml
    valid
  done
  OBJECT='surface = "sphere"' reflective blinn-phong-eq1 imaging 'textures = "m"' 'alpha_x = 0.4' 'alpha_y = 0.8'
  refuses 3 "path 'imaging' needs flat surfaces, got a sphere" burnish-render s.toml -o x.png
}

@test "the four strand shaders" {
  burnish-lut strand --layout offset-half -o strand.exr
  make_image normals 32 32 n.png
  burnish-tangents n.png --from flow -o d.exr
  reflective strand strand-ps11 'direction_map = "d.exr"'
  sed -i '/normal_map/d' s.toml
  valid
  sed -i 's/strand-ps11/strand-ps14/; s/^\[validate\]/[[light]]\ndirection = [1, 0, 1]\ncolor = [0.2, 0.1, 0.7]\n&/' s.toml
  valid
  burnish-lut strand --layout cube-z -o strand.exr
  reflective strand strand-bump 'direction_map = "d.exr"' 'diffuse = [0.4, 0.3, 0.2]'
  valid
  sed -i 's/strand-bump/strand-bump-unnormalised/; s/= 45/= 20/' s.toml
  valid
}

@test "gloss is the base map's alpha" {
  burnish-lut strand --layout cube-z -o strand.exr
  make_image rgba 32 32 base.png
  OBJECT='base_color_map = "base.png"' reflective strand strand-bump 'diffuse = [0.4, 0.4, 0.4]' 'gloss = "base-alpha"'
  valid
  succeeds burnish-render s.toml -o glossy.png
  sed -i '/gloss/d' s.toml
  succeeds burnish-render s.toml -o plain.png
  if same_pixels glossy.png plain.png >/dev/null; then return 1; fi
  make_image colours 32 32 base.png
  echo 'gloss = "base-alpha"' >>s.toml
  refuses 3 "'base.png': expected 4 channels, the last of which is gloss, got 3" burnish-render s.toml -o x.png
  OBJECT= reflective strand strand-bump 'gloss = "base-alpha"'
  refuses 3 "'object[0].base_color_map': expected a map" burnish-render s.toml -o x.png
}

@test "all that a reflectance names is read, and in the depfile" {
  tables
  make_image normals 32 32 n.png
  make_image grey 32 32 ks.png
  material --model ward --ks ks.png --alpha-x 0.3 --alpha-y 0.8 $in_float
  reflective ward ward 'ks = "ks.png"' 'angle_deg = 30' 'textures = "m"' 'alpha_x = 0.3' 'alpha_y = 0.8'
  valid
  succeeds burnish-render s.toml -o x.png --depfile x.d
  for file in n.png ks.png m_t.exr m_b.exr m_n.exr ward_s.exr ward_e.exr; do grep -q " $file" x.d; done
}

# the_same_on_threads PATH: as s.toml has it.
the_same_on_threads() {
  sed -i "s/^path = .*/path = \"$1\"/" s.toml
  succeeds burnish-render s.toml -o 1.exr -d float -j 1
  succeeds burnish-render s.toml -o 4.exr -d float -j 4
  same_bytes 1.exr 4.exr
}

@test "the same bytes for any thread count" {
  tables
  make_image normals 32 32 n.png
  material --model ward --alpha-x 0.3 --alpha-y 0.8 $in_float
  reflective ward ward 'angle_deg = 30' 'textures = "m"' 'alpha_x = 0.3' 'alpha_y = 0.8'
  the_same_on_threads ward
  the_same_on_threads analytic
  rm m_*
  material --model blinn-phong --alpha-x 0.4 --alpha-y 0.8
  OBJECT='filter = "bilinear"' reflective blinn-phong-eq1 combiner 'textures = "m"' 'alpha_x = 0.4' 'alpha_y = 0.8'
  the_same_on_threads combiner
  the_same_on_threads imaging
  burnish-lut strand --layout cube-z -o strand.exr
  reflective strand strand-bump 'angle_deg = 30'
  the_same_on_threads strand-bump
}

@test "--frames turn the light, --aov shows the normals of the textures" {
  make_image normals 32 32 n.png
  material --model blinn-phong --alpha-x 0.4 --alpha-y 0.8
  reflective blinn-phong-eq1 imaging 'textures = "m"' 'alpha_x = 0.4' 'alpha_y = 0.8'
  succeeds burnish-render s.toml -o i%d.exr --frames 3
  if same_pixels i0.exr i1.exr >/dev/null; then return 1; fi
  succeeds burnish-render s.toml -o a.exr --aov normal
  succeeds burnish-render s.toml -o b.exr --aov normal --path analytic
  same_pixels a.normal.exr b.normal.exr 0.005
}

@test "filter_order decides how combiners look between texels" {
  make_image normals 8 8 n.png
  material --model blinn-phong --alpha-x 0.4 --alpha-y 0.8
  OBJECT='filter = "bilinear"' reflective blinn-phong-eq1 combiner 'textures = "m"' 'alpha_x = 0.4' 'alpha_y = 0.8'
  succeeds burnish-render s.toml -o before.exr
  echo 'filter_order = "after"' >>s.toml
  succeeds burnish-render s.toml -o after.exr
  if same_pixels before.exr after.exr 0.01 >/dev/null; then return 1; fi
}

@test "what does not fit is refused" {
  tables
  make_image normals 32 32 n.png
  make_image grey 16 16 small.png
  make_image empty-mask 32 32 zero.png
  material --model ward --alpha-x 0.3 --alpha-y 0.8 $in_float
  reflective ward ward
  refuses 3 "path 'ward' needs material textures" burnish-render s.toml -o x.png
  reflective ward ward 'textures = "none"'
  refuses 2 "none_t" burnish-render s.toml -o x.png
  reflective blinn-phong blinn-phong 'textures = "m"'
  refuses 3 "expected textures of the model blinn-phong, got ward" burnish-render s.toml -o x.png
  reflective ward analytic 'ks = "small.png"'
  refuses 3 "'n.png': expected 16x16 texels as in 'small.png', got 32x32" burnish-render s.toml -o x.png
  reflective ward analytic 'alpha_x = "zero.png"'
  refuses 3 "'zero.png': expected" burnish-render s.toml -o x.png
  reflective ward analytic 'alpha_x = 0'
  refuses 3 "'object[0].reflectance.alpha_x': expected a number above 0, got 0" burnish-render s.toml -o x.png
  reflective ward analytic 'gloss = "none"'
  refuses 3 "unknown key" burnish-render s.toml -o x.png
  reflective ward analytic
  sed -i 's/ward_s = .*/ward_s = "ward_e.exr"/' s.toml
  refuses 3 "'ward_e.exr': expected a table of ward-s, got one of ward-e" burnish-render s.toml -o x.png
  OBJECT='blend = "exact"' reflective ward analytic
  refuses 3 "'object[0].blend': expected no blending" burnish-render s.toml -o x.png
  OBJECT='mip = "nearest"' reflective strand strand-bump
  refuses 3 "'object[0].mip': expected off" burnish-render s.toml -o x.png
  reflective ward analytic
  printf '[[material]]\nid = 3\n' >>s.toml
  refuses 3 "expected no [[material]] where every object has an [object.reflectance]" burnish-render s.toml -o x.png
  cp n.png m_t.png
  reflective ward ward 'textures = "m"'
  refuses 3 "m_t.exr" burnish-render s.toml -o x.png
  rm m_t.png
  OBJECT='mip = "nearest"' reflective ward ward 'textures = "m"'
  refuses 3 "expected a chain of mip levels" burnish-render s.toml -o x.png
}
