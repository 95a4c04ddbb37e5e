#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "burnish/brdf/measured/cell_pair.h"
#include "burnish/brdf/measured/readers.h"
#include "burnish/core/error.h"
#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

class MbsdfTable final : public Brdf {
 public:
  MbsdfTable(int thetas, int phis, std::vector<Vec3f> values)
      : thetas_(thetas), phis_(phis), values_(std::move(values)) {}

 private:
  // By [θ_in][θ_out][φ]; beyond the middles of the outermost cells those hold.
  Vec3d reflected_above(Vec3d l, Vec3d v) const override {
    const auto theta = [&](Vec3d w) {
      return cells_at(portable::atan2(portable::hypot(w.x, w.y), w.z) / (kPi / 2) * thetas_, thetas_);
    };
    // The angle between the two about the normal, 0 … π.
    const double across = std::abs(l.x * v.y - l.y * v.x), along = l.x * v.x + l.y * v.y;
    const CellPair in = theta(l), out = theta(v), phi = cells_at(portable::atan2(across, along) / kPi * phis_, phis_);
    Vec3d sum;
    for (int i = 0; i < 8; i++) {
      const int a = i & 1, b = i >> 1 & 1, c = i >> 2;
      sum += Vec3d(values_[(std::size_t(in.index[a]) * thetas_ + out.index[b]) * phis_ + phi.index[c]]) *
             (in.weight[a] * out.weight[b] * phi.weight[c]);
    }
    return sum * l.z;
  }

  int thetas_, phis_;
  std::vector<Vec3f> values_;
};

}  // namespace

std::shared_ptr<const Brdf> parse_mbsdf(const std::string& bytes, const std::string& name) {
  constexpr std::uint32_t kMostCells = 4096;
  const auto fail = [&](const std::string& message) { return file_error(ErrorKind::kMalformed, name, message); };
  if (!bytes.starts_with("NVIDIA ARC MBSDF V1\n"))
    throw fail("expected measurements that begin with NVIDIA ARC MBSDF V1, got '" + excerpt(bytes) + "'");
  // Lines KEY=… up to the one that announces the values.
  std::size_t at = bytes.find('\n') + 1;
  for (;;) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string::npos) throw fail("expected the line MBSDF_DATA_REFLECTION=, got the end of the file");
    const std::string line = bytes.substr(at, std::min<std::size_t>(end - at, 64));
    at = end + 1;
    if (line == "MBSDF_DATA=" || line == "MBSDF_DATA_REFLECTION=") break;
    if (line == "MBSDF_DATA_TRANSMISSION=")
      throw file_error(ErrorKind::kUnsupported, name, "expected reflected light, got transmitted light");
    if (line.find('=') == std::string::npos) throw fail("expected a line KEY=…, got '" + excerpt(line) + "'");
  }
  if (bytes.size() - at < 12) throw fail("expected 12 bytes of type and resolution, got the end of the file");
  const auto type = value_at<std::uint32_t>(bytes, at), thetas = value_at<std::uint32_t>(bytes, at + 4),
             phis = value_at<std::uint32_t>(bytes, at + 8);
  at += 12;
  if (type > 1) throw fail("expected the type 0 (grey) or 1 (RGB), got " + std::to_string(type));
  if (!(thetas >= 1 && thetas <= kMostCells && phis >= 1 && phis <= kMostCells))
    throw fail("expected 1 to 4096 angles, got " + std::to_string(thetas) + " and " + std::to_string(phis));
  const std::size_t count = std::size_t(thetas) * thetas * phis, channels = type == 1 ? 3 : 1,
                    size = count * channels * sizeof(float);
  if (bytes.size() - at < size)
    throw fail("expected " + std::to_string(size) + " bytes of " + std::to_string(thetas) + "x" +
               std::to_string(thetas) + "x" + std::to_string(phis) + " values, got " +
               std::to_string(bytes.size() - at));
  std::vector<Vec3f> values(count);
  const auto value = [&](std::size_t i) {
    const auto v = value_at<float>(bytes, at + i * sizeof(float));
    if (!std::isfinite(v)) throw fail("expected finite numbers, got another one as value " + std::to_string(i));
    return v;
  };
  for (std::size_t i = 0; i < count; i++) {
    if (channels == 3) values[i] = {value(3 * i), value(3 * i + 1), value(3 * i + 2)};
    else values[i] = Vec3f{1, 1, 1} * value(i);
  }
  return std::make_shared<const MbsdfTable>(int(thetas), int(phis), std::move(values));
}

}  // namespace burnish
