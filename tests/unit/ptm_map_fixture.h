// Maps that are made up, and the polynomials that they are made of.
#pragma once

#include <cmath>

#include "burnish/ptm/ptm.h"
#include "ptm_capture_fixture.h"

namespace burnish::testing {

// Smooth, under every light between 0 and 255.
inline Ptm made_up_map(PtmType type, int width, int height) {
  Ptm map{{type, width, height}, {}, {}};
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      for (int i = 0; i < map.polynomials(); i++)
        for (const double a : made_up_polynomial(x / 4, y / 4, i)) map.coefficients.push_back(float(a));
      for (int c = 0; c < map.colours(); c++) map.colour.push_back(float(180 + 75 * std::sin(0.05 * x + 0.07 * y + c)));
    }
  return map;
}

// Bytes that differ all over.
inline PtmBytes made_up_bytes(PtmType type, int width, int height) {
  PtmBytes map{{type, width, height}, {0.25, 0.3, 0.2, 0.5, 0.4, 0.6}, {260, 255, 127, 120, 130, -70}, {}, {}};
  for (std::size_t i = 0; i < map.texels() * map.polynomials() * kPtmTerms; i++)
    map.coefficients.push_back(std::uint8_t(i * 37 + i / 11));
  for (std::size_t i = 0; i < map.texels() * map.colours(); i++) map.colour.push_back(std::uint8_t(i * 53 + 7));
  return map;
}

}  // namespace burnish::testing
