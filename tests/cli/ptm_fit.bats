#!/usr/bin/env bats
# burnish-ptm fit

load helpers

teardown() {
  if mountpoint -q "$BATS_TEST_TMPDIR/disk" 2>/dev/null; then umount "$BATS_TEST_TMPDIR/disk"; fi
}

# photos COUNT [EXTENSION]: as many pictures p0 … of one pattern, brighter from one to the next, and their list l.lp under
# lights of a dome.
photos() {
  local count=$1 extension=${2:-png}
  "$PYTHON3" - "$count" "$extension" >l.lp <<'PYTHON'
import math, sys
count, extension = int(sys.argv[1]), sys.argv[2]
print(count)
for i in range(count):
    z = 0.25 + 0.7 * (i + 0.5) / count
    r, a = math.sqrt(1 - z * z), 2.399963 * i
    print(f"p{i}.{extension} {1.5 * r * math.cos(a):.9f} {1.5 * r * math.sin(a):.9f} {1.5 * z:.9f}")
PYTHON
  make_image colours 40 30 base.png
  for ((i = 0; i < count; i++)); do
    oiiotool base.png --mulc "0.$((35 + i * 4))" -o "p$i.$extension"
  done
}

@test "fit: a capture becomes a .ptm, an .exr or textures, and the report says how near they are" {
  photos 12
  succeeds burnish-ptm fit l.lp -o a.ptm --report a.json
  succeeds burnish-ptm fit l.lp -o a.exr --report b.json --type rgb --leave-one-out
  succeeds burnish-ptm fit l.lp -o a/ --report c.json --type rgb
  succeeds burnish-ptm fit l.lp -o b.exr --report d.json
  fits_schema ptm a.json b.json c.json d.json
  [ "$(head -c 26 a.ptm | tr '\n' ' ')" = "PTM_1.2 PTM_FORMAT_LRGB 40" ]
  [ "$(value images a.json) $(value width a.json) $(value height a.json)" = "12 40 30" ]
  [ "$(value type a.json) $(value type b.json)" = "lrgb rgb" ]
  # What floats hold is nearer than what bytes hold, and what all photos say nearer than what the others say.
  "$PYTHON3" - <<'PYTHON'
import json, math
a, b, c, d = (json.load(open(f"{name}.json"))["stats"] for name in "abcd")
assert 0 < b["rmse"] < c["rmse"] < 1.3 * b["rmse"], (b, c)
assert b["rmse"] < d["rmse"] < a["rmse"] < 30, (b, d, a)
assert abs(a["psnr_db"] - 20 * math.log10(255 / a["rmse"])) < 1e-9
assert b["rmse"] < b["leave_one_out_rmse"] < 40 and "leave_one_out_rmse" not in a
PYTHON
}

@test "fit: the bytes depend on neither threads nor memory nor the folder" {
  photos 8 jpg
  succeeds burnish-ptm fit l.lp -o all.ptm
  succeeds burnish-ptm fit l.lp -o one.ptm -j 1
  mkdir elsewhere temporary
  (cd elsewhere && TMPDIR=../temporary succeeds burnish-ptm fit ../l.lp -o little.ptm --memory 1 --report r.json)
  same_bytes all.ptm one.ptm
  same_bytes all.ptm elsewhere/little.ptm
  [ -z "$(ls -A temporary)" ]
  # To standard output too.
  burnish-ptm fit l.lp -o - --output-type ptm | same_bytes - all.ptm
}

@test "fit: a depfile names the list and the photographs, beside the list" {
  mkdir set
  (cd set && photos 6)
  succeeds burnish-ptm fit set/l.lp -o a.ptm --depfile a.d
  for name in l.lp p0.png p5.png; do grep -q " set/$name" a.d; done
}

@test "fit: a ridge and the rejection of shadows" {
  photos 14
  succeeds burnish-ptm fit l.lp -o a.ptm --ridge 0.01 --report a.json
  succeeds burnish-ptm fit l.lp -o b.ptm --reject-shadows --leave-one-out --report b.json
  succeeds burnish-ptm fit l.lp -o c.ptm
  fits_schema ptm a.json b.json
  ! cmp -s a.ptm c.ptm
  ! cmp -s b.ptm c.ptm
}

@test "fit: wrong options" {
  photos 6 exr
  refuses 1 "required" burnish-ptm fit l.lp
  refuses 1 "LIGHTS" burnish-ptm fit -o a.ptm
  refuses 1 "--type: expected lrgb|rgb, got 'lum'" burnish-ptm fit l.lp -o a.ptm --type lum
  refuses 1 "--memory" burnish-ptm fit l.lp -o a.ptm --memory 0
  refuses 1 "--ridge" burnish-ptm fit l.lp -o a.ptm --ridge -1
  refuses 1 "'p3.exr'" burnish-ptm fit l.lp -o p3.exr
  refuses 5 "'a.png'" burnish-ptm fit l.lp -o a.png
  refuses 2 "nowhere" burnish-ptm fit l.lp -o nowhere/a.ptm
  refuses 2 "'none.lp'" burnish-ptm fit none.lp -o a.ptm
}

@test "fit: lists that say too little, or the wrong thing" {
  photos 8
  sed 's/p3/p2/' l.lp >twice.lp
  refuses 3 "'twice.lp': line 5: 'p2.png' is there already, in line 4" burnish-ptm fit twice.lp -o a.ptm
  sed '1s/8/9/' l.lp >more.lp
  refuses 3 "'more.lp': expected 9 photos, as line 1 says, got 8" burnish-ptm fit more.lp -o a.ptm
  { echo 5 && sed -n 2,6p l.lp; } >five.lp
  refuses 3 "'five.lp': expected at least 6 lights for 6 coefficients, got 5" burnish-ptm fit five.lp -o a.ptm
  { echo 8 && for i in 0 1 2 3 4 5 6 7; do echo "p$i.png 0.1 0.$i 0.7"; done; } >plane.lp
  refuses 3 "'plane.lp': expected lights that determine 6 coefficients" burnish-ptm fit plane.lp -o a.ptm
  succeeds burnish-ptm fit plane.lp -o a.ptm --ridge 0.01
  sed '4s/ [^ ]*$/ -0.5/' l.lp >below.lp
  refuses 3 "'below.lp': line 4: expected a light above the surface, got z = -0.5" burnish-ptm fit below.lp -o b.ptm
  { echo 6 && sed -n 2,7p l.lp; } >six.lp
  refuses 3 "leave-one-out" burnish-ptm fit six.lp -o b.ptm --leave-one-out
}

@test "fit: photographs that are missing, of another size or damaged are named, and the old output stays" {
  photos 7 jpg
  succeeds burnish-ptm fit l.lp -o a.ptm
  mv p4.jpg kept.jpg
  refuses 2 "'p4.jpg'" burnish-ptm fit l.lp -o a.ptm
  make_image colours 41 30 wide.png
  oiiotool wide.png -o p4.jpg
  refuses 3 "'p4.jpg': expected 40x30 texels as in 'p0.jpg', got 41x30" burnish-ptm fit l.lp -o a.ptm
  head -c 900 kept.jpg >p4.jpg
  refuses 3 "'p4.jpg': " burnish-ptm fit l.lp -o a.ptm
  head -c -2 kept.jpg >p4.jpg
  refuses 3 "'p4.jpg': " burnish-ptm fit l.lp -o a.ptm
  rm p4.jpg && mkdir p4.jpg
  refuses 2 "'p4.jpg'" burnish-ptm fit l.lp -o a.ptm
  rmdir p4.jpg && cp kept.jpg p4.jpg
  TMPDIR=none refuses 2 "'none': cannot hold a temporary file" burnish-ptm fit l.lp -o a.ptm --memory 1
}

@test "fit: a disk that is full, of the output or of the temporary file, leaves nothing" {
  photos 7
  for i in 0 1 2 3 4 5 6; do oiiotool "p$i.png" --resize 200x200 -o "p$i.png"; done
  small_disk disk
  refuses 2 "disk/a.ptm" burnish-ptm fit l.lp -o disk/a.ptm
  TMPDIR=disk refuses 2 "'disk': a temporary file in it fails: No space left on device" \
    burnish-ptm fit l.lp -o a.ptm --memory 1
  [ -z "$(ls -A disk)" ]
}

@test "fit: bytes between a JPEG's last scan and its end are no damage" {
  photos 7 jpg
  burnish-ptm fit l.lp -o a.ptm
  mv p4.jpg kept.jpg
  { head -c -2 kept.jpg && printf '\0\0\0\0\377\331'; } >p4.jpg
  succeeds burnish-ptm fit l.lp -o b.ptm
  same_bytes a.ptm b.ptm
}

@test "fit: more photographs than a process may open unless it asks" {
  photos 12
  { echo 84 && for copy in 0 1 2 3 4 5 6; do sed "1d; s/^p/c${copy}_p/" l.lp; done; } >many.lp
  for copy in 0 1 2 3 4 5 6; do
    for ((i = 0; i < 12; i++)); do cp p$i.png c${copy}_p$i.png; done
  done
  (ulimit -Sn 64 && succeeds burnish-ptm fit many.lp -o many.ptm)
}
