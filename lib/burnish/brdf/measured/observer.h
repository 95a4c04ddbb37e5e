// Spectra to linear sRGB, seen under daylight D65.
//
//   X = Σ f(λ) x̄(λ) D65(λ) Δλ, and Y, Z alike; then the matrix of IEC 61966-2-1
//
// scaled so that a surface that reflects all wavelengths alike is grey. x̄, ȳ, z̄: the CIE 1931 observer in the
// multi-lobe fit of Wyman, Sloan & Shirley, "Simple analytic approximations to the CIE XYZ color matching functions"
// (JCGT 2, 2013), equation 4, within 1 % of it. D65: CIE 15, in steps of 10 nm from 380 to 780, linear in between.
#pragma once

#include <vector>

#include "burnish/core/vec3.h"

namespace burnish {

inline constexpr double kLeastWavelength_nm = 380, kMostWavelength_nm = 780;

// x̄, ȳ, z̄.
Vec3d cie_1931_observer(double wavelength_nm);
double daylight_d65(double wavelength_nm);  // 100 at 560 nm

// Weights of each wavelength, which are ascending, at least two, and within the range above; each colour's sum to 1.
std::vector<Vec3d> srgb_weights(const std::vector<double>& wavelengths_nm);

}  // namespace burnish
