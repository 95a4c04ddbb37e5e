// A polynomial texture map read in bands of rows, top row first, from wherever it lies: one in memory, or one too large
// for it in a temporary file. What writes, rounds or relights a map takes this.
#pragma once

#include "burnish/ptm/ptm.h"

namespace burnish {

class PtmRows {
 public:
  virtual ~PtmRows() = default;
  const PtmShape& shape() const { return shape_; }

  // Rows first … first + count − 1, as Ptm holds them. Callable from many threads.
  virtual void read(int first, int count, float* coefficients, float* colour) const = 0;
  // What it is decoded from, where that is bytes in memory: they need no rounding. Null elsewhere.
  virtual const PtmBytes* bytes() const { return nullptr; }

 protected:
  explicit PtmRows(const PtmShape& shape) : shape_(shape) {}

 private:
  PtmShape shape_;
};

class PtmInMemory : public PtmRows {
 public:
  explicit PtmInMemory(Ptm ptm);
  void read(int first, int count, float* coefficients, float* colour) const override;

 private:
  Ptm ptm_;
};

// Decoded as it is read.
class PtmInBytes : public PtmRows {
 public:
  explicit PtmInBytes(PtmBytes bytes);
  void read(int first, int count, float* coefficients, float* colour) const override;
  const PtmBytes* bytes() const override { return &bytes_; }

 private:
  PtmBytes bytes_;
};

}  // namespace burnish
