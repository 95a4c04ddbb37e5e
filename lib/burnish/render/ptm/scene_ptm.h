// What an object shows by a polynomial texture map: its [object.ptm] in a scene; the keys stand in samples/README.md.
//
// Light that reaches a point, per light of colour c, from the direction l of its tangent frame:
//
//   c · F(n·l) · max(0, PTM)     PTM(l) at the texture coordinates, or PTM(l, v) of the material all over
//
// with the light factor F (light_factor.h) of the scene's table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/core/toml_file.h"

namespace burnish {

struct PtmSource {
  std::string map;        // .ptm, .exr or the PREFIX/ of textures
  std::string reference;  // spatial: the coefficients that the twin evaluates; empty: the map's own
  std::string brdf;  // of a BRDF PTM: the model or the file of measurements that the twin evaluates; empty: spatial
  std::optional<double> ceiling;  // of that reflectance, as the map was made with; none: it is evaluated as it is
  bool srgb = true;               // spatial: whether values are those of photographs in sRGB, rather than linear

  bool is_brdf() const { return !brdf.empty(); }
  // All that it names.
  std::vector<std::string> files() const;
};

PtmSource parse_ptm(const TomlTable& table, const std::string& directory);

}  // namespace burnish
