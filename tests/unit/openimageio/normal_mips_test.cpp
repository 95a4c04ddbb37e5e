#include "burnish/normal/normal_mips.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "burnish/core/mip.h"
#include "burnish/core/mip_average.h"
#include "normal_mips_fixture.h"
#include "scratch_dir.h"

namespace burnish {
namespace {

using testing::made, testing::random_normals, testing::ScratchDir;

// From files in tiles and in rows, of one band and of many: each level is the mean of the whole one above.
TEST(NormalMips, AreTheSameFromTilesAndFromRows) {
  const ScratchDir dir;
  const std::pair<int, int> sizes[] = {{1, 1}, {5, 3}, {127, 65}, {3, 9001}, {9000, 70}};
  for (const auto& [w, h] : sizes) {
    const Image base = random_normals(w, h);
    for (const char* file : {"n.exr", "n.tif"})
      for (const int tile : {0, 16, 64}) {
        OIIO::ImageSpec spec(w, h, 3, OIIO::TypeDesc::FLOAT);
        spec.tile_width = spec.tile_height = tile;
        spec.attribute("compression", "zip");
        const auto out = OIIO::ImageOutput::create(dir / file);
        ASSERT_TRUE(out && out->open(dir / file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, base.data.data()));
        ASSERT_TRUE(out->close());
        NormalMips mips(dir / file, {}, 0);
        const std::vector<Image> means = made(mips).means;
        ASSERT_EQ(int(means.size()), level_count(w, h));
        Image level = base;
        for (std::size_t i = 0; i < base.texels(); i++) {  // what a reader makes of what is nearly unit
          const Vec3f n(normalized(Vec3d(base.data[3 * i], base.data[3 * i + 1], base.data[3 * i + 2])));
          std::copy_n(&n.x, 3, &level.data[3 * i]);
        }
        for (std::size_t l = 0; l < means.size(); l++) {
          EXPECT_EQ(means[l].data, level.data) << w << "x" << h << " " << file << " tile " << tile << " level " << l;
          level = next_mean_level(level);
        }
      }
  }
}

}  // namespace
}  // namespace burnish
