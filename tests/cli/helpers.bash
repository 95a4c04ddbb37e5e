# What the command-line tests share: `load helpers` at the top of a .bats file.
#
# Each test runs in an empty folder of its own. BURNISH_BIN is the folder of the tools, BURNISH_FIXTURE the program that makes
# inputs; CTest sets both, and BURNISH_SOURCE_DIR and PYTHON3.

setup() {
  : "${BURNISH_BIN:?run these through ctest, or set BURNISH_BIN and BURNISH_FIXTURE}"
  PATH="$BURNISH_BIN:$PATH"
  cd "$BATS_TEST_TMPDIR"
}

# make PATTERN WIDTH HEIGHT FILE [SAMPLE]
make_image() { "$BURNISH_FIXTURE" make "$@"; }

# Runs a command with its streams in the files out and err, its exit code in $status.
call() {
  status=0
  "$@" >out 2>err || status=$?
}

# succeeds COMMAND…: exit 0 and nothing on standard error.
succeeds() {
  call "$@"
  [ "$status" -eq 0 ] || { echo "exit $status from: $*"; cat err; return 1; }
  [ ! -s err ] || { echo "standard error of: $*"; cat err; return 1; }
}

# refuses CODE PART COMMAND…: that exit code; one line on standard error, of the tool's own form, with PART in it; nothing on
# standard output; and no file in this folder that was not there before, nor one that changed.
refuses() {
  local code=$1 part=$2
  shift 2
  rm -f out err
  local before after
  before=$(inventory)
  call "$@"
  after=$(inventory)
  [ "$status" -eq "$code" ] || { echo "exit $status instead of $code from: $*"; cat err; return 1; }
  [ "$(wc -l <err)" -eq 1 ] || { echo "not one line on standard error from: $*"; cat err; return 1; }
  grep -q "^$(basename "$1"): error: " err || { echo "another form of error from: $*"; cat err; return 1; }
  grep -qF -- "$part" err || { echo "no '$part' in the error of: $*"; cat err; return 1; }
  [ ! -s out ] || { echo "something on standard output of: $*"; return 1; }
  [ "$before" = "$after" ] || { echo "files changed by: $*"; diff <(echo "$before") <(echo "$after"); return 1; }
}

# Every file of this folder, hidden ones too, with its checksum.
inventory() {
  find . -mindepth 1 ! -path ./out ! -path ./err \( -type f -exec cksum {} + -o -print \) | LC_ALL=C sort
}

same_bytes() { cmp "$@"; }
same_pixels() { "$BURNISH_FIXTURE" same "$@"; }

# texel_is "VALUES" FILE COLUMN ROW [TOLERANCE], which is 1e-6: samples as `burnish-fixture texel` prints them.
texel_is() {
  "${PYTHON3:-python3}" - "$1" "$("$BURNISH_FIXTURE" texel "$2" "$3" "$4")" "${5:-1e-6}" <<'PYTHON'
import sys
wanted, got = (list(map(float, a.split())) for a in sys.argv[1:3])
assert len(wanted) == len(got) and all(abs(a - b) <= float(sys.argv[3]) for a, b in zip(wanted, got)), sys.argv
PYTHON
}

# fits_schema TOOL REPORT…
fits_schema() {
  local schema=$1
  shift
  "${PYTHON3:-python3}" "$BURNISH_SOURCE_DIR/tests/cli/fits_schema.py" "$BURNISH_SOURCE_DIR/tools/schema/$schema.json" "$@"
}

# value KEY REPORT: one figure of a report's stats.
value() { "${PYTHON3:-python3}" -c 'import json, sys; print(json.load(open(sys.argv[2]))["stats"][sys.argv[1]])' "$@"; }

# A folder on a disk with 64 KiB of room, or a skipped test.
small_disk() {
  mkdir -p "$1"
  [ "$(id -u)" -eq 0 ] || skip "only root can mount a small disk"
  mount -t tmpfs -o size=64k tmpfs "$1" 2>/dev/null || skip "no disk can be mounted here"
}

# Skips the test where the tools hold memory that is not theirs.
needs_bare_memory() {
  if grep -qaE '__(asan|tsan)_init' "$BURNISH_BIN/burnish-normals"; then skip "sanitizers need memory of their own"; fi
}

# Skips the test unless Node and an npm package are there. Its scripts then say: import { load } from './node_package.mjs'
needs_node_package() {
  export BURNISH_NODE_MODULES="${BURNISH_NODE_MODULES:-$BURNISH_SOURCE_DIR/build/node_modules}"
  command -v node >/dev/null || skip "there is no node"
  [ -e "$BURNISH_NODE_MODULES/$1" ] || skip "$BURNISH_NODE_MODULES has no $1: scripts/install-packages node"
}

# A negated command never fails a test: differ A B does.
differ() { if cmp -s "$1" "$2"; then echo "$1 is $2"; return 1; fi; }
