// What OpenMesh passes over in silence in an OBJ file: numbers that are none, vertices that are not there, corners that
// lack what others have.
#pragma once

#include <cstddef>

#include "burnish/core/image_io.h"

namespace burnish {

struct ObjContents {
  std::size_t faces = 0;
  bool uvs = false, normals = false;  // at every corner
};

// kMalformed, with the line.
ObjContents check_obj(const FileRef& file);

}  // namespace burnish
