// A colour and its texels: what the engines that work in the RGB(A) cube are given.
#pragma once

#include "burnish/palette/material_cube.h"

namespace burnish {

struct WeightedColour {
  Colour colour;
  float weight;  // > 0
};

}  // namespace burnish
