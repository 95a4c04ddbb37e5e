# The CMake package and the makefile of the samples: what is made, what is made again, and what is not.
load helpers

setup_file() {
  export PREFIX=$BATS_FILE_TMPDIR/prefix
  cmake --install "$BURNISH_BIN/.." --prefix "$PREFIX" >/dev/null
}

# Files below a directory that are newer than the mark there, without depfiles and those of the build system.
made_since_mark() {
  find "$1" -newer "$1/mark" \( -name '*.png' -o -name '*.exr' -o -name '*.ktx2' \) -printf '%P\n' | sort | tr '\n' ' '
}
mark() {
  touch "$1/mark"
  sleep 1.1  # make knows whole seconds on some file systems
}

cmake_sample() {
  cp -r "$BURNISH_SOURCE_DIR/samples/cmake" source
  cmake -G "$1" -S source -B made -DCMAKE_PREFIX_PATH="$PREFIX" >log 2>&1 || { cat log; false; }
  cmake --build made >log 2>&1 || { cat log; false; }
  for file in surfaces/{studs,tiles,waves}.ktx2 shared/{studs,tiles}_n.exr tiles.png; do [ -s made/$file ]; done

  mark made
  cmake --build made >log
  [ -z "$(made_since_mark made)" ]

  touch source/textures/waves.png
  cmake --build made >log
  [ "$(made_since_mark made)" = "surfaces/surfaces.dir/waves_n.png surfaces/surfaces.dir/waves_q.exr surfaces/waves.ktx2 " ]

  # The picture depends on a map that only its scene names.
  mark made
  touch source/textures/tiles.png
  cmake --build made >log
  [ "$(made_since_mark made)" = "shared/studs_n.exr shared/tiles_n.exr surfaces/surfaces.dir/tiles_n.png surfaces/surfaces.dir/tiles_q.exr \
surfaces/tiles.ktx2 tiles.png tiles_n.png " ]

  # A texture more.
  mark made
  cp source/textures/waves.png source/textures/more.png
  cmake --build made >log
  [ "$(made_since_mark made)" = "surfaces/more.ktx2 surfaces/surfaces.dir/more_n.png surfaces/surfaces.dir/more_q.exr " ]

  # A failure leaves nothing that would pass for done, and is made good.
  head -c 100 source/textures/studs.png >cut.png
  cp cut.png source/textures/more.png
  ! cmake --build made >log 2>&1
  grep -q "more.png'" log
  cp source/textures/waves.png source/textures/more.png
  cmake --build made >log
  cmp made/surfaces/more.ktx2 made/surfaces/waves.ktx2
}

@test "samples/cmake with Ninja" {
  cmake_sample Ninja
  run cmake --build made
  [[ $output == *"no work to do"* ]]
}

@test "samples/cmake with makefiles" { cmake_sample "Unix Makefiles"; }

# A project of the given functions; its messages go to log.
configure() {
  mkdir -p project
  cp -r "$BURNISH_SOURCE_DIR/samples/cmake/textures" project
  { printf '%s\n' 'cmake_minimum_required(VERSION 3.21)' 'project(p LANGUAGES NONE)' 'find_package(burnish REQUIRED)'; cat; } \
    >project/CMakeLists.txt
  cmake -G Ninja -S project -B configured -DCMAKE_PREFIX_PATH="$PREFIX" >log 2>&1
}

@test "what the functions refuse" {
  refuses_to_configure() {
    ! configure
    grep -qF "$1" <(tr -s ' \n' ' ' <log) || { cat log; false; }
  }
  refuses_to_configure "there is no tool 'normal'" <<<'burnish_command(normal OUTPUT a ARGUMENTS b)'
  refuses_to_configure "burnish_command: ARGUMENTS is required" <<<'burnish_command(normals OUTPUT a)'
  refuses_to_configure "OUTPUT is required" <<<'burnish_normal_map(textures/tiles.png)'
  refuses_to_configure "unexpected arguments: -d;half" <<<'burnish_normal_map(textures/tiles.png -d half OUTPUT a.exr)'
  refuses_to_configure "expected a map and OUTPUT, or maps and OUTPUT_DIRECTORY" <<<'burnish_quantize(a b OUTPUT c)'
  refuses_to_configure "fits" <<<'burnish_texture_directory(t DIRECTORY textures OUTPUT_DIRECTORY o PATTERNS *.jpg)'
  refuses_to_configure "OUTPUT_DIRECTORY is required" <<<'burnish_texture_directory(t DIRECTORY textures)'
}

@test "find_package: versions and components" {
  configure <<<'message(STATUS "${burnish_VERSION}")'
  grep -qE -- '-- [0-9]+\.[0-9]+\.[0-9]+$' log
  sed -i 's/find_package(burnish REQUIRED)/find_package(burnish 99 REQUIRED)/' project/CMakeLists.txt
  ! cmake -S project -B newer -DCMAKE_PREFIX_PATH="$PREFIX" >log 2>&1
  sed -i 's/burnish 99 REQUIRED/burnish REQUIRED COMPONENTS nothing/' project/CMakeLists.txt
  ! cmake -S project -B parts -DCMAKE_PREFIX_PATH="$PREFIX" >log 2>&1
}

@test "the library as a component" {
  mkdir project
  cat >project/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.21)
project(p LANGUAGES CXX)
find_package(burnish REQUIRED COMPONENTS library)
add_executable(p p.cpp)
target_link_libraries(p PRIVATE burnish::burnish)
END
  cat >project/p.cpp <<'END'
#include "burnish/core/mip.h"
int main() { return burnish::next_level_size(5) - 2; }
END
  cmake -S project -B made -DCMAKE_PREFIX_PATH="$PREFIX" >log 2>&1 || { cat log; false; }
  cmake --build made >log 2>&1 || { cat log; false; }
  made/p
}

@test "samples/make" {
  cp -r "$BURNISH_SOURCE_DIR/samples/cmake/textures" .
  build() { make -j 2 -f "$BURNISH_SOURCE_DIR/samples/make/Makefile" textures=textures out=out BURNISH="$BURNISH_BIN" >log 2>&1; }
  build
  for name in studs tiles waves; do [ -s out/$name.ktx2 ]; done
  mark out
  build
  [ -z "$(made_since_mark out)" ]
  touch textures/waves.png
  build
  [ "$(made_since_mark out)" = "waves.ktx2 waves_n.png waves_q.exr " ]
}
