#include "burnish/normal/normal_mips.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/core/band_rows.h"
#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "burnish/core/parallel.h"
#include "burnish/core/samples.h"

namespace burnish {
namespace {

Vec3f vector_at(const float* t) { return {t[0], t[1], t[2]}; }

Vec3f unit(Vec3f mean) { return length(mean) > 1e-6f ? normalized(mean) : Vec3f{0, 0, 1}; }

void require_alpha(const Parameter& alphas) {
  alphas.require([](float alpha) { return alpha >= 0 && std::isfinite(alpha); }, "alpha of at least 0");
}

// m and α² of each texel, which are averaged together.
Image with_squares(const std::vector<Vec3f>& normals, const Parameter& alphas, int width, int rows) {
  Image both(width, rows, 4);
  parallel_for(std::size_t(rows), [&](std::size_t y) {
    float* to = both.row(int(y));
    for (std::size_t i = y * width; i < (y + 1) * width; i++, to += 4) {
      to[0] = normals[i].x, to[1] = normals[i].y, to[2] = normals[i].z;
      to[3] = alphas.at(i) * alphas.at(i);
    }
  });
  return both;
}

// m and α of each texel, of m and Σ w α².
void take_apart(const float* both, Image& means, Image& alphas) {
  parallel_for(std::size_t(means.height), [&](std::size_t y) {
    const float* from = both + y * means.width * 4;
    for (int x = 0; x < means.width; x++, from += 4) {
      std::copy_n(from, 3, means.at(x, int(y)));
      const float kept = std::max(length(vector_at(from)), 1e-6f);
      *alphas.at(x, int(y)) = std::sqrt(from[3] + 2 * std::max(0.f, 1 - kept) / kept);
    }
  });
}

}  // namespace

NormalMips::NormalMips(const FileRef& file, const NormalCoding& coding, int levels)
    : reader_(file, coding),
      levels_(levels_to_make(reader_.width(), reader_.height(), levels)),
      space_(recorded_space(reader_.image())) {}

void NormalMips::add_roughness(const std::string& name, const ParameterSource& source) {
  SharedSize size{reader_.width(), reader_.height(), reader_.name()};
  roughness_.emplace(name, source, size);
  if (!roughness_->is_map()) require_alpha(roughness_->rows(0, 1));
}

int NormalMips::width(int level) const { return level_size(reader_.width(), level); }
int NormalMips::height(int level) const { return level_size(reader_.height(), level); }

void NormalMips::make(const std::function<void(const Rows&)>& take, const Progress& progress) {
  const int w = reader_.width(), h = reader_.height(), channels = roughness_ ? 4 : 3;
  Parameter alphas;  // of the base's rows at hand
  MeanCascade cascade(w, h, channels, levels_, [&](int level, int first, int count, const float* rows) {
    Rows out{level, first, Image(width(level), count, 3), {}};
    if (!roughness_) {
      std::copy_n(rows, out.means.data.size(), out.means.data.begin());
      return take(out);
    }
    out.alphas = Image(out.means.width, count);
    take_apart(rows, out.means, out.alphas);
    for (std::size_t i = 0; level == 0 && i < out.alphas.data.size(); i++) out.alphas.data[i] = alphas.at(i);
    take(out);
  });
  std::vector<Vec3f> normals;
  for (int y = 0; y < h; y += band_rows(w)) {
    const int count = std::min(band_rows(w), h - y);
    normals.resize(std::size_t(w) * count);
    reader_.read_rows(y, count, normals.data());
    if (roughness_) {
      alphas = roughness_->rows(y, count);
      require_alpha(alphas);
      cascade.add(count, with_squares(normals, alphas, w, count).data.data());
    } else {
      cascade.add(count, &normals.data()->x);
    }
    report_progress(progress, double(y + count) / h);
  }
}

NormalLevelEncoder::NormalLevelEncoder(const NormalCoding& coding, SampleType sample)
    : stored_(coding), sample_(sample) {
  stored_.encoding = is_biased(coding.encoding, is_integer(sample)) ? NormalEncoding::kBiased : NormalEncoding::kSigned;
}

Image NormalLevelEncoder::encode(const Image& means) {
  Image out(means.width, means.height, 3);
  std::vector<double> squares(means.height);
  parallel_for(std::size_t(means.height), [&](std::size_t y) {
    std::vector<Vec3f> row(means.width);
    float* const to = out.row(int(y));
    for (int x = 0; x < means.width; x++) row[x] = unit(vector_at(means.at(x, int(y))));
    encode_normals(row.data(), means.width, stored_, SampleType::kFloat, to);
    std::vector<float> kept(to, to + std::size_t(means.width) * 3);
    round_to_samples(sample_, kept);
    if (stored_.encoding == NormalEncoding::kBiased)
      for (float& v : kept) v = 2 * v - 1;
    for (int x = 0; x < means.width; x++) {
      Vec3f back = vector_at(&kept[std::size_t(x) * 3]);
      if (stored_.green == GreenAxis::kDown) back.y = -back.y;
      const double off_rad = angle_rad(Vec3d(row[x]), Vec3d(back));
      squares[y] += off_rad * off_rad;
    }
  });
  for (const double of_row : squares) squares_ += of_row;
  texels_ += means.texels();
  return out;
}

double NormalLevelEncoder::rms_deg() const { return degrees(std::sqrt(squares_ / double(texels_))); }

}  // namespace burnish
