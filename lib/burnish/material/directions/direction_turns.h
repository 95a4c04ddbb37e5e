// Turns of a direction map: the image and its vectors together, texel for texel.
#pragma once

#include "burnish/material/directions/direction_map.h"

namespace burnish {

struct DirectionTurns {
  bool flip_u = false, flip_v = false;  // left and right, top and bottom change places; done first
  int quarters = 0;                     // then that many times 90° counter-clockwise; any number
};

DirectionMap turned(const DirectionMap& map, const DirectionTurns& turns);

}  // namespace burnish
