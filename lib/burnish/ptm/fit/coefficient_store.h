// Coefficients as a fit finds them: in memory, or in a temporary file where they are more than it may hold.
#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "burnish/core/spill_file.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

class CoefficientStore : public PtmRows {
 public:
  // More than `memory` bytes go to a file (spill_file.h).
  CoefficientStore(const PtmShape& shape, std::size_t memory, const std::string& directory);

  // Rows as read() gives them, each once, in any order.
  void write(int first, int count, const float* coefficients, const float* colour);
  void read(int first, int count, float* coefficients, float* colour) const override;

 private:
  struct Freed {
    void operator()(float* memory) const { std::free(memory); }
  };
  using Values = std::unique_ptr<float[], Freed>;
  static Values in_large_pages(std::size_t count);

  std::size_t row_values() const;  // of a row: coefficients, then colours
  Values values_;                  // not cleared: each is written before it is read
  std::optional<SpillFile> spilled_;
};

}  // namespace burnish
