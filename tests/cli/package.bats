# The Debian package that cpack makes.
load helpers

@test "cpack: a package whose tools run where it is unpacked" {
  command -v dpkg-shlibdeps >/dev/null || skip "there is no dpkg-shlibdeps (Debian: dpkg-dev)"
  (cd "$BURNISH_BIN/.." && cpack -G DEB -B "$BATS_TEST_TMPDIR" >"$BATS_TEST_TMPDIR/log" 2>&1) || { cat log; false; }
  dpkg-deb --field burnish_*.deb Depends | grep -q libopenimageio
  dpkg -x burnish_*.deb root
  for tool in "$BURNISH_BIN"/burnish-*; do
    tool=$(basename "$tool")
    if ldd root/usr/bin/$tool | grep "not found\|libOpenImageIO"; then return 1; fi
    [ -s root/usr/share/man/man1/$tool.1 ]
    [ -s root/usr/share/bash-completion/completions/$tool ]
    root/usr/bin/$tool --version >/dev/null
  done
  [ -s root/usr/lib/cmake/burnish/burnishConfig.cmake ]
  make_image bumps 8 8 h.tif  # by the module of further image types
  readelf -d root/usr/bin/burnish-normals | grep -q 'RUNPATH.*\[$ORIGIN/../lib/burnish\]'
  succeeds root/usr/bin/burnish-normals h.tif -o n.tif
}
