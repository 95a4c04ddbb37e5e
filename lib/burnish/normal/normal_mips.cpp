#include "burnish/normal/normal_mips.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "burnish/core/parallel.h"
#include "burnish/core/samples.h"
#include "burnish/core/whole_image.h"

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
  std::vector<Vec3f> band;
  Image& base = mips.means.emplace_back();
  base.width = width, base.height = height, base.channels = 3;
  base.data = read_whole<float>(file.name, height, std::size_t(width) * 3, [&](int first, int count, float* to) {
    band.resize(std::size_t(width) * std::size_t(count));
    reader.read_rows(first, count, band.data());
    for (const Vec3f& n : band) *to++ = n.x, *to++ = n.y, *to++ = n.z;
  });
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

Image read_roughness(const std::string& name, const ParameterSource& source, const NormalMips& mips,
                     const std::string& normals) {
  SharedSize size{mips.width(0), mips.height(0), normals};
  const Parameter given = read_parameter(name, source, size);
  given.require([](float alpha) { return alpha >= 0 && std::isfinite(alpha); }, "alpha of at least 0");
  Image alpha(size.width, size.height);
  for (std::size_t i = 0; i < alpha.data.size(); i++) alpha.data[i] = given.at(i);
  return alpha;
}

}  // namespace burnish
