#include "burnish/brdf/measured/half_difference_table.h"

#include <cmath>
#include <utility>

#include "burnish/brdf/measured/cell_pair.h"
#include "burnish/brdf/measured/half_difference.h"

namespace burnish {

HalfDifferenceTable::HalfDifferenceTable(const HalfDifferenceCells& cells, std::vector<Vec3f> values)
    : cells_(cells), values_(std::move(values)) {}

Vec3d HalfDifferenceTable::reflected_above(Vec3d l, Vec3d v) const {
  const HalfDifference at = half_difference(l, v);
  const CellPair h = cells_at(std::sqrt(at.theta_h / (kPi / 2)) * cells_.theta_h, cells_.theta_h),
                 d = cells_at(at.theta_d / (kPi / 2) * cells_.theta_d, cells_.theta_d),
                 phi = cells_around(at.phi_d / kPi * cells_.phi_d, cells_.phi_d);
  Vec3d sum;
  double weights = 0;
  for (int i = 0; i < 8; i++) {
    const int a = i & 1, b = i >> 1 & 1, c = i >> 2;
    const double weight = h.weight[a] * d.weight[b] * phi.weight[c];
    const Vec3f value = values_[(std::size_t(h.index[a]) * cells_.theta_d + d.index[b]) * cells_.phi_d + phi.index[c]];
    if (!(weight > 0) || std::isnan(value.x)) continue;
    sum += Vec3d(value) * weight;
    weights += weight;
  }
  return weights > 0 ? sum * (l.z / weights) : Vec3d{};
}

}  // namespace burnish
