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

PtmInBytes::PtmInBytes(PtmBytes bytes) : PtmRows(bytes), bytes_(std::move(bytes)) {}

void PtmInBytes::read(int first, int count, float* coefficients, float* colour) const {
  const std::size_t row = std::size_t(bytes_.width) * bytes_.polynomials() * kPtmTerms;
  const std::uint8_t* raw = bytes_.coefficients.data() + row * first;
  for (std::size_t i = 0; i < row * count; i++)
    coefficients[i] = float((raw[i] - bytes_.bias[i % kPtmTerms]) * bytes_.scale[i % kPtmTerms]);
  const std::size_t colours = std::size_t(bytes_.width) * bytes_.colours();
  std::copy_n(bytes_.colour.begin() + colours * first, colours * count, colour);
}

}  // namespace burnish
