// A reflectance whose f_r (n·l) is held at a ceiling: what lies above, as mirror-like glints of measured lacquer do, is
// taken for that.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "burnish/brdf/brdf.h"

namespace burnish {

class LimitedBrdf final : public Brdf {
 public:
  LimitedBrdf(std::shared_ptr<const Brdf> brdf, double ceiling) : brdf_(std::move(brdf)), ceiling_(ceiling) {}

 private:
  Vec3d reflected_above(Vec3d l, Vec3d v) const override {
    const Vec3d f = brdf_->reflected(l, v);
    return {std::min(f.x, ceiling_), std::min(f.y, ceiling_), std::min(f.z, ceiling_)};
  }

  std::shared_ptr<const Brdf> brdf_;
  double ceiling_;
};

}  // namespace burnish
