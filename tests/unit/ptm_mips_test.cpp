#include "burnish/ptm/ptm_mips.h"

#include <gtest/gtest.h>

#include "burnish/core/mip.h"
#include "burnish/ptm/coefficient_range.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/multiplied_out.h"
#include "burnish/ptm/round_ptm.h"
#include "expect_error.h"
#include "ptm_map_fixture.h"

namespace burnish {
namespace {

using testing::made_up_bytes;
using testing::made_up_map;

TEST(MultipliedOut, ShowsTheSame) {
  const Ptm map = made_up_map(PtmType::kLrgb, 7, 6);
  const PtmInMemory rows(map);
  const MultipliedOut out(rows);
  ASSERT_EQ(out.shape().type, PtmType::kRgb);
  Ptm rgb{out.shape(), std::vector<float>(map.texels() * 18), {}};
  out.read(0, 2, rgb.coefficients.data(), nullptr);
  out.read(2, 4, rgb.coefficients.data() + 2 * 7 * 18, nullptr);
  for (std::size_t i = 0; i < map.texels(); i++)
    for (int c = 0; c < 3; c++) EXPECT_NEAR(rgb.lit(i, 0.3f, -0.5f)[c], map.lit(i, 0.3f, -0.5f)[c], 1e-4) << i;
}

// Of odd sides too: under any light, a level's mean light is the base's.
TEST(PtmMips, KeepTheMeanLight) {
  for (const PtmType type : {PtmType::kLrgb, PtmType::kRgb}) {
    const Ptm base = made_up_map(type, 13, 10);
    const PtmMips mips = build_ptm_mips(PtmInMemory(base), 0);
    ASSERT_EQ(int(mips.levels.size()), level_count(13, 10));
    const auto mean = [](const Ptm& map, int c) {
      double sum = 0;
      for (std::size_t i = 0; i < map.texels(); i++) sum += map.lit(i, -0.2f, 0.6f)[c];
      return sum / double(map.texels());
    };
    for (const Ptm& level : mips.levels)
      for (int c = 0; c < 3; c++) EXPECT_NEAR(mean(level, c), mean(base, c), 1e-3) << level.width;
    EXPECT_EQ(mips.rms_deg[0], 0);
    for (std::size_t l = 1; l < mips.rms_deg.size(); l++) EXPECT_GT(mips.rms_deg[l], 0) << l;
  }
}

TEST(PtmMips, BytesOfAllLevelsHaveTheRangeOfTheBase) {
  const PtmBytes base = made_up_bytes(PtmType::kRgb, 12, 8);
  const PtmInBytes rows(base);
  const std::vector<PtmBytes> levels = rounded(build_ptm_mips(rows, 3), rows, uniform_normal_matrix());
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].coefficients, base.coefficients);
  for (const PtmBytes& level : levels) {
    EXPECT_EQ(level.scale, base.scale);
    EXPECT_EQ(level.bias, base.bias);
  }
  const PtmInMemory floats(made_up_map(PtmType::kLrgb, 12, 8));
  const PtmMips mips = build_ptm_mips(floats, 0);
  const std::vector<PtmBytes> of_floats = rounded(mips, floats, uniform_normal_matrix());
  EXPECT_EQ(of_floats[0].coefficients, rounded(MultipliedOut(floats), uniform_normal_matrix()).coefficients);
  for (std::size_t l = 0; l < of_floats.size(); l++)
    for (std::size_t i = 0; i < mips.levels[l].texels(); i++)
      EXPECT_NEAR(decoded(of_floats[l]).lit(i, 0.3f, 0.4f)[1], mips.levels[l].lit(i, 0.3f, 0.4f)[1], 1) << l;
}

TEST(PtmMips, MoreLevelsThanThereAreAreRefused) {
  EXPECT_ERROR(build_ptm_mips(PtmInMemory(made_up_map(PtmType::kRgb, 4, 4)), 4), ErrorKind::kUsage,
               "levels: expected 1 to 3");
}

TEST(CoefficientRange, OfAllPolynomials) {
  const Ptm map = made_up_map(PtmType::kRgb, 30, 20);
  const CoefficientRange range = coefficient_range(PtmInMemory(map));
  for (int k = 0; k < kPtmTerms; k++) {
    float least = INFINITY, most = -INFINITY;
    for (std::size_t i = k; i < map.coefficients.size(); i += kPtmTerms)
      least = std::min(least, map.coefficients[i]), most = std::max(most, map.coefficients[i]);
    EXPECT_EQ(range.least[k], least);
    EXPECT_EQ(range.most[k], most);
  }
}

}  // namespace
}  // namespace burnish
