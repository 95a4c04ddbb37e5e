#include "burnish/ptm/ptm_normals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/normal/normal_space.h"
#include "burnish/ptm/brightest_direction.h"
#include "burnish/ptm/ptm_band.h"

namespace burnish {
namespace {

BrightestDirection brightest(const PtmBand& band, std::size_t texel) {
  PtmCoefficients<double> sum{};
  for (int i = 0; i < band.polynomials(); i++) {
    const PtmCoefficients<double> a = band.polynomial(texel, i);
    for (int k = 0; k < kPtmTerms; k++) sum[k] += a[k];
  }
  return brightest_direction(sum);
}

}  // namespace

PtmNormalStats write_ptm_normals(const PtmRows& rows, const NormalMapTarget& target, const Progress& progress) {
  require_encodable(target.coding, target.sample, target.file.name);
  const PtmShape& shape = rows.shape();
  ImageWriter writer(target.file, target.type, target.sample, shape.width, shape.height, 3,
                     space_attributes(NormalSpace::kTangent));
  PtmNormalStats stats;
  std::vector<Vec3f> normals(shape.width);
  std::vector<float> samples(std::size_t(shape.width) * 3);  // room for samples of any type
  const auto write_row = [&](const BrightestDirection* row) {
    for (int x = 0; x < shape.width; x++) {
      normals[x] = Vec3f(row[x].direction);
      stats.flat_texels += row[x].flat;
      stats.horizon_texels += row[x].on_horizon;
      stats.mean_tilt_deg += angle_rad(row[x].direction, {0, 0, 1});
    }
    encode_normals(normals.data(), shape.width, target.coding, target.sample, samples.data());
    if (is_integer(target.sample)) writer.write_rows_stored(1, samples.data());
    else writer.write_rows(1, samples.data());
  };
  for_each_texel<BrightestDirection>(
      rows, brightest,
      [&](int count, const std::vector<BrightestDirection>& texels) {
        for (int y = 0; y < count; y++) write_row(texels.data() + std::size_t(y) * shape.width);
      },
      progress);
  writer.close();
  stats.mean_tilt_deg = degrees(stats.mean_tilt_deg / double(shape.texels()));
  return stats;
}

}  // namespace burnish
