#!/usr/bin/env bats
# In which space normals are: written into normal maps, and taken from there by what reads them.

load helpers

# A level square with texture coordinates, the same as a mesh without, and a height map.
inputs() {
  printf 'v %s 0\n' '0 0' '1 0' '1 1' '0 1' >square.obj
  printf 'vt %s\n' '0 0' '1 0' '1 1' '0 1' >>square.obj
  printf 'f 1/1 2/2 3/3 4/4\n' >>square.obj
  make_image bumps 16 16 h.png
}

# The space that an indexed map is in.
space_of() { LC_ALL=C grep -aoP 'burnish:space\0string\0....\K(tangent|object)' "$1"; }

@test "every normal map in PNG, TIFF or EXR says its space, and burnish-quantize hands it on" {
  inputs
  for type in png tif exr; do
    succeeds burnish-normals h.png -o bumps.$type
    succeeds burnish-normals h.png -o mesh.$type --mesh square.obj
    succeeds burnish-transfer square.obj square.obj -o object.$type --size 16
    succeeds burnish-transfer square.obj square.obj -o tangent.$type --size 16 --space tangent
    for case in "bumps tangent" "mesh object" "object object" "tangent tangent"; do
      set -- $case
      succeeds burnish-quantize "$1.$type" -n 16 -o q.exr
      [ "$(space_of q.exr)" = "$2" ] || { echo "$1.$type"; return 1; }
      succeeds burnish-quantize "$1.$type" -n 16 -o same.exr --space "$2"
      same_bytes q.exr same.exr
    done
  done
  # TGA and BMP do not tell.
  succeeds burnish-transfer square.obj square.obj -o object.tga --size 16
  succeeds burnish-quantize object.tga -n 16 -o q.exr
  [ "$(space_of q.exr)" = tangent ]
}

@test "burnish-quantize: --space goes before what the map says, with a warning" {
  inputs
  succeeds burnish-transfer square.obj square.obj -o object.png --size 16
  call burnish-quantize object.png -n 16 -o q.exr --space tangent
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-quantize: warning: 'object.png' says that its normals are in object space; they are recorded as tangent, as asked for" ]
  [ "$(space_of q.exr)" = tangent ]
  succeeds burnish-quantize object.png -n 16 -o quiet.exr --space tangent -q
  same_bytes q.exr quiet.exr
  # So does that of a palette.
  call burnish-quantize object.png --palette q.exr -o x.exr
  [ "$status" -eq 0 ]
  grep -qF "'object.png' says that its normals are in object space; they are recorded as tangent" err
  [ "$(space_of x.exr)" = tangent ]
}

@test "burnish-quantize: maps for one palette are in one space" {
  inputs
  make_image normals 16 16 silent.png
  succeeds burnish-normals h.png -o tangent.png
  succeeds burnish-transfer square.obj square.obj -o object.png --size 16
  refuses 3 "'object.png': expected normals in tangent space, as in 'tangent.png', got object space" \
    burnish-quantize silent.png tangent.png object.png -n 16 --output-dir q
  succeeds burnish-quantize silent.png object.png -n 16 --output-dir q
  [ "$(space_of q/silent.exr) $(space_of q/object.exr)" = "object object" ]
  call burnish-quantize tangent.png object.png -n 16 --space object --output-dir q
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-quantize: warning: 'tangent.png' says that its normals are in tangent space; they are recorded as object, as asked for" ]
}

# scene LINE…: a sphere, the lines of its [[object]].
scene() {
  printf '[image]\nwidth = 24\nheight = 16\n[[light]]\ndirection = [1, 1, 2]\n[[object]]\nsurface = "sphere"\n' >s.toml
  printf '%s\n' "$@" '[[material]]' 'model = "lambert"' >>s.toml
}

@test "burnish-render: a scene that gives no space takes the map's; one that contradicts it is refused" {
  inputs
  succeeds burnish-transfer square.obj square.obj -o object.png --size 16
  succeeds burnish-normals h.png -o tangent.png
  for space in object tangent; do
    other=$([ $space = object ] && echo tangent || echo object)
    scene "normal_map = \"$space.png\""
    succeeds burnish-render s.toml --path analytic -o silent.png
    scene "normal_map = \"$space.png\"" "normal_space = \"$space\""
    succeeds burnish-render s.toml --path analytic -o said.png
    same_bytes silent.png said.png
    scene "normal_map = \"$space.png\"" "normal_space = \"$other\""
    refuses 3 "'s.toml': expected normal_space = '$space', as '$space.png' says of itself, got '$other'" \
      burnish-render s.toml --path analytic -o x.png
  done
  # Without its text the map would be taken for one in tangent space, which is another picture.
  succeeds burnish-transfer square.obj square.obj -o object.tga --size 16
  scene 'normal_map = "object.png"'
  succeeds burnish-render s.toml --path analytic -o object-said.png
  scene 'normal_map = "object.tga"'
  succeeds burnish-render s.toml --path analytic -o object-silent.png
  differ object-said.png object-silent.png
}

@test "burnish-render: two maps of an object are in one space, or the scene says in which" {
  inputs
  succeeds burnish-transfer square.obj square.obj -o n.png --size 16
  call burnish-quantize n.png -n 16 --space tangent -o i.exr
  scene 'normal_map = "n.png"' 'indexed_map = "i.exr"'
  refuses 3 "'s.toml': expected maps in one space, or 'normal_space' to say which, got 'n.png' in object space and 'i.exr' in tangent space" \
    burnish-render s.toml --path palette -o x.png
  scene 'normal_map = "n.png"' 'indexed_map = "i.exr"' 'normal_space = "object"'
  succeeds burnish-render s.toml --path palette -o x.png
  succeeds burnish-quantize n.png -n 16 -o i.exr
  scene 'normal_map = "n.png"' 'indexed_map = "i.exr"'
  succeeds burnish-render s.toml --path palette -o y.png
  same_bytes x.png y.png
}
