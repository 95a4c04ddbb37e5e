// Two neighbours of a row of cells that a place lies between the middles of.
#pragma once

#include <algorithm>
#include <cmath>

namespace burnish {

struct CellPair {
  int index[2];
  double weight[2];
};

// `place` in cells: the middle of cell i is at i + ½. Ends are held.
inline CellPair cells_at(double place, int count) {
  const double x = std::clamp(place - 0.5, 0.0, count - 1.0);
  const int first = std::min(int(x), std::max(0, count - 2)), second = std::min(first + 1, count - 1);
  return {{first, second}, {1 - (x - first), x - first}};
}

// The same where the last cell is followed by the first.
inline CellPair cells_around(double place, int count) {
  const double x = place - 0.5, first = std::floor(x);
  const int i = (int(first) % count + count) % count;
  return {{i, (i + 1) % count}, {1 - (x - first), x - first}};
}

}  // namespace burnish
