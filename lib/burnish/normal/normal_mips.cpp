#include "burnish/normal/normal_mips.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "burnish/core/parallel.h"
#include "burnish/core/samples.h"

namespace burnish {
namespace {

Vec3f vector_at(const float* t) { return {t[0], t[1], t[2]}; }

Vec3f unit(Vec3f mean) { return length(mean) > 1e-6f ? normalized(mean) : Vec3f{0, 0, 1}; }

}  // namespace

NormalMips build_normal_mips(const FileRef& file, const NormalCoding& coding, int levels) {
  NormalReader reader(file, coding);
  const int width = reader.width(), height = reader.height();
  levels = levels_to_make(width, height, levels);
  NormalMips mips;
  Image& base = mips.means.emplace_back(width, height, 3);
  constexpr int kRows = 64;
  std::vector<Vec3f> band(std::size_t(width) * std::min(height, kRows));
  for (int y = 0; y < height; y += kRows) {
    const int rows = std::min(kRows, height - y);
    reader.read_rows(y, rows, band.data());
    float* to = base.row(y);
    for (std::size_t i = 0; i < std::size_t(width) * rows; i++, to += 3)
      to[0] = band[i].x, to[1] = band[i].y, to[2] = band[i].z;
  }
  mips.space = recorded_space(reader.image());
  mips.invalid_texels = reader.invalid_texels();
  while (int(mips.means.size()) < levels) mips.means.push_back(next_mean_level(mips.means.back()));
  return mips;
}

EncodedNormals encoded_level(const NormalMips& mips, int l, const NormalCoding& coding, SampleType sample) {
  const Image& means = mips.means[l];
  NormalCoding stored = coding;
  stored.encoding = is_biased(coding.encoding, is_integer(sample)) ? NormalEncoding::kBiased : NormalEncoding::kSigned;
  EncodedNormals out{Image(means.width, means.height, 3), 0};
  const double squares = parallel_sum<double>(std::size_t(means.height), 16, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    std::vector<Vec3f> row(means.width);
    for (int y = int(begin); y < int(end); y++) {
      for (int x = 0; x < means.width; x++) row[x] = unit(vector_at(means.at(x, y)));
      encode_normals(row.data(), means.width, stored, SampleType::kFloat, out.image.row(y));
      std::vector<float> kept(out.image.row(y), out.image.row(y) + std::size_t(means.width) * 3);
      round_to_samples(sample, kept);
      if (stored.encoding == NormalEncoding::kBiased)
        for (float& v : kept) v = 2 * v - 1;
      for (int x = 0; x < means.width; x++) {
        Vec3f back = vector_at(&kept[std::size_t(x) * 3]);
        if (coding.green == GreenAxis::kDown) back.y = -back.y;
        const double off_rad = angle_rad(Vec3d(row[x]), Vec3d(back));
        sum += off_rad * off_rad;
      }
    }
    return sum;
  });
  out.rms_deg = degrees(std::sqrt(squares / double(means.texels())));
  return out;
}

std::vector<Image> roughness_levels(const NormalMips& mips, Image base) {
  std::vector<Image> alphas{base};
  Image squares = std::move(base);
  for (float& alpha : squares.data) alpha *= alpha;
  for (std::size_t l = 1; l < mips.means.size(); l++) {
    squares = next_mean_level(squares);
    Image& alpha = alphas.emplace_back(squares);
    for (std::size_t i = 0; i < alpha.data.size(); i++) {
      const float kept = std::max(length(vector_at(&mips.means[l].data[3 * i])), 1e-6f);
      alpha.data[i] = std::sqrt(squares.data[i] + 2 * std::max(0.f, 1 - kept) / kept);
    }
  }
  return alphas;
}

Image read_roughness(const FileRef& file, const NormalMips& mips) {
  ImageReader reader(file);
  reader.require_size(mips.width(0), mips.height(0), "the normal map");
  const Image all = read_image(file);
  Image alpha(all.width, all.height);
  for (std::size_t i = 0; i < alpha.data.size(); i++) {
    const float value = alpha.data[i] = all.data[i * all.channels];
    if (!(value >= 0 && std::isfinite(value)))
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected roughness of at least 0, got " + std::to_string(value) + " at column " +
                           std::to_string(i % all.width) + ", row " + std::to_string(i / all.width));
  }
  return alpha;
}

}  // namespace burnish
