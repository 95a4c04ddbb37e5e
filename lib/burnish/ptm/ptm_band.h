// Rows of a map in floats, and what is made of all texels of it, band by band.
#pragma once

#include <algorithm>
#include <vector>

#include "burnish/core/parallel.h"
#include "burnish/core/progress.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct PtmBand : PtmShape {
  std::vector<float> coefficients, colour;  // as Ptm's

  PtmBand(const PtmRows& rows, int first, int count) : PtmShape(rows.shape()) {
    height = count;
    coefficients.resize(texels() * polynomials() * kPtmTerms);
    colour.resize(texels() * colours());
    rows.read(first, count, coefficients.data(), colour.data());
  }

  // The polynomial i of a texel.
  PtmCoefficients<double> polynomial(std::size_t texel, int i = 0) const {
    PtmCoefficients<double> a;
    std::copy_n(coefficients.begin() + (texel * polynomials() + i) * kPtmTerms, kPtmTerms, a.begin());
    return a;
  }
};

// Rows of a band that stays in the caches, at least one.
inline std::size_t band_rows(const PtmShape& shape) {
  constexpr int kTexels = 1 << 14;
  return std::size_t(std::max(1, kTexels / shape.width));
}

// of(band, texel) of all texels, side by side; `take` gets a band of them at a time, row by row from the top: how many
// rows there are, and a T a texel.
template <typename T, typename Of, typename Take>
void for_each_texel(const PtmRows& rows, const Of& of, const Take& take, const Progress& progress) {
  const PtmShape& shape = rows.shape();
  constexpr int kBandTexels = 1 << 20, kPartTexels = 1 << 15;
  const int at_once = std::clamp(kBandTexels / shape.width, 1, shape.height);
  const std::size_t part = std::max(1, kPartTexels / shape.width);
  std::vector<T> results;
  for (int first = 0; first < shape.height; first += at_once) {
    const int count = std::min(at_once, shape.height - first);
    results.resize(std::size_t(count) * shape.width);
    parallel_for_chunks(count, part, [&](std::size_t begin, std::size_t end, std::size_t) {
      const PtmBand band(rows, first + int(begin), int(end - begin));
      for (std::size_t i = 0; i < band.texels(); i++) results[begin * shape.width + i] = of(band, i);
    });
    take(count, results);
    report_progress(progress, double(first + count) / shape.height);
  }
}

}  // namespace burnish
