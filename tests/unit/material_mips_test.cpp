#include "burnish/material/mips/material_mips.h"

#include <gtest/gtest.h>

#include "burnish/core/mip.h"
#include "expect_error.h"
#include "material_lobe_fixture.h"
#include "on_threads.h"

namespace burnish {
namespace {

using enum MaterialModel;

std::vector<MaterialMipLevel> build(MaterialTextures& m, int levels = 0) { return build_material_mips(m, levels, "m"); }

TEST(MaterialMips, AFlatMapHasItsTexelOnEveryLevel) {
  std::mt19937 random(1);
  for (const MaterialModel model : kAllModels) {
    const Lobe o = random_lobe(model, random);
    MaterialTextures m = textures_of(model, 13, 6, [&](int, int) { return o; });
    const std::vector<MaterialMipLevel> stats = build(m);
    ASSERT_EQ(stats.size(), 4u);
    for (int l = 0; l < 4; l++) {
      EXPECT_EQ(stats[l].width, 13 >> l);
      EXPECT_EQ(stats[l].height, std::max(1, 6 >> l));
      EXPECT_LT(stats[l].relative_error, 1e-4) << name(model) << l;
      EXPECT_LT(stats[l].rms_deg, 1e-3) << name(model) << l;
      for (const MaterialTexture* texture : {&m.t, &m.b, &m.n})
        for (std::size_t i = 0; i < texture->levels[l].data.size(); i++)
          EXPECT_NEAR(texture->levels[l].data[i], texture->levels[0].data[i % texture->channels()], 1e-4)
              << name(model) << l;
    }
  }
}

// A pattern of normals, directions, α and k_s.
MaterialTextures bumps(MaterialModel model, int width, int height) {
  return textures_of(model, width, height, [&](int x, int y) {
    const LocalFrame f = frame_of(0.2 * std::sin(1.1 * x), 0.15 * std::cos(0.9 * y + 0.3 * x), 0.3 * std::sin(0.2 * y));
    return lobe_of(model, f, 0.15 + 0.05 * std::sin(0.5 * x), 0.3, 0.6 + 0.3 * std::cos(0.4 * x));
  });
}

TEST(MaterialMips, TheBaseStaysAndLevelsAreReplaced) {
  for (const MaterialModel model : kAllModels) {
    const MaterialTextures before = bumps(model, 16, 12);
    MaterialTextures m = before;
    build(m);
    EXPECT_EQ(m.t.levels.size(), 5u);
    EXPECT_EQ(build(m, 3).size(), 3u);
    for (MaterialTexture MaterialTextures::*which :
         {&MaterialTextures::t, &MaterialTextures::b, &MaterialTextures::n}) {
      EXPECT_EQ((m.*which).levels.size(), 3u);
      EXPECT_EQ((m.*which).levels[0].data, (before.*which).levels[0].data) << name(model);
    }
  }
}

// Mean over pairs, and over all texels of a level, of the squared difference to the mean of the base texels' L_o under
// each; by the formulas, at pairs that are not those of the fit.
template <typename CoarseAt>
double mean_square_error(const MaterialTextures& m, int level, const CoarseAt& at) {
  std::mt19937 random(11);
  const int size = 1 << level;
  double sum = 0;
  for (int i = 0; i < 60; i++) {
    const Pair p = random_pair(random);
    for (int y = 0; y < m.height() / size; y++)
      for (int x = 0; x < m.width() / size; x++) {
        double mean = 0;
        for (int v = 0; v < size; v++)
          for (int u = 0; u < size; u++)
            mean += reference_reflectance(m.model, lobe_at(m, 0, x * size + u, y * size + v), p.l, p.v);
        const double off = reference_reflectance(m.model, at(x, y), p.l, p.v) - mean / (size * size);
        sum += off * off;
      }
  }
  return sum;
}

TEST(MaterialMips, AreNearerThanAveragesThatAreRenormalised) {
  for (const MaterialModel model : kAllModels) {
    MaterialTextures m = bumps(model, 32, 32);
    const std::vector<MaterialMipLevel> stats = build(m);
    for (const int level : {1, 2, 3}) {
      const auto averaged = [&](int x, int y) {
        Lobe o;
        Vec3d t, n;
        double count = 0, alpha_x = 0, alpha_y = 0, k_s = 0;
        for (int v = y << level; v < (y + 1) << level; v++)
          for (int u = x << level; u < (x + 1) << level; u++) {
            const Lobe base = lobe_at(m, 0, u, v);
            t += base.frame.t, n += base.frame.n, count++;
            alpha_x += base.alpha_x, alpha_y += base.alpha_y, k_s += base.k_s, o.exponent += base.exponent;
          }
        o.frame = *orthonormal_frame(n, t);
        o.alpha_x = alpha_x / count, o.alpha_y = alpha_y / count, o.k_s = k_s / count, o.exponent /= count;
        return o;
      };
      const auto fitted = [&](int x, int y) { return lobe_at(m, level, x, y); };
      const double gain_db =
          10 * std::log10(mean_square_error(m, level, averaged) / mean_square_error(m, level, fitted));
      EXPECT_GT(gain_db, model == kBanks ? 0.5 : level == 1 ? 6 : 12) << name(model) << ", level " << level;
      EXPECT_GT(stats[level].relative_error, 0.001) << name(model) << level;
      EXPECT_LT(stats[level].relative_error, 0.2) << name(model) << level;
    }
  }
}

// Lobes of one shape add up to that shape: k_s is the mean, and with the weights of odd sizes each texel counts once.
TEST(MaterialMips, TheMeanOfLobesOfOneShapeIsExact) {
  for (const MaterialModel model : kAllModels)
    for (const auto& [width, height] : {std::pair{8, 8}, {7, 5}, {1, 9}}) {
      double mean = 0;
      MaterialTextures m = textures_of(model, width, height, [&](int x, int y) {
        const double k_s = double((x * 7 + y * 3) % 5) / 4;  // some are black
        mean += k_s / (width * height);
        return lobe_of(model, frame_of(0.1, 0.2, 0.5), 0.2, 0.3, k_s);
      });
      const std::vector<MaterialMipLevel> stats = build(m);
      const Lobe top = lobe_at(m, int(stats.size()) - 1, 0, 0);
      EXPECT_NEAR(top.k_s / mean, 1, 1e-4) << name(model) << ", " << width << "x" << height;
      for (const MaterialMipLevel& s : stats) EXPECT_LT(s.relative_error, 1e-4) << name(model);
    }
}

TEST(MaterialMips, BlackTexelsStayBlack) {
  MaterialTextures m =
      textures_of(kWard, 4, 4, [](int x, int) { return lobe_of(kWard, frame_of(x % 2 ? 0.3 : -0.3, 0), 0.2, 0.2, 0); });
  for (const MaterialMipLevel& s : build(m)) EXPECT_EQ(s.relative_error, 0);
  const Lobe top = lobe_at(m, 2, 0, 0);
  EXPECT_EQ(top.k_s, 0);
  EXPECT_NEAR(top.frame.n.z, 1, 1e-6);
}

// The wider the normals spread, the wider the lobe, along the axis they spread over.
TEST(MaterialMips, BumpsAlongOneAxisWidenTheLobeThere) {
  MaterialTextures m = textures_of(
      kWard, 8, 8, [](int x, int) { return lobe_of(kWard, frame_of(0.25 * std::sin(0.8 * x), 0), 0.15, 0.15, 1); });
  build(m);
  const Lobe top = lobe_at(m, 3, 0, 0);
  EXPECT_GT(top.alpha_x, 0.22);
  EXPECT_NEAR(top.alpha_y, 0.15, 0.01);
  EXPECT_GT(std::abs(top.frame.t.x), 0.99);
  EXPECT_NEAR(top.k_s, 1, 0.1);
}

// Bumps stretch lobes along any axis; t stays within 45° of the base's all the same.
TEST(MaterialMips, TangentsKeepTheirSide) {
  for (const MaterialModel model : {kWard, kBlinnPhong}) {
    MaterialTextures m = textures_of(model, 32, 32, [&](int x, int y) {
      const double phase = 0.9 * x * std::cos(0.15 * y) + 0.9 * y * std::sin(0.15 * x);
      return lobe_of(model, frame_of(0.3 * std::sin(phase), 0.3 * std::cos(1.7 * phase)), 0.15, 0.2, 1);
    });
    build(m);
    for (int l = 1; l < 6; l++)
      for (int y = 0; y < 32 >> l; y++)
        for (int x = 0; x < 32 >> l; x++) {
          const LocalFrame f = lobe_at(m, l, x, y).frame;
          EXPECT_GT(f.t.x, 0.65) << name(model) << l;
          EXPECT_GT(dot(cross(f.n, f.t), f.b), 0.999);
        }
  }
}

TEST(MaterialMips, LobesTooNarrowToBeSeenKeepTheirMoments) {
  MaterialTextures m =
      textures_of(kWard, 2, 1, [](int x, int) { return lobe_of(kWard, frame_of(0.1, x * 1e-4), 1e-5, 2e-6, 1); });
  build(m);
  const Lobe top = lobe_at(m, 1, 0, 0);
  EXPECT_NEAR(length(top.frame.n - frame_of(0.1, 0.5e-4).n), 0, 1e-3);
  EXPECT_NEAR(top.k_s, 1, 1e-2);
}

TEST(MaterialMips, TheSameForAnyThreadCount) {
  const auto made = [] {
    MaterialTextures m = bumps(kWard, 45, 31);
    build(m);
    std::vector<float> all;
    for (const MaterialTexture* texture : {&m.t, &m.b, &m.n})
      for (const Image& level : texture->levels) all.insert(all.end(), level.data.begin(), level.data.end());
    return all;
  };
  EXPECT_EQ(on_threads(1, made), on_threads(4, made));
}

TEST(MaterialMips, WrongUse) {
  MaterialTextures m = bumps(kWard, 16, 12);
  EXPECT_ERROR(build(m, 6), ErrorKind::kUsage, "levels: expected 1 to 5 for 16x12 texels, got 6");
  m.b.levels[0].at(3, 2)[0] = m.b.levels[0].at(3, 2)[1] = m.b.levels[0].at(3, 2)[2] = 0;
  EXPECT_ERROR(build(m), ErrorKind::kMalformed, "'m': column 3, row 2: expected t, b and n of some length");
}

}  // namespace
}  // namespace burnish
