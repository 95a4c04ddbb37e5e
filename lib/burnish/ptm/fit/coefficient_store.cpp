#include "burnish/ptm/fit/coefficient_store.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace burnish {

// Memory that is taken as rows arrive, in pages of 2 MiB where the system has them.
CoefficientStore::Values CoefficientStore::in_large_pages(std::size_t count) {
  constexpr std::size_t kPage = 2 << 20;
  const std::size_t bytes = (count * sizeof(float) + kPage - 1) / kPage * kPage;
  auto* memory = static_cast<float*>(std::aligned_alloc(kPage, bytes));
  if (!memory) throw std::bad_alloc();
  ::madvise(memory, bytes, MADV_HUGEPAGE);  // may be refused
  return Values(memory);
}

CoefficientStore::CoefficientStore(const PtmShape& shape, std::size_t memory, const std::string& directory)
    : PtmRows(shape) {
  const std::size_t values = row_values() * std::size_t(shape.height);
  if (values * sizeof(float) > memory) spilled_.emplace(directory);
  else values_ = in_large_pages(values);
}

std::size_t CoefficientStore::row_values() const {
  return std::size_t(shape().width) * (shape().polynomials() * kPtmTerms + shape().colours());
}

void CoefficientStore::write(int first, int count, const float* coefficients, const float* colour) {
  const std::size_t colours = std::size_t(shape().width) * shape().colours(), six = row_values() - colours;
  for (std::size_t row = std::size_t(first); row < std::size_t(first + count); row++) {
    const std::size_t at = row_values() * row;
    if (spilled_) {
      spilled_->write(at * sizeof(float), coefficients, six * sizeof(float));
      if (colours) spilled_->write((at + six) * sizeof(float), colour, colours * sizeof(float));
    } else {
      std::copy_n(coefficients, six, values_.get() + at);
      std::copy_n(colour, colours, values_.get() + at + six);
    }
    coefficients += six, colour += colours;
  }
}

void CoefficientStore::read(int first, int count, float* coefficients, float* colour) const {
  const std::size_t colours = std::size_t(shape().width) * shape().colours(), six = row_values() - colours;
  for (std::size_t row = std::size_t(first); row < std::size_t(first + count); row++) {
    const std::size_t at = row_values() * row;
    if (spilled_) {
      spilled_->read(at * sizeof(float), coefficients, six * sizeof(float));
      if (colours) spilled_->read((at + six) * sizeof(float), colour, colours * sizeof(float));
    } else {
      std::copy_n(values_.get() + at, six, coefficients);
      std::copy_n(values_.get() + at + six, colours, colour);
    }
    coefficients += six, colour += colours;
  }
}

}  // namespace burnish
