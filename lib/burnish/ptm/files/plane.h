// The bytes of a map as the planes of .ptm files: a₀ … a₅, then R, G, B or a₀ … a₅ of green and of blue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "burnish/ptm/ptm.h"

namespace burnish {

// Of every texel one byte; rows from the bottom.
struct Plane {
  std::uint8_t* first;
  std::size_t step;
  int width, height;

  std::uint8_t& at(int y, int x) const { return first[(std::size_t(height - 1 - y) * width + x) * step]; }
};

inline std::vector<Plane> planes_of(PtmBytes& ptm) {
  std::vector<Plane> planes;
  const int terms = ptm.polynomials() * kPtmTerms;
  for (int i = 0; i < terms; i++)
    planes.push_back({ptm.coefficients.data() + i, std::size_t(terms), ptm.width, ptm.height});
  for (int i = 0; i < ptm.colours(); i++) planes.push_back({ptm.colour.data() + i, 3, ptm.width, ptm.height});
  return planes;
}

}  // namespace burnish
