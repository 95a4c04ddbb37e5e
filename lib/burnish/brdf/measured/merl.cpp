#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "burnish/brdf/measured/half_difference_table.h"
#include "burnish/brdf/measured/readers.h"
#include "burnish/core/error.h"

namespace burnish {

std::shared_ptr<const Brdf> parse_merl(const std::string& bytes, const std::string& name) {
  constexpr std::size_t kHead = 12;
  constexpr std::int32_t kMostCells = 4096;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const auto fail = [&](const std::string& message) { return file_error(ErrorKind::kMalformed, name, message); };
  if (bytes.size() < kHead)
    throw fail("expected three counts of cells in 12 bytes, got " + std::to_string(bytes.size()) + " bytes");
  std::array<std::int32_t, 3> n;
  for (int i = 0; i < 3; i++) {
    n[i] = value_at<std::int32_t>(bytes, 4 * i);
    if (!(n[i] >= 1 && n[i] <= kMostCells))
      throw fail("expected counts of cells from 1 to 4096, got " + std::to_string(n[i]));
  }
  const HalfDifferenceCells cells{n[0], n[1], n[2]};
  const std::size_t count = cells.count(), expected = kHead + count * 3 * sizeof(double);
  if (bytes.size() != expected)
    throw fail("expected " + std::to_string(expected) + " bytes of " + std::to_string(n[0]) + "x" +
               std::to_string(n[1]) + "x" + std::to_string(n[2]) + " cells, got " + std::to_string(bytes.size()));

  std::vector<Vec3f> values(count);
  const auto measured = [&](std::size_t plane, std::size_t i, double scale) {
    const double value = value_at<double>(bytes, kHead + (plane * count + i) * sizeof(double));
    if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max())
      throw fail("expected finite numbers, got another one in cell " + std::to_string(i));
    return value < 0 ? kUnknown : float(value * scale);
  };
  for (std::size_t i = 0; i < count; i++) {
    const Vec3f v{measured(0, i, 1 / 1500.0), measured(1, i, 1.15 / 1500), measured(2, i, 1.66 / 1500)};
    values[i] = std::isnan(v.x + v.y + v.z) ? Vec3f{kUnknown, kUnknown, kUnknown} : v;
  }
  return std::make_shared<const HalfDifferenceTable>(cells, std::move(values));
}

}  // namespace burnish
