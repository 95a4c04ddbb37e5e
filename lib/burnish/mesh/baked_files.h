// Files of maps that were baked over a mesh's charts.
#pragma once

#include <vector>

#include "burnish/core/image.h"
#include "burnish/normal/height_map.h"

namespace burnish {

// Unit vectors, row by row from the top. kUnsupported as ImageWriter and require_encodable.
void write_baked_normals(const NormalMapTarget& target, int width, int height, const std::vector<Vec3f>& normals);

// One channel of signed distances. EXR holds them as they are, in float. PNG and TIFF hold uint16 about ½: true value =
// stored · scale + bias with scale = 2m and bias = −m, m the largest magnitude; the image description says so, as JSON
// with burnish:scale and burnish:bias. kUnsupported for other types, which keep no 16 bits.
void write_displacement(const FileRef& file, FileType type, const Image& displacement);

// One channel: 1 where `flags` is not 0.
void write_mask(const FileRef& file, FileType type, const ByteImage& flags);

}  // namespace burnish
