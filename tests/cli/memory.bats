#!/usr/bin/env bats
# Maps that are larger than the memory they may take: what a tool needs grows with the width of its maps, not with their
# area. Of 2048 x 16384 texels floats of one channel are 134 MB.

load helpers

# Flat maps of three and of one channel: normals.png, map.png.
inputs() {
  "${PYTHON3:-python3}" - <<'PYTHON'
import struct, zlib
def chunk(name, data): return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
def flat(file, colour_type, texel, width=2048, height=16384):
    row = b"\0" + bytes(texel) * width
    packed = zlib.compressobj(1)
    data = b"".join([packed.compress(row * 64) for _ in range(height // 64)] + [packed.flush()])
    head = struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0)
    open(file, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b""))
flat("normals.png", 2, (190, 140, 230))
flat("map.png", 0, (150,))
PYTHON
}

# within MIB COMMAND…: succeeds, and never holds more than that.
within() {
  needs_bare_memory
  "${PYTHON3:-python3}" - "$@" <<'PYTHON'
import resource, subprocess, sys
subprocess.run(sys.argv[2:], check=True)
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
assert peak < float(sys.argv[1]), f"{peak:.0f} MiB for {sys.argv[2:]}"
PYTHON
}

@test "burnish-mipmap: normals and their roughness, a chain and a level a file" {
  inputs
  within 200 burnish-mipmap normals.png --kind normal -o m.exr --roughness map.png --roughness-output r.exr -q
  within 200 burnish-mipmap normals.png --kind normal --split 'l_%d.png' -q
  [ "$("$BURNISH_FIXTURE" info l_3.png)" = "256 2048 3 uint8" ]
}

@test "burnish-tangents: with normals, and turned" {
  inputs
  within 200 burnish-tangents normals.png --from flow --normal normals.png -o t.png -q
  within 200 burnish-tangents normals.png --from flow --rotate 90 -o q.png -q
  [ "$("$BURNISH_FIXTURE" info q.png)" = "16384 2048 3 uint8" ]
}

@test "burnish-material: every parameter a map" {
  inputs
  within 250 burnish-material --model ward --alpha-x map.png --alpha-y map.png --ks map.png --angle map.png \
    --normal normals.png -o m -q
}
