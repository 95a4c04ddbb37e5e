// The fit of a texel without the photographs that it does not explain: shadows and highlights.
//
// Iteratively reweighted least squares on the mean of red, green and blue: first the least absolute errors, from the
// plain fit on, then Tukey's biweight, w = (1 − (r / c s)²)², r the residual and s 1.4826 times the median |r|, at
// least half a level. c is smaller for what is too dark than for what is too bright: shadows are many and have
// soft edges, and highlights are what a surface may show. The weights then fit red, green and blue. Every photograph
// keeps a weight of 1/1000, so that where all lights of a side are in shadow nothing is extrapolated to there from
// afar. A texel that fewer than six photographs are left of (w > ½) is fitted to all.
// Source: Holland & Welsch, "Robust regression using iteratively reweighted least-squares" (1977).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "burnish/ptm/fit/fit_kernels.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {

class RobustFit {
 public:
  RobustFit(const LightMatrix& lights, double ridge);

  // Of a block. `leverage`: [photograph][kTexels] as squared_error() takes it, with the weights held; may be null.
  template <typename T>
  void fit(kernels::BlockSamples<T> p, kernels::SampleTerms& out, float* leverage) const;

 private:
  using Matrix = Eigen::Matrix<double, kPtmTerms, kPtmTerms>;
  using Terms = Eigen::Matrix<double, kPtmTerms, Eigen::Dynamic>;
  // Of a texel: its values, their residuals and weights, a light each.
  struct Texel {
    Eigen::VectorXd grey, residual, weight, weighted;
    std::vector<double> magnitude;
  };
  Matrix normal(const Eigen::VectorXd& weights) const;
  void refit(Texel& t) const;
  void find_weights(Texel& t) const;

  Terms terms_, pseudo_inverse_;  // a column a light
  Eigen::Matrix<double, kPtmTerms * kPtmTerms, Eigen::Dynamic>
      products_;  // of terms, of which the weighted sum makes BᵀWB
  double ridge_;
};

}  // namespace burnish
