#!/usr/bin/env bats
# burnish-simplify: every option, and every way of using it wrongly. That shapes and textures are kept, and that atlases
# do not overlap, is tested in unit/mesh_decimate_test.cpp and unit/mesh_atlas_test.cpp.

load helpers

mesh() { "$BURNISH_FIXTURE" mesh "$@"; }
# bare NAME ROWS FILE: without texture coordinates.
bare() { mesh "$1" "$2" "$3" && sed -i '/^vt/d; s#/[0-9]*##g' "$3"; }
faces() { grep -c '^f ' "$1"; }

@test "fewer triangles: as many as asked for, with smooth normals" {
  bare torus 40 torus.obj
  for n in 1000 250 100; do
    succeeds burnish-simplify torus.obj -o low.obj --faces $n --report r.json
    fits_schema simplify r.json
    [ "$(faces low.obj)" = $n ]
    [ "$(value faces r.json) $(value vertices r.json)" = "$n $((n / 2))" ]
    [ "$(grep -c '^vn ' low.obj)" = $((n / 2)) ]
    [ "$(grep -c '^vt ' low.obj)" = 0 ]
  done
  # At 1000 of 6400 triangles the torus, 1.8 across, is off by less than a hundredth.
  succeeds burnish-simplify torus.obj -o low.obj --faces 1000 --report r.json
  "${PYTHON3:-python3}" -c 'import sys; a, b = map(float, sys.argv[1:]); assert 0 < b < a < 0.01, sys.argv' \
    "$(value max_distance r.json)" "$(value rms_distance r.json)"
}

@test "an odd number: met at a border, one fewer on a closed surface" {
  bare sheet 20 sheet.obj
  bare sphere 20 sphere.obj
  succeeds burnish-simplify sheet.obj -o low.obj --faces 101
  [ "$(faces low.obj)" = 101 ]
  succeeds burnish-simplify sphere.obj -o low.obj --faces 101
  [ "$(faces low.obj)" = 100 ]
}

@test "--atlas: texture coordinates in [0,1], reported, and fit for burnish-transfer" {
  bare torus 40 torus.obj
  succeeds burnish-simplify torus.obj -o low.obj --faces 250 --atlas 512 --report r.json
  fits_schema simplify r.json
  [ "$(faces low.obj)" = 250 ]
  [ "$(value charts r.json)" -gt 1 ]
  "${PYTHON3:-python3}" - "$(value covered r.json)" <<'PYTHON'
import sys
covered = float(sys.argv[1])
assert covered > 0.55, covered
uv = [tuple(map(float, l.split()[1:])) for l in open("low.obj") if l.startswith("vt ")]
assert all(0 < x < 1 for p in uv for x in p)
area = 0
for l in open("low.obj"):
    if l.startswith("f "):
        (a, b), (c, d), (e, f) = (uv[int(corner.split("/")[1]) - 1] for corner in l.split()[1:])
        one = ((c - a) * (f - b) - (d - b) * (e - a)) / 2
        assert one > 0, l
        area += one
assert abs(area - covered) < 1e-6, (area, covered)
PYTHON
  succeeds burnish-transfer low.obj torus.obj -o n.png --size 512 --report t.json
  [ "$(value overlapped_texels t.json)" = 0 ]
  [ "$(value missed_texels t.json)" = 0 ]
  # Without --faces every triangle stays.
  bare sphere 6 ball.obj
  succeeds burnish-simplify ball.obj -o all.obj --atlas 256 --report r.json
  fits_schema simplify r.json
  [ "$(faces all.obj) $(value max_distance r.json)" = "$(faces ball.obj) 0.0" ]
}

@test "texture coordinates are kept, and --atlas says that it makes none" {
  mesh split-torus 24 torus.obj
  succeeds burnish-simplify torus.obj -o low.obj --faces 300 --report r.json
  fits_schema simplify r.json
  [ "$(faces low.obj)" = 300 ]
  [ "$(grep -c '^vt ' low.obj)" -gt 0 ]
  call burnish-simplify torus.obj -o same.obj --faces 300 --atlas 512 --report r.json
  [ "$status" -eq 0 ]
  [ "$(wc -l <err)" -eq 1 ]
  grep -qF "burnish-simplify: warning: 'torus.obj' has texture coordinates, which are kept: no atlas is made" err
  fits_schema simplify r.json
  same_bytes low.obj same.obj
}

@test "a sheet over the whole map stays in it, whole, for burnish-transfer" {
  mesh square-sheet 30 sheet.obj
  for n in 300 50; do
    succeeds burnish-simplify sheet.obj -o low.obj --faces $n
    [ "$(faces low.obj)" = $n ]
    succeeds burnish-transfer low.obj sheet.obj -o n.png --size 64 --report t.json
    [ "$(value covered_texels t.json)" = $((64 * 64)) ]
    [ "$(value overlapped_texels t.json)" = 0 ]
  done
}

@test "--new-atlas: other texture coordinates for a mesh that has some, such as ones beyond [0,1]" {
  mesh torus 24 torus.obj
  bare torus 24 bare.obj
  succeeds burnish-simplify torus.obj -o low.obj --faces 200 --atlas 256 --new-atlas --report r.json
  fits_schema simplify r.json
  succeeds burnish-simplify bare.obj -o same.obj --faces 200 --atlas 256
  same_bytes low.obj same.obj
  succeeds burnish-simplify bare.obj -o same.obj --faces 200 --atlas 256 --new-atlas
  same_bytes low.obj same.obj
  # What burnish-transfer refuses names the way out, which leads out.
  sed 's/^vt 1 /vt 1.0167 /' torus.obj >beyond.obj
  refuses 3 "'beyond.obj': expected texture coordinates in [0,1], got (1.016700, " burnish-transfer beyond.obj torus.obj -o n.png
  refuses 3 "(burnish-simplify --atlas --new-atlas makes others)" burnish-transfer beyond.obj torus.obj -o n.png
  make_image bumps 64 64 h.png
  refuses 3 "(burnish-simplify --atlas --new-atlas makes others)" burnish-normals h.png --mesh beyond.obj -o n.png
  succeeds burnish-simplify beyond.obj -o within.obj --atlas 256 --new-atlas
  [ "$(faces within.obj)" = "$(faces torus.obj)" ]
  succeeds burnish-transfer within.obj torus.obj -o n.png --size 256
  succeeds burnish-normals h.png --mesh within.obj -o n.png
  refuses 1 "--atlas" burnish-simplify torus.obj -o x.obj --faces 200 --new-atlas
}

@test "neither --faces nor --atlas: the same mesh in another type of file" {
  mesh torus 12 torus.obj
  succeeds burnish-simplify torus.obj -o torus.ply --report r.json
  fits_schema simplify r.json
  [ "$(value faces r.json) $(value max_distance r.json)" = "$(faces torus.obj) 0.0" ]
  succeeds burnish-simplify torus.ply -o again.obj
  [ "$(faces again.obj)" = "$(faces torus.obj)" ]
  for what in v vt; do
    [ "$(grep "^$what " again.obj | sort -u | wc -l)" = "$(grep "^$what " torus.obj | sort -u | wc -l)" ]
  done
}

@test "groups, objects and materials of an OBJ are not kept, which a warning says once" {
  bare torus 12 torus.obj
  { printf 'mtllib a.mtl\no ring\ns off\n'; sed 's/^f /usemtl gold\ng half\nf /' torus.obj; } >named.obj
  call burnish-simplify named.obj -o low.obj --faces 200
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-simplify: warning: 'named.obj': groups, objects and materials are not kept (mtllib, o, usemtl, g)" ]
  succeeds burnish-simplify torus.obj -o same.obj --faces 200
  same_bytes low.obj same.obj
  succeeds burnish-simplify named.obj -o quiet.obj --faces 200 -q
  { printf 's 1\n# g comment\n'; cat torus.obj; } >smooth.obj
  succeeds burnish-simplify smooth.obj -o same.obj --faces 200
}

@test "no fewer than wanted: written as it is, with a warning" {
  bare sphere 6 ball.obj
  call burnish-simplify ball.obj -o low.obj --faces 5000 --report r.json
  [ "$status" -eq 0 ]
  grep -qF "burnish-simplify: warning: 'ball.obj' has no more than 120 triangles; none is taken away" err
  [ "$(wc -l <err)" -eq 1 ]
  [ "$(value faces r.json) $(value max_distance r.json)" = "120 0.0" ]
  [ "$(grep '^f ' low.obj | sed 's#//[0-9]*##g')" = "$(grep '^f ' ball.obj)" ]
  succeeds burnish-simplify ball.obj -o quiet.obj --faces 5000 -q
  succeeds burnish-simplify ball.obj -o exact.obj --faces 120
  same_bytes low.obj quiet.obj
  same_bytes low.obj exact.obj
}

@test "what cannot become fewer is warned of" {
  for x in 0 5 10; do printf 'v %d 0 0\nv %d 0 0\nv %d 1 0\nv %d 0 1\n' $x $((x + 1)) $x $x; done >three.obj
  for i in 0 4 8; do
    printf 'f %d %d %d\n' $((i + 1)) $((i + 3)) $((i + 2)) $((i + 1)) $((i + 2)) $((i + 4)) \
      $((i + 2)) $((i + 3)) $((i + 4)) $((i + 1)) $((i + 4)) $((i + 3))
  done >>three.obj
  call burnish-simplify three.obj -o low.obj --faces 6 --report r.json
  [ "$status" -eq 0 ]
  grep -qF "'three.obj': expected 6 triangles, got 12" err
  [ "$(value faces r.json)" = 12 ]
}

@test "every type of mesh in and out" {
  bare torus 16 torus.obj
  for from in obj ply off stl; do
    burnish-simplify torus.obj -o torus.$from --faces 1000000 -q || [ "$from" = obj ]
    for to in obj ply off stl; do
      succeeds burnish-simplify torus.$from -o low.$to --faces 200 --report r.json
      [ "$(value faces r.json) $(value vertices r.json)" = "200 100" ]
      [ -s low.$to ]
    done
  done
  succeeds burnish-simplify torus.obj -o low.ply --faces 200 --atlas 256
  succeeds burnish-transfer low.ply torus.obj -o n.png --size 64
  for to in off stl; do
    refuses 5 "'x.$to': texture coordinates are written as .obj or .ply only" burnish-simplify torus.obj -o x.$to --atlas 256
  done
  mesh torus 16 textured.obj
  refuses 5 "'x.stl': 'textured.obj' has texture coordinates" burnish-simplify textured.obj -o x.stl --faces 100
  refuses 5 "'x.fbx'" burnish-simplify torus.obj -o x.fbx --faces 100
  refuses 5 "'x.png'" burnish-simplify torus.obj -o x.png --faces 100
  refuses 5 "'torus.fbx'" burnish-simplify torus.fbx -o x.obj --faces 100
}

@test "the same bytes each time, on any number of threads, from anywhere" {
  bare torus 30 torus.obj
  mesh sphere 30 ball.obj
  mkdir -p a
  for name in torus ball; do
    succeeds burnish-simplify $name.obj -o one.obj --faces 300 -j 1 --report one.json
    (cd a && succeeds burnish-simplify ../$name.obj -o all.obj --faces 300 -j 4 --report all.json)
    same_bytes one.obj a/all.obj
    [ "$(value rms_distance one.json)" = "$(value rms_distance a/all.json)" ]
  done
  succeeds burnish-simplify torus.obj -o one.obj --faces 300 --atlas 256 -j 1
  succeeds burnish-simplify torus.obj -o two.obj --faces 300 --atlas 256 -j 3
  same_bytes one.obj two.obj
}

@test "positions that a file repeats are one vertex" {
  bare sphere 12 ball.obj
  # Every triangle on vertices of its own, as STL has them.
  succeeds burnish-simplify ball.obj -o low.obj --faces 100
  burnish-simplify ball.obj -o soup.stl --faces 1000000 -q
  succeeds burnish-simplify soup.stl -o low2.obj --faces 100 --report r.json
  [ "$(value vertices r.json)" = 52 ]
  [ "$(faces low.obj)" = "$(faces low2.obj)" ]
}

@test "faces without area are left out, with a warning" {
  bare torus 12 torus.obj
  printf 'f 1 2 1\nf 5 5 5\n' >>torus.obj
  call burnish-simplify torus.obj -o low.obj --faces 200
  [ "$status" -eq 0 ]
  [ "$(cat err)" = "burnish-simplify: warning: 'torus.obj': 2 faces without area are left out" ]
  [ "$(faces low.obj)" = 200 ]
  sed -i '$d' torus.obj
  call burnish-simplify torus.obj -o low.obj --faces 200
  [ "$(cat err)" = "burnish-simplify: warning: 'torus.obj': 1 face without area is left out" ]
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
  call burnish-simplify one.obj -o low.obj --faces 4
  [ "$(cat err)" = "burnish-simplify: warning: 'one.obj' has no more than 1 triangle; none is taken away" ]
}

@test "junk for numbers, and options that are missing" {
  bare torus 8 torus.obj
  for junk in 3 0 -1 1.5 many "" 99999999999999999999; do
    refuses 1 "--faces" burnish-simplify torus.obj -o x.obj --faces "$junk"
  done
  for junk in 15 0 -1 1.5 big "" 131073 256x256; do
    refuses 1 "--atlas" burnish-simplify torus.obj -o x.obj --atlas "$junk"
  done
  refuses 1 "--output" burnish-simplify torus.obj --faces 100
  refuses 1 "MESH" burnish-simplify -o x.obj --faces 100
  refuses 1 "" burnish-simplify torus.obj torus.obj -o x.obj --faces 100
}

@test "an atlas with more charts than its texels have room for" {
  bare sphere 20 ball.obj
  # Each triangle by itself.
  awk '/^v / { v[++n] = $0 } /^f / { for (i = 2; i <= 4; i++) { split(v[$i], p, " "); printf "v %.6f %.6f %.6f\n", p[2] + 9 * NR, p[3], p[4] }
    f[++m] = sprintf("f %d %d %d", 3 * m + 1 - 3, 3 * m + 2 - 3, 3 * m + 3 - 3) } END { for (i = 1; i <= m; i++) print f[i] }' ball.obj >loose.obj
  refuses 3 "'loose.obj': its 1520 charts do not fit into an atlas of 64x64 texels" burnish-simplify loose.obj -o x.obj --atlas 64
}

@test "meshes that do not serve: each with its message, and nothing left behind" {
  bare torus 8 torus.obj
  sed 's/^v [^ ]*/v nan/' torus.obj >nan.obj
  sed 's/^v [^ ]*/v inf/' torus.obj >infinite.obj
  : >empty.obj
  grep '^v ' torus.obj >no-faces.obj
  printf 'v 0 0 0\nv 1 0 0\nf 1 2 3\n' >dangling.obj
  printf '\000\377\120\154\171\n\001\376%.0s' $(seq 40) >junk.ply
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 2 4 3\n' >some-uvs.obj
  mkdir dir.obj
  for bad in nan.obj infinite.obj empty.obj no-faces.obj dangling.obj some-uvs.obj junk.ply; do
    refuses 3 "'$bad'" burnish-simplify $bad -o x.obj --faces 100
  done
  refuses 2 "'dir.obj'" burnish-simplify dir.obj -o x.obj --faces 100
  refuses 2 "'missing.obj'" burnish-simplify missing.obj -o x.obj --faces 100
  refuses 2 "'nowhere/x.obj'" burnish-simplify torus.obj -o nowhere/x.obj --faces 100
  refuses 1 "is an input" burnish-simplify torus.obj -o torus.obj --faces 100
}

@test "--depfile" {
  bare torus 8 torus.obj
  succeeds burnish-simplify torus.obj -o low.obj --faces 100 --depfile low.d
  [ "$(cat low.d)" = "low.obj: torus.obj" ]
}
