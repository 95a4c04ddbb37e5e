#!/usr/bin/env bats
# Files that are made to hurt: small, and said to be huge, or huge once they are unpacked. Refused before anything is set
# aside or decoded for them.

load helpers
load ptm_inputs

# holds_less MIB COMMAND…: whatever becomes of the command, it never holds more than that. Sanitizers need memory of their own.
holds_less() {
  if grep -qa __asan_init "$BURNISH_BIN/$2"; then return 0; fi
  "${PYTHON3:-python3}" - "$@" <<'PYTHON'
import resource, subprocess, sys
subprocess.run(sys.argv[2:], stderr=subprocess.DEVNULL)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
assert peak < float(sys.argv[1]), f"{peak:.0f} MiB for {sys.argv[2:]}"
PYTHON
}

inputs() {
  make_image normals 16 16 n16.png
  make_ptm RGB 100 80 a.ptm
  for i in 1 2 3 4 5 6; do burnish-ptm relight a.ptm --light "0.$i,0.$((i * i % 7)),1" -o "p$i.png"; done
  { echo 6 && for i in 1 2 3 4 5 6; do echo "p$i.png 0.$i 0.$((i * i % 7)) 1"; done; } >l.lp
}

@test "images of more texels than --max-texels: exit 5, with the number to give" {
  inputs
  local type
  for type in png tif exr tga bmp; do
    make_image normals 16 16 n16.$type
    refuses 5 "--max-texels: expected at least 256 for 'n16.$type' of 16x16 texels, got 255" \
      burnish-mipmap n16.$type --kind normal -o x.exr --max-texels 255
    succeeds burnish-mipmap n16.$type --kind normal -o x.exr --max-texels 256
  done
  for type in jpg hdr ppm; do
    oiiotool n16.png -o n16.$type
    refuses 5 "--max-texels: expected at least 256" burnish-mipmap n16.$type --kind normal -o x.exr --max-texels 255
  done
  burnish-normals n16.png --channel 0 -o n16.exr
  for type in png exr ktx2 dds; do
    burnish-quantize n16.exr -n 4 -o q16.$type --palette-output p.exr
    refuses 5 "--max-texels: expected at least 256 for 'q16.$type'" \
      burnish-mipmap q16.$type --palette p.exr -o x.exr --max-texels 255
  done
  burnish-ptm convert a.ptm --jpeg 90 -o j.ptm
  refuses 5 "--max-texels: expected at least 8000 for 'j.ptm' of 100x80 texels" \
    burnish-ptm relight j.ptm --light 0,0,1 -o x.png --max-texels 7999
  oiiotool p1.png -o p1.jpg
  sed 's/p1.png/p1.jpg/' l.lp >j.lp
  refuses 5 "--max-texels: expected at least 8000 for 'p1.jpg'" burnish-ptm fit j.lp -o x.ptm --max-texels 7999
  refuses 1 "--max-texels: expected an integer of at least 1, got '0'" burnish-normals n16.png -o x.png --max-texels 0
}

@test "files that unfold to more than anyone meant are refused at once, and holding little" {
  "${PYTHON3:-python3}" - <<'PYTHON'
import struct, zlib
side = 33000  # more than 2^30 texels, of a bit each
def chunk(name, data): return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
row, pack = bytes(1 + side // 8), zlib.compressobj(9)
data = b"".join([pack.compress(row * 1000) for _ in range(side // 1000)] + [pack.flush()])
for name, kind, more in ("bomb.png", 0, b""), ("indexed.png", 3, chunk(b"PLTE", bytes(6))):
    head = struct.pack(">IIBBBBB", side, side, 1, kind, 0, 0, 0)
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + more + chunk(b"IDAT", data) + chunk(b"IEND", b""))
PYTHON
  [ "$(stat -c %s bomb.png)" -lt 200000 ]
  for tool in "normals bomb.png" "quantize indexed.png" "mipmap indexed.png" "tangents bomb.png --from angle"; do
    refuses 5 "--max-texels: expected at least 1089000000 for '" burnish-$tool -o x.exr
    holds_less 250 burnish-$tool -o x.exr
  done
}

# sparse NAME: 64 GB that take no room on the disk, in a folder elsewhere: the tests look at every byte of theirs.
sparse() {
  export far=$BATS_FILE_TMPDIR
  truncate -s 64G "$far/$1" 2>/dev/null || skip "no file is that large here"
}

@test "text and measurements that are larger than any: refused by their size" {
  local file
  for file in s.lp s.brdf s.binary s.mbsdf s.toml s.histogram; do sparse $file; done
  refuses 3 "/s.lp': expected at most 268435456 bytes" burnish-ptm fit $far/s.lp -o x.ptm
  for file in s.brdf s.binary s.mbsdf; do refuses 3 "/$file': expected at most" burnish-ptm brdf $far/$file -o x/; done
  refuses 3 "/s.toml': expected at most" burnish-render $far/s.toml -o x.png
  refuses 3 "/s.toml': expected at most" burnish-batch $far/s.toml --build-dir build
  refuses 3 "/s.histogram': expected at most" burnish-quantize --histograms $far/s.histogram -n 16 --palette-output x.exr
}

@test "meshes, polynomials and PNM that are larger than memory: refused by their size" {
  [ "$(getconf _PHYS_PAGES)" -lt $((60 << 18)) ] || skip "there is memory for 64 GB"
  local file
  for file in s.obj s.ply s.stl s.off; do
    sparse $file
    refuses 5 "/$file': is larger than memory: 68719476736 bytes" burnish-simplify $far/$file --faces 10 -o x.obj
  done
  sparse s.ptm
  refuses 5 "/s.ptm': is larger than memory" burnish-ptm relight $far/s.ptm --light 0,0,1 -o x.png
  sparse s.pgm
  printf 'P5\n# a comment\n16 16\n255\n' | dd of="$far/s.pgm" conv=notrunc status=none
  refuses 5 "/s.pgm': is larger than memory" burnish-normals $far/s.pgm -o x.png
  printf 'P5\n# a comment\n60000 60000\n255\n' | dd of="$far/s.pgm" conv=notrunc status=none
  refuses 5 "--max-texels: expected at least 3600000000" burnish-normals $far/s.pgm -o x.png
}

@test "counts and tiles that no file of that size holds: refused before memory is set aside" {
  "${PYTHON3:-python3}" - <<'PYTHON'
import struct, zlib
head = "ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n" \
       "element face %d\nproperty list %s int vertex_indices\nend_header\n"
corners = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
open("faces.ply", "w").write(head % ("ascii", 3, 4000000000, "uchar") + corners)
open("vertices.ply", "w").write(head % ("ascii", 4000000000, 1, "uchar") + corners)
open("list.ply", "wb").write((head % ("binary_little_endian", 3, 1, "uint")).encode() + bytes(36) + b"\xff" * 4 + bytes(12))
open("count.stl", "wb").write(bytes(80) + struct.pack("<I", 4000000000) + bytes(50))
open("count.off", "w").write("OFF\n4000000000 4000000000 0\n0 0 0\n")
open("index.obj", "w").write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2000000000\n")
packed = zlib.compress(bytes(1000))
def tiff(name, size, tile):
    tags = [(256, size), (257, size), (258, 8), (259, 8), (262, 1), (277, 1), (322, tile), (323, tile), (324, 8), (325, len(packed))]
    entries = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags)
    open(name, "wb").write(b"II*\0" + struct.pack("<I", 8 + len(packed)) + packed + struct.pack("<H", len(tags)) + entries + bytes(4))
tiff("tile.tif", 30016, 30016)
tiff("larger.tif", 100, 1 << 20)
PYTHON
  for file in *.ply *.stl *.off *.obj; do
    refuses 3 "'$file': " burnish-simplify $file --faces 10 -o x.obj
    holds_less 250 burnish-simplify $file --faces 10 -o x.obj
  done
  for file in *.tif; do
    refuses 3 "'$file': is too short for tiles of" burnish-normals $file -o x.png
    holds_less 250 burnish-normals $file -o x.png
  done
}
