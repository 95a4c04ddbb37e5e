// A polynomial texture map in memory, as a shader has it: stored values that are filtered before they are decoded.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "burnish/brdf/brdf.h"
#include "burnish/core/image.h"
#include "burnish/ptm/brdf/brdf_coordinates.h"
#include "burnish/ptm/ptm.h"
#include "burnish/render/ptm/scene_ptm.h"

namespace burnish {

// Coefficients, light 1 being white: (stored − bias) · scale, stored being in [0,1] where it is 8 bits.
struct PtmTexture {
  PtmType type = PtmType::kRgb;
  Image stored;  // RGB: six of red, of green, of blue; LRGB: six, then a colour that needs no decoding
  PtmCoefficients<double> scale{}, bias{};
};

struct PtmAssets {
  PtmTexture map;
  PtmTexture reference;              // of the twin of a spatial map
  std::shared_ptr<const Brdf> brdf;  // of the twin of a BRDF PTM
  BrdfCoordinates coordinates = BrdfCoordinates::kHalfDifference;
  double noise_factor = 1;
};

// Errors of the files' readers; kMalformed where a BRDF PTM's ptm.json does not say what it is addressed by.
PtmAssets load_ptm(const PtmSource& source);

}  // namespace burnish
