#include "burnish/ptm/ptm_rows.h"

#include <algorithm>
#include <utility>

namespace burnish {

PtmInMemory::PtmInMemory(Ptm ptm) : PtmRows(ptm), ptm_(std::move(ptm)) {}

void PtmInMemory::read(int first, int count, float* coefficients, float* colour) const {
  const auto copy = [&](const std::vector<float>& from, int values, float* to) {
    const std::size_t row = std::size_t(ptm_.width) * values;
    std::copy_n(from.begin() + row * first, row * count, to);
  };
  copy(ptm_.coefficients, ptm_.polynomials() * kPtmTerms, coefficients);
  copy(ptm_.colour, ptm_.colours(), colour);
}

}  // namespace burnish
