# Polynomial texture maps for tests: `load ptm_inputs` behind `load helpers`.

# make_ptm TYPE WIDTH HEIGHT FILE: a .ptm of smooth coefficients, TYPE being LRGB or RGB.
make_ptm() {
  "$PYTHON3" - "$@" <<'PYTHON'
import math, sys
kind, width, height, name = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
def byte(x, y, i):
    return round(127 + 100 * math.sin(0.11 * x + 0.3 * i) * math.cos(0.07 * y + 0.5 * i))
texels = [(x, y) for y in reversed(range(height)) for x in range(width)]
body = bytes()
for c in range(3 if kind == "RGB" else 1):
    body += bytes(byte(x, y, 6 * c + k) for x, y in texels for k in range(6))
if kind == "LRGB":
    body += bytes(128 + byte(x, y, 20 + c) // 2 for x, y in texels for c in range(3))
head = f"PTM_1.2\nPTM_FORMAT_{kind}\n{width}\n{height}\n0.25 0.25 0.2 0.5 0.5 0.3\n260 255 127 120 130 -300\n"
open(name, "wb").write(head.encode() + body)
PYTHON
}
