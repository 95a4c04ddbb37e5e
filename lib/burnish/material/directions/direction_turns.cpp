#include "burnish/material/directions/direction_turns.h"

#include <utility>

#include "burnish/core/parallel.h"

namespace burnish {

DirectionMap turned(const DirectionMap& map, const DirectionTurns& turns) {
  const int quarters = (turns.quarters % 4 + 4) % 4;
  const bool on_its_side = quarters % 2 == 1;
  DirectionMap out = map;
  if (on_its_side) std::swap(out.width, out.height);
  parallel_for(out.height, [&](std::size_t row) {
    for (int column = 0; column < out.width; column++) {
      // Where the texel was, one turn after the other undone; size and axes turn back with it.
      int x = column, y = int(row), w = out.width, h = out.height;
      for (int q = 0; q < quarters; q++) {
        std::swap(w, h);
        y = std::exchange(x, w - 1 - y);
      }
      if (turns.flip_v) y = h - 1 - y;
      if (turns.flip_u) x = w - 1 - x;
      const std::size_t to = row * out.width + column, from = std::size_t(y) * map.width + x;
      Vec3f v = map.vectors[from];
      if (turns.flip_u) v.x = -v.x;
      if (turns.flip_v) v.y = -v.y;
      for (int q = 0; q < quarters; q++) v = {-v.y, v.x, v.z};
      out.vectors[to] = v;
      if (!map.strengths.empty()) out.strengths[to] = map.strengths[from];
    }
  });
  return out;
}

}  // namespace burnish
