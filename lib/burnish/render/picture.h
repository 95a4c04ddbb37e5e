// Linear values to pictures for eyes: sRGB, and differences as heat.
#pragma once

#include <string>

#include "burnish/core/image.h"
#include "burnish/core/vec3.h"

namespace burnish {

// The transfer function of IEC 61966-2-1, [0,1] to [0,1]: 12.92·c up to 0.0031308, 1.055·c^(1/2.4) − 0.055
// above. Values beyond [0,1] take the nearer end.
double srgb_from_linear(double linear);
// Its inverse, [0,1] to [0,1].
double linear_from_srgb(double srgb);

// A picture's samples in sRGB, in [0,1], after multiplication by 2^exposure; ready for an integer
// ImageWriter.
Image srgb_picture(const Image& linear, double exposure_stops);

// The heat map's colours, in sRGB: from black over purple and orange to pale yellow, lightness growing all
// the way. `x` in [0,1].
Vec3d heat_colour(double x);
// The same as a CSS gradient, left to right.
std::string heat_css_gradient();

// |a − b| of each pixel's worst channel, as heat; `full` (above 0) takes the last colour, and so does
// everything above it. Grey where `counts` is 0.
Image heat_picture(const Image& a, const Image& b, const ByteImage& counts, double full);

}  // namespace burnish
