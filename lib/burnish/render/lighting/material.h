// A material: a sum of lighting models with their parameters, and the id of the texels it serves (Tarini et al.,
// section 6).
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "burnish/render/lighting/cartoon.h"
#include "burnish/render/lighting/chrome.h"
#include "burnish/render/lighting/environment.h"
#include "burnish/render/lighting/lambert.h"
#include "burnish/render/lighting/npr_double.h"
#include "burnish/render/lighting/phong.h"

namespace burnish {

using LightingModel = std::variant<Lambert, Phong, NprDouble, Cartoon, Chrome, Environment>;

struct Material {
  std::optional<int> id;  // as in the indexed map's intervals; none: serves every texel
  std::vector<LightingModel> terms{Lambert{}};

  Shaded shade(Vec3d n, const Illumination& in) const {
    Shaded sum;
    for (const LightingModel& term : terms)
      sum = sum + std::visit([&](const auto& model) { return model.shade(n, in); }, term);
    return sum;
  }
};

}  // namespace burnish
