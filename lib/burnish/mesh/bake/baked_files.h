// Files of maps that were baked over a mesh's charts.
#pragma once

#include <vector>

#include "burnish/core/image.h"
#include "burnish/normal/height_map.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

// Unit vectors, row by row from the top, and the space that they are in. kUnsupported as ImageWriter and
// require_encodable.
void write_baked_normals(const NormalMapTarget& target, NormalSpace space, int width, int height,
                         const std::vector<Vec3f>& normals);

// One channel of signed distances, none beyond ±most. EXR holds them as they are, in float; PNG and TIFF hold uint16
// about ½: true value = stored · scale + bias with scale = 2·most and bias = −most (1 and −½ where most is 0). The
// image description says so, as JSON with burnish:scale and burnish:bias. kUnsupported for types that hold no 16 bits.
void write_displacement(const FileRef& file, FileType type, const Image& displacement, double most);

// One channel: 1 where `flags` is not 0.
void write_mask(const FileRef& file, FileType type, const ByteImage& flags);

}  // namespace burnish
