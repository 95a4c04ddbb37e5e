#include "burnish/ptm/ptm_mips.h"

#include <cmath>
#include <utility>

#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "burnish/core/parallel.h"
#include "burnish/core/vec3.h"
#include "burnish/ptm/brightest_direction.h"
#include "burnish/ptm/coefficient_range.h"
#include "burnish/ptm/coefficient_rounding.h"
#include "burnish/ptm/multiplied_out.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {
namespace {

constexpr int kChannels = 3 * kPtmTerms;

Image as_image(Ptm&& map) {
  Image image;
  image.width = map.width, image.height = map.height, image.channels = kChannels;
  image.data = std::move(map.coefficients);
  return image;
}

Ptm as_map(Image&& image) { return {{PtmType::kRgb, image.width, image.height}, std::move(image.data), {}}; }

Image normals_of(const Ptm& map) {
  Image normals(map.width, map.height, 3);
  parallel_for_chunks(map.texels(), 1 << 12, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) {
      PtmCoefficients<double> sum{};
      for (int c = 0; c < kChannels; c++) sum[c % kPtmTerms] += map.coefficients[i * kChannels + c];
      const Vec3d n = brightest_direction(sum).direction;
      normals.data[i * 3] = float(n.x), normals.data[i * 3 + 1] = float(n.y), normals.data[i * 3 + 2] = float(n.z);
    }
  });
  return normals;
}

double rms_angle_deg(const Image& normals, const Image& means) {
  double sum = 0;
  for (std::size_t i = 0; i < normals.data.size(); i += 3) {
    const float *n = &normals.data[i], *m = &means.data[i];
    const Vec3d mean{m[0], m[1], m[2]};
    const double off_rad = length(mean) > 1e-6 ? angle_rad({n[0], n[1], n[2]}, mean) : 0;
    sum += off_rad * off_rad;
  }
  return degrees(std::sqrt(sum / double(normals.texels())));
}

}  // namespace

PtmMips build_ptm_mips(const PtmRows& base, int levels) {
  const PtmShape& shape = base.shape();
  levels = levels_to_make(shape.width, shape.height, levels);
  PtmMips mips;
  PtmBand all(MultipliedOut(base), 0, shape.height);
  mips.levels.push_back({{PtmType::kRgb, shape.width, shape.height}, std::move(all.coefficients), {}});
  mips.rms_deg.push_back(0);
  Image mean_normals = normals_of(mips.levels[0]);
  while (int(mips.levels.size()) < levels) {
    Image finer = as_image(std::move(mips.levels.back()));
    Image level = next_mean_level(finer);
    mips.levels.back() = as_map(std::move(finer));
    mips.levels.push_back(as_map(std::move(level)));
    mean_normals = next_mean_level(mean_normals);
    mips.rms_deg.push_back(rms_angle_deg(normals_of(mips.levels.back()), mean_normals));
  }
  return mips;
}

std::vector<PtmBytes> rounded(const PtmMips& mips, const PtmRows& base,
                              const std::array<PtmCoefficients<double>, kPtmTerms>& normal) {
  const PtmBytes* const bytes = base.shape().type == PtmType::kRgb ? base.bytes() : nullptr;
  ByteRange range;
  if (bytes) {
    range = {bytes->scale, bytes->bias};
  } else {
    const CoefficientRange all = coefficient_range(MultipliedOut(base));
    range = byte_range(all.least, all.most);
  }
  const CoefficientRounding rounding(range, normal);
  std::vector<PtmBytes> levels;
  for (const Ptm& level : mips.levels) {
    if (bytes && levels.empty()) {
      levels.push_back(*bytes);
      continue;
    }
    PtmBytes& to = levels.emplace_back(PtmBytes{level, range.scale, range.bias, {}, {}});
    to.coefficients.resize(level.coefficients.size());
    const std::size_t polynomials = level.texels() * 3;
    parallel_for_chunks(polynomials, 1 << 12, [&](std::size_t begin, std::size_t end, std::size_t) {
      rounding.round(level.coefficients.data() + begin * kPtmTerms, end - begin,
                     to.coefficients.data() + begin * kPtmTerms);
    });
  }
  return levels;
}

}  // namespace burnish
