// A material: one lighting model with its parameters, and the id of the texels it serves.
#pragma once

#include <optional>
#include <variant>

#include "burnish/render/lambert.h"
#include "burnish/render/phong.h"

namespace burnish {

using LightingModel = std::variant<Lambert, Phong>;

struct Material {
  std::optional<int> id;  // as in the indexed map's intervals; none: serves every texel
  LightingModel model;
};

}  // namespace burnish
