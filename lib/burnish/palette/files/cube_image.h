// Images of the RGB(A) cube: what third-party quantizers are given, and the palette they make of it.
#pragma once

#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/palette/map_set.h"
#include "burnish/palette/material_cube.h"

namespace burnish {

// Writes a map's texels as 8-bit colours of the cube, PNG, RGB or RGBA; `materials` are the ids, ascending, that its
// materials are numbered by. Masked texels take the colours of the others in turn, so that a quantizer sees these in
// the shares they have. Errors as OpenMap's and ImageWriter's.
void write_cube_image(const FileRef& file, const MapFiles& map, const NormalCoding& coding, const MaterialCube& cube,
                      const std::vector<int>& materials);

// The distinct colours of an image whose texels a quantizer has made few: an indexed PNG (its entries that occur), or
// any other file of 8 bits. Ascending. kMalformed for other samples, fewer channels than the cube has, more than
// 65536 colours, and a palette of normals (has_own_palette).
std::vector<Colour> read_cube_colours(const FileRef& file, const MaterialCube& cube);

}  // namespace burnish
