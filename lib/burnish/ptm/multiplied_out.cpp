#include "burnish/ptm/multiplied_out.h"

#include <vector>

namespace burnish {
namespace {

PtmShape as_rgb(PtmShape shape) {
  shape.type = PtmType::kRgb;
  return shape;
}

}  // namespace

MultipliedOut::MultipliedOut(const PtmRows& rows) : PtmRows(as_rgb(rows.shape())), rows_(rows) {}

void MultipliedOut::read(int first, int count, float* coefficients, float* colour) const {
  if (rows_.shape().type == PtmType::kRgb) return rows_.read(first, count, coefficients, colour);
  const std::size_t texels = std::size_t(count) * shape().width;
  std::vector<float> light(texels * kPtmTerms), rgb(texels * 3);
  rows_.read(first, count, light.data(), rgb.data());
  for (std::size_t i = 0; i < texels; i++)
    for (int c = 0; c < 3; c++)
      for (int k = 0; k < kPtmTerms; k++) *coefficients++ = light[i * kPtmTerms + k] * (rgb[i * 3 + c] / 255);
}

}  // namespace burnish
