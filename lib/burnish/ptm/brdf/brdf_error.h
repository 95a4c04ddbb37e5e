// How far a BRDF PTM is from the reflectance that it was made of.
//
// Over directions of light uniform on the hemisphere, and of view as the pixels of a sphere have them: uniform over the
// projected solid angle, so that grazing views, where f_r (n·l) of some models has no bound, count as they are
// seen. 65536 pairs of a fixed sequence (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018);
// light 1 is 1 here, not 255:
//
//   rms = √ mean over pairs and colours of (PTM − f_r (n·l))²,   relative = rms / √ mean (f_r (n·l))²
//
// The texture is looked up as shaders do, bilinearly and clamped, at its coordinates times the noise factor.
#pragma once

#include "burnish/brdf/brdf.h"
#include "burnish/ptm/brdf/brdf_coordinates.h"
#include "burnish/ptm/ptm.h"

namespace burnish {

struct BrdfPtmError {
  double rms = 0, relative = 0;  // relative: 0 where nothing is reflected
};

// In parallel, summed in a fixed order.
BrdfPtmError brdf_error(const Ptm& ptm, BrdfCoordinates coordinates, double noise_factor, const Brdf& brdf);

}  // namespace burnish
