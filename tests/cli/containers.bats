#!/usr/bin/env bats
# KTX2 and DDS, which burnish-quantize and burnish-mipmap write and read; their every field is tested in
# unit/palette_containers_test.cpp, here what parsers of others find in them.

load helpers

teardown() {
  if mountpoint -q "$BATS_TEST_TMPDIR/disk" 2>/dev/null; then umount "$BATS_TEST_TMPDIR/disk"; fi
}

inputs() {
  make_image normals 67 45 n.png
  make_image ids 67 45 ids.png
  local n
  for n in 64 300; do
    burnish-quantize n.png --material ids.png -n $n -o q$n.exr
    burnish-mipmap q$n.exr -o m$n.exr
  done
}

digest() { "$BURNISH_FIXTURE" digest "$1"; }

@test "a KTX2 holds a chain, palette and intervals, and comes back as it went in" {
  inputs
  for n in 64 300; do
    succeeds burnish-mipmap q$n.exr -o m.ktx2 --report r.json
    fits_schema mipmap r.json
    for back in exr ktx2; do
      succeeds burnish-mipmap m.ktx2 -o back.$back
      [ "$(digest back.$back)" = "$(digest m$n.exr)" ]
    done
    same_bytes back.exr m$n.exr
    same_bytes back.ktx2 m.ktx2
  done
}

@test "ktx-parse finds in a KTX2 what the EXR holds" {
  needs_node_package ktx-parse
  inputs
  while read -r n format; do
    succeeds burnish-mipmap q$n.exr -o m.ktx2
    digest m$n.exr >expected
    node "$BURNISH_SOURCE_DIR/tests/cli/ktx_digest.mjs" m.ktx2 "$format" >found
    diff expected found
    succeeds burnish-quantize n.png --material ids.png -n $n -o q.ktx2
    digest q$n.exr >expected
    node "$BURNISH_SOURCE_DIR/tests/cli/ktx_digest.mjs" q.ktx2 "$format" >found
    diff expected found
  done <<<"64 13
300 74"
}

@test "a DDS holds a chain, its palette goes beside, and both come back as they went in" {
  inputs
  for n in 64 300; do
    for palette in p.exr p.png; do
      succeeds burnish-mipmap q$n.exr -o m.dds --palette-output $palette --report r.json
      fits_schema mipmap r.json
      succeeds burnish-mipmap m.dds --palette $palette -o back.exr --depfile d
      same_bytes back.exr m$n.exr
      [ "$(cat d)" = "back.exr: m.dds $palette" ]
    done
  done
  succeeds burnish-mipmap m.dds --palette q300.exr -o back.exr  # of an indexed map
  same_bytes back.exr m300.exr
}

@test "nvddsinfo knows what is in a DDS" {
  command -v nvddsinfo >/dev/null || skip "there is no nvddsinfo: Debian has it in libnvtt-bin"
  inputs
  while read -r n format; do
    succeeds burnish-mipmap q$n.exr -o m.dds --palette-output p.exr
    nvddsinfo m.dds >found
    for line in "Height: 45" "Width: 67" "Mipmap count: 7" "FourCC: 'DX10'" "DXGI Format: $format" "DDSCAPS_MIPMAP" \
      "Resource dimension: 3 (TEXTURE2D)" "Array size: 1"; do
      grep -qF "$line" found || { echo "no $line"; cat found; return 1; }
    done
  done <<<"64 62 (R8_UINT)
300 57 (R16_UINT)"
}

@test "burnish-quantize writes both, and reads palettes of KTX2" {
  inputs
  succeeds burnish-quantize n.png --material ids.png -n 300 -o q.ktx2 --report r.json
  fits_schema quantize r.json
  [ "$(digest q.ktx2)" = "$(digest q300.exr)" ]
  succeeds burnish-quantize n.png --material ids.png -n 300 -o q.dds --palette-output p.exr --report r.json
  fits_schema quantize r.json
  succeeds burnish-mipmap q.dds --palette p.exr -o back.exr
  same_bytes back.exr m300.exr
  succeeds burnish-quantize n.png --material ids.png --palette q.ktx2 -o x.exr
  same_bytes x.exr q300.exr
  refuses 3 "expected a palette" burnish-quantize n.png --palette q.dds -o y.exr
}

@test "a DDS without --palette-output is a usage error that says what to do" {
  inputs
  refuses 1 "--palette-output FILE" burnish-quantize n.png -o x.dds
  refuses 1 "--palette-output FILE" burnish-mipmap q64.exr -o x.dds
  refuses 1 "--palette-output FILE" burnish-mipmap q64.exr --split 'x_%d.dds'
  for palette in p.dds p.ktx2 p.tif; do
    refuses 5 "a palette is written as EXR or PNG" burnish-mipmap q64.exr -o x.dds --palette-output $palette
    refuses 5 "a palette is written as EXR or PNG" burnish-quantize n.png -o x.dds --palette-output $palette
  done
  refuses 1 "twice" burnish-mipmap q64.exr -o x.exr --palette-output x.exr
  refuses 1 "is an input" burnish-mipmap q64.exr -o x.dds --palette-output q64.exr
}

@test "burnish-mipmap --palette is for maps without one" {
  inputs
  burnish-mipmap q64.exr -o m.dds --palette-output p.exr
  burnish-mipmap q64.exr -o m.ktx2
  refuses 1 "--palette" burnish-mipmap m.dds -o x.exr
  refuses 1 "its own palette" burnish-mipmap m.ktx2 --palette p.exr -o x.exr
  refuses 1 "its own palette" burnish-mipmap q64.exr --palette p.exr -o x.exr
  refuses 2 "'none.exr'" burnish-mipmap m.dds --palette none.exr -o x.exr
  refuses 3 "N x 1" burnish-mipmap m.dds --palette n.png -o x.exr
  refuses 1 "is an input" burnish-mipmap m.dds --palette p.exr -o p.exr
  burnish-quantize n.png -n 2 -o two.exr
  refuses 3 "expected indices below 2" burnish-mipmap m.dds --palette two.exr -o x.exr
}

@test "--palette-output of a chain is the palette of its base" {
  inputs
  burnish-quantize n.png --material ids.png -n 64 -o q.exr --palette-output p.exr
  succeeds burnish-mipmap q64.exr -o m.exr --palette-output x.exr
  same_bytes x.exr p.exr
  same_bytes m.exr m64.exr
}

@test "--levels and --split" {
  inputs
  succeeds burnish-mipmap q300.exr --levels 3 -o three.ktx2
  [ "$(digest three.ktx2 | grep -c ^level)" = 3 ]
  succeeds burnish-mipmap q300.exr --levels 3 -o three.dds --palette-output p.exr
  [ "$(stat -c %s three.dds)" = $((148 + 2 * (67 * 45 + 33 * 22 + 16 * 11))) ]
  succeeds burnish-mipmap q300.exr --split 'l_%d.ktx2'
  succeeds burnish-mipmap q300.exr --split 'l_%d.dds' --palette-output p.exr --report r.json
  fits_schema mipmap r.json
  succeeds burnish-mipmap q300.exr --split 'l_%d.exr'
  for l in 0 1 2 3 4 5 6; do
    [ "$(digest l_$l.ktx2)" = "$(digest l_$l.exr)" ]
    succeeds burnish-mipmap l_$l.dds --palette p.exr --levels 1 -o x.exr
    same_bytes x.exr l_$l.exr
  done
}

@test "-d may only say what is stored" {
  inputs
  while read -r n stored; do
    for type in ktx2 dds; do
      for d in uint8 uint16 half float; do
        if [ $d = "$stored" ]; then
          succeeds burnish-mipmap q$n.exr -o x.$type --palette-output p.exr -d $d
          succeeds burnish-quantize n.png -n $n -o x.$type --palette-output p.exr -d $d
        else
          refuses 5 "as $stored, not $d" burnish-mipmap q$n.exr -o y.$type --palette-output z.exr -d $d
          refuses 5 "as $stored, not $d" burnish-quantize n.png -n $n -o y.$type --palette-output z.exr -d $d
        fi
      done
    done
  done <<<"64 uint8
300 uint16"
}

@test "textures that are no indices: exit 5, by the name of their format" {
  inputs
  burnish-mipmap q64.exr -o m.ktx2
  burnish-mipmap q64.exr -o m.dds --palette-output p.exr
  printf '\045' | dd of=m.ktx2 bs=1 seek=12 conv=notrunc status=none
  refuses 5 "VK_FORMAT_R8G8B8A8_UNORM" burnish-mipmap m.ktx2 -o x.exr
  printf '\142' | dd of=m.dds bs=1 seek=128 conv=notrunc status=none
  refuses 5 "DXGI_FORMAT_BC7_UNORM" burnish-mipmap m.dds --palette p.exr -o x.exr
  if command -v nvcompress >/dev/null; then
    nvcompress -bc1 -silent n.png bc1.dds >/dev/null
    refuses 5 "FourCC 'DXT1'" burnish-mipmap bc1.dds --palette p.exr -o x.exr
  fi
}

@test "neither is written or read as a plain image" {
  inputs
  make_image bumps 8 8 h.png
  for type in ktx2 dds; do refuses 5 "for indexed normal maps only" burnish-normals h.png -o x.$type; done
  burnish-mipmap q64.exr -o m.ktx2
  burnish-mipmap q64.exr -o m.dds --palette-output p.exr
  for type in ktx2 dds; do
    refuses 5 "an indexed normal map only" burnish-normals m.$type -o x.png
    refuses 5 "an indexed normal map only" burnish-quantize m.$type -o x.exr
  done
}

@test "damaged ones: exit 3" {
  inputs
  burnish-mipmap q300.exr -o m.ktx2
  burnish-mipmap q300.exr -o m.dds --palette-output p.exr
  for type in ktx2 dds; do
    size=$(stat -c %s m.$type)
    for part in 1 10 50 99; do
      head -c $((size * part / 100)) m.$type >cut.$type
      # shellcheck disable=SC2046
      refuses 3 "'cut.$type'" burnish-mipmap cut.$type $([ $type = dds ] && echo --palette p.exr) -o x.exr
    done
  done
  head -c 3 m.dds >cut.dds
  refuses 3 "'cut.dds'" burnish-mipmap cut.dds --palette p.exr -o x.exr
}

@test "nowhere to write, or a full disk: exit 2" {
  make_image normals 300 300 n.png
  burnish-quantize n.png -n 300 -o q.exr
  refuses 2 "'nowhere/x.ktx2'" burnish-mipmap q.exr -o nowhere/x.ktx2
  small_disk disk
  for type in ktx2 dds; do refuses 2 "'disk/x.$type'" burnish-mipmap q.exr -o disk/x.$type --palette-output p.exr; done
}

@test "burnish-render takes a KTX2 as it takes the EXR" {
  inputs
  for type in exr ktx2; do
    burnish-mipmap q64.exr -o m.$type
    printf '[image]\nwidth = 24\nheight = 16\n[[light]]\ndirection = [1, 1, 2]\n[[object]]\nindexed_map = "m.%s"\n' $type >s.toml
    for id in 0 1 2 3; do printf '[[material]]\nid = %d\n' $id >>s.toml; done
    succeeds burnish-render s.toml --path palette -o $type.png
  done
  same_bytes exr.png ktx2.png
}

@test "the same bytes for any thread count, run and folder; - reads both" {
  inputs
  mkdir a
  for type in ktx2 dds; do
    succeeds burnish-mipmap q300.exr -o m.$type --palette-output p.exr -j 1
    (cd a && succeeds burnish-mipmap ../q300.exr -o m.$type --palette-output p.exr -j 8)
    same_bytes m.$type a/m.$type
  done
  burnish-mipmap - -o x.exr <m.ktx2
  same_bytes x.exr m300.exr
  burnish-mipmap - --palette p.exr -o x.exr <m.dds
  same_bytes x.exr m300.exr
}
