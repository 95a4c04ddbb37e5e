// Light lists (.lp): which photograph was lit from where.
//
// First line the number of photographs, then a line each: file name, which may hold spaces, and x, y, z of a vector
// towards the light, x to the right, y to the photograph's top, z to the viewer. Names are relative to the list.
#pragma once

#include <string>
#include <vector>

#include "burnish/core/file_ref.h"
#include "burnish/core/vec3.h"

namespace burnish {

struct LitPhoto {
  std::string file;  // relative to the working directory
  Vec3d light;       // unit, z above 0
};

// kIo where it cannot be read; kMalformed, with the line, where the count is wrong, a line has no name or not three
// finite numbers, a vector is shorter than 1e-6, longer than numbers hold or does not come from above the surface, and
// where a name is repeated.
std::vector<LitPhoto> read_light_list(const FileRef& file);

}  // namespace burnish
