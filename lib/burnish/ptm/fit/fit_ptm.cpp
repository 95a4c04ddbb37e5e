#include "burnish/ptm/fit/fit_ptm.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/ptm/fit/coefficient_store.h"
#include "burnish/ptm/fit/fit_kernels.h"
#include "burnish/ptm/fit/robust_fit.h"

namespace burnish {
namespace {

using kernels::BlockSamples;
using kernels::kSamples;
using kernels::kTexels;
using kernels::SampleTerms;
using kernels::TexelTerms;

struct ErrorSum {
  double squares = 0, samples = 0;
  ErrorSum& operator+=(const ErrorSum& o) {
    squares += o.squares, samples += o.samples;
    return *this;
  }
  double rms() const { return samples > 0 ? std::sqrt(squares / samples) : 0; }
};

// Rows of a map as PtmRows gives them, with room for whole blocks.
struct Rows {
  std::vector<float> coefficients, colour;
  void resize(const PtmShape& shape, int rows) {
    const std::size_t texels = (std::size_t(shape.width) * rows + kTexels - 1) / kTexels * kTexels;
    coefficients.resize(texels * shape.polynomials() * kPtmTerms);
    colour.resize(texels * shape.colours());
  }
};

void store(const SampleTerms& terms, std::size_t first, Rows& to) {
  float* a = to.coefficients.data() + first * 3 * kPtmTerms;
  for (int s = 0; s < kSamples; s++)
    for (int k = 0; k < kPtmTerms; k++) *a++ = terms.a[k][s];
}
void store(const TexelTerms& terms, std::size_t first, Rows& to) {
  float *a = to.coefficients.data() + first * kPtmTerms, *colour = to.colour.data() + first * 3;
  for (int t = 0; t < kTexels; t++) {
    for (int k = 0; k < kPtmTerms; k++) *a++ = terms.a[k][t];
    for (int c = 0; c < 3; c++) *colour++ = terms.colour[c][t];
  }
}
void load(const Rows& from, std::size_t first, SampleTerms& terms) {
  const float* a = from.coefficients.data() + first * 3 * kPtmTerms;
  for (int s = 0; s < kSamples; s++)
    for (int k = 0; k < kPtmTerms; k++) terms.a[k][s] = *a++;
}
void load(const Rows& from, std::size_t first, TexelTerms& terms) {
  const float *a = from.coefficients.data() + first * kPtmTerms, *colour = from.colour.data() + first * 3;
  for (int t = 0; t < kTexels; t++) {
    for (int k = 0; k < kPtmTerms; k++) terms.a[k][t] = *a++;
    for (int c = 0; c < 3; c++) terms.colour[c][t] = *colour++;
  }
}

// Calls body(samples, first texel, texels) for each block of a band, in parallel, and adds up what they return.
template <typename Body>
ErrorSum for_each_block(const PhotoBand& band, int width, const Body& body) {
  const std::size_t texels = std::size_t(width) * band.rows;
  return parallel_sum<ErrorSum>(texels, kTexels, [&](std::size_t begin, std::size_t end) {
    const int count = int(end - begin);
    if (!band.bytes.empty())
      return body(BlockSamples<std::uint8_t>{band.bytes.data() + begin * 3, band.stride}, begin, count);
    return body(BlockSamples<float>{band.floats.data() + begin * 3, band.stride}, begin, count);
  });
}

// Of the memory, what bands of photographs and the rounded map leave.
std::size_t room_for_coefficients(const PtmShape& shape, std::size_t memory) {
  constexpr std::size_t kBands = 64 << 20;
  const std::size_t rest = kBands + shape.texels() * (shape.polynomials() * kPtmTerms + shape.colours());
  return memory > rest ? memory - rest : 0;
}

class Fitter {
 public:
  Fitter(const LightMatrix& lights, const PtmFitOptions& options)
      : lights_(lights), options_(options), root_(upper_factor(lights.normal)), robust_(lights, options.ridge) {
    // h = b P of the plain fit
    for (std::size_t i = 0; i < lights.terms.size() && options.leave_one_out; i++) {
      double h = 0;
      for (int k = 0; k < kPtmTerms; k++) h += lights.terms[i][k] * lights.pseudo_inverse[i][k];
      leverage_.insert(leverage_.end(), kTexels, kernels::leverage_factor(h));
    }
    if (options.leave_one_out && std::ranges::count(leverage_, kernels::kAlone) == std::ptrdiff_t(leverage_.size()))
      throw Error(ErrorKind::kMalformed, "leave-one-out: expected a photograph that the others determine, got " +
                                             std::to_string(lights.terms.size()) + " that all are needed");
  }

  // Fits a block into `to`; the errors of leaving one out, where asked for.
  template <typename T>
  ErrorSum fit(BlockSamples<T> p, std::size_t first, int texels, Rows& to) const {
    SampleTerms terms;
    std::vector<float> own;
    if (options_.reject_shadows) {
      if (options_.leave_one_out) own.resize(leverage_.size());
      robust_.fit(p, terms, own.empty() ? nullptr : own.data());
    } else {
      kernels::project(p, lights_.pseudo_inverse, terms);
    }
    TexelTerms lrgb;
    const bool with_colour = options_.type == PtmType::kLrgb;
    if (with_colour) {
      kernels::rank_one(terms, root_, lrgb);
      store(lrgb, first, to);
    } else {
      store(terms, first, to);
    }
    if (!options_.leave_one_out) return {};
    if (with_colour) kernels::multiply_out(lrgb, terms);
    const std::vector<float>& leverage = own.empty() ? leverage_ : own;
    return {kernels::squared_error(p, lights_.terms, terms, texels, {leverage.data(), with_colour ? &lrgb : nullptr}),
            counted_samples(leverage, texels)};
  }

 private:
  static double counted_samples(const std::vector<float>& leverage, int texels) {
    double count = 0;
    for (std::size_t i = 0; i < leverage.size(); i++)
      count += int(i % kTexels) < texels && leverage[i] != kernels::kAlone;
    return 3 * count;
  }

  const LightMatrix& lights_;
  const PtmFitOptions& options_;
  std::array<PtmCoefficients<double>, kPtmTerms> root_;
  RobustFit robust_;
  std::vector<float> leverage_;  // of the plain fit, as kernels::squared_error() takes it
};

}  // namespace

PtmFit fit_ptm(const Capture& photos, const LightMatrix& lights, const PtmFitOptions& options,
               const Progress& progress) {
  const PtmShape shape{options.type, photos.width(), photos.height()};
  auto rows =
      std::make_unique<CoefficientStore>(shape, room_for_coefficients(shape, options.memory), options.directory);
  const Fitter fitter(lights, options);
  ErrorSum left_out;
  Rows fitted;
  photos.for_each_band(
      [&](const PhotoBand& band) {
        fitted.resize(shape, band.rows);
        left_out += for_each_block(band, shape.width, [&](auto p, std::size_t first, int texels) {
          return fitter.fit(p, first, texels, fitted);
        });
        rows->write(band.first, band.rows, fitted.coefficients.data(), fitted.colour.data());
      },
      progress);
  PtmFit fit{std::move(rows), {}};
  if (options.leave_one_out) fit.leave_one_out_rmse = left_out.rms();
  return fit;
}

double rms_error(const PtmRows& rows, const Capture& photos, const LightMatrix& lights, const Progress& progress) {
  const PtmShape& shape = rows.shape();
  ErrorSum all;
  Rows of;
  photos.for_each_band(
      [&](const PhotoBand& band) {
        of.resize(shape, band.rows);
        rows.read(band.first, band.rows, of.coefficients.data(), of.colour.data());
        all += for_each_block(band, shape.width, [&](auto p, std::size_t first, int texels) {
          SampleTerms terms;
          if (shape.type == PtmType::kLrgb) {
            TexelTerms lrgb;
            load(of, first, lrgb);
            kernels::multiply_out(lrgb, terms);
          } else {
            load(of, first, terms);
          }
          const double samples = 3.0 * texels * photos.count();
          return ErrorSum{kernels::squared_error(p, lights.terms, terms, texels), samples};
        });
      },
      progress);
  return all.rms();
}

}  // namespace burnish
