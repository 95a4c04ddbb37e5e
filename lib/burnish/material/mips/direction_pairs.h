// Lights and views that reflectance is compared at: a fixed set, well spread.
//
// Lights lie within 72.5° of (0,0,1), uniformly by solid angle; views within 46°, at 46° u² with u uniform: they crowd
// round the normal, since lobes that fit there fit further out too. The first points of Roberts' additive recurrence in
// four dimensions, which fills them evenly however many there are.
// Source: Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018).
#pragma once

#include <cstddef>
#include <vector>

namespace burnish {

// Sixteen pairs, a component an array: of light, view and h = (l+v)/‖l+v‖.
struct alignas(64) PairBlock {
  static constexpr int kPairs = 16;
  float l[3][kPairs], v[3][kPairs], h[3][kPairs];
};

std::vector<PairBlock> direction_pairs(std::size_t blocks);

}  // namespace burnish
