#!/usr/bin/env bats
# Output bytes depend on inputs and options alone: every tool on other numbers of threads, and as on another processor.

load helpers

@test "the same bytes on 1, 2 and 8 threads, and without the processor's fused multiply-add" {
  export BURNISH_SIDE=48 BURNISH_COMPARE_DIR="$PWD"
  call "$BURNISH_SOURCE_DIR/scripts/compare-builds" "$BURNISH_BIN/.."
  cat out err
  [ "$status" -eq 0 ]
  [ "$(grep -cE ': [0-9]{3} outputs, 0 differ$' out)" -eq 2 ]
}

@test "scripts/compare-builds names what differs, and fails" {
  mkdir scripts
  cp "$BURNISH_SOURCE_DIR/scripts/compare-builds" scripts
  printf '#!/bin/sh\necho "00  same.png"\necho "0$4  threads.png"\n' >scripts/run-tools
  chmod +x scripts/run-tools
  BURNISH_COMPARE_DIR="$PWD" call scripts/compare-builds one
  [ "$status" -eq 1 ]
  [ "$(head -n 2 out)" = "1 thread: 2 outputs, 1 differ
  threads.png" ]
}

@test "no function of libm that may differ is called in lib/: portable_math.h has them" {
  local functions='exp|exp2|expm1|log|log2|log10|log1p|pow|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|cbrt|hypot|erf'
  call grep -rnE "(std::|[^a-z_.:>])($functions)f?\(" --include=*.cpp --include=*.h "$BURNISH_SOURCE_DIR/lib" --exclude='portable_math.*'
  grep -vE "//.*($functions)f?\\(" out >found || true  # comments
  cat found
  [ ! -s found ]
}
