// Photographs under known lights to a polynomial texture map: the coefficients of least squares, texel by texel
// (Malzbender, Gelb & Wolters 2001, section 4).
//
//   RGB    a = P p of each channel (light_matrix.h)
//   LRGB   the colour and the polynomial whose product differs least from the channels' polynomials over the lights,
//          the colour's largest channel being 255; white where a texel is black in all photographs
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/photos/capture.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct PtmFitOptions {
  PtmType type = PtmType::kLrgb;
  double ridge = 0;             // λ, of light_matrix()
  bool reject_shadows = false;  // robust_fit.h
  bool leave_one_out = false;
  // Bytes that fit and rounding may hold; coefficients that are more go to a temporary file.
  std::size_t memory = std::size_t(1) << 30;
  std::string directory{};  // for that (spill_file.h)
};

struct PtmFit {
  std::unique_ptr<PtmRows> rows;
  // RMS over photographs, texels and channels, of 255, of each photograph minus what the others make it, clipped to
  // 0 … 255; where asked for. Photographs that the others do not determine are left out.
  std::optional<double> leave_one_out_rmse;
};

// `lights`: of the photographs, in their order. kMalformed where one is to be left out and there is none that the others
// determine. In parallel; no result depends on it.
PtmFit fit_ptm(const Capture& photos, const LightMatrix& lights, const PtmFitOptions& options,
               const Progress& progress = {});

// RMS of 255 over photographs, texels and channels of what a map shows under their lights, clipped to 0 … 255 and not
// rounded. Decodes the photographs once more.
double rms_error(const PtmRows& rows, const Capture& photos, const LightMatrix& lights, const Progress& progress = {});

}  // namespace burnish
