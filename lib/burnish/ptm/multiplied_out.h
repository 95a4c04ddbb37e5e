// An LRGB map as an RGB one: a polynomial a colour, colour_c · a / 255. What is RGB already stays as it is.
#pragma once

#include "burnish/ptm/ptm_rows.h"

namespace burnish {

class MultipliedOut : public PtmRows {
 public:
  // `rows` must outlive it.
  explicit MultipliedOut(const PtmRows& rows);
  void read(int first, int count, float* coefficients, float* colour) const override;

 private:
  const PtmRows& rows_;
};

}  // namespace burnish
