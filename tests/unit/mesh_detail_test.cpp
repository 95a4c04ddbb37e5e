#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "../mesh_patterns.h"
#include "burnish/mesh/atlas/atlas.h"
#include "burnish/mesh/bake/transfer.h"
#include "burnish/mesh/simplify/decimate.h"
#include "burnish/render/mesh_surface.h"
#include "burnish/render/metrics.h"
#include "render_fixture.h"

namespace burnish {
namespace {

// A mesh, with a normal map or bare, seen from six sides and lit from the upper left.
class Views {
 public:
  std::vector<Frame> of(const Mesh& mesh, const TransferMaps* maps = nullptr) {
    ObjectAssets assets;
    assets.mesh = std::make_shared<const MeshSurface>(mesh, MeshShading::kSmooth);
    assets.space = NormalSpace::kObject;
    assets.only_material = &scene_.materials[0];
    if (maps) assets.width = maps->width, assets.height = maps->height, assets.normals = maps->normals;
    std::vector<Frame> out;
    for (const Vec3d turn : {Vec3d{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {1, 0, 0}, {-1, 0, 0}}) {
      scene_.objects[0].transform.rotation = rotation_xyz(turn * (kPi / 2));
      out.push_back(testing::render(scene_, assets, RenderPath::kAnalytic));
    }
    return out;
  }

  // Over the pixels that both cover, of all pictures together.
  static double psnr_db(const std::vector<Frame>& a, const std::vector<Frame>& b) {
    double squares = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < a.size(); i++) {
      ByteImage both = a[i].covered;
      std::ranges::transform(both.data, b[i].covered.data, both.data.begin(), std::multiplies());
      const ErrorMetrics m = compare(a[i].colour, b[i].colour, both);
      squares += m.rmse * m.rmse * double(m.pixels), pixels += m.pixels;
    }
    return -10 * std::log10(squares / double(pixels));
  }

 private:
  static Scene scene() {
    Scene s = testing::quad_scene(160);
    s.objects[0].surface.type = SurfaceType::kMesh;
    s.objects[0].normal_map.clear();
    s.camera.height = 2.4;
    s.lights[0].direction = normalized(Vec3d{-0.7, 0.8, 1});
    s.materials[0] = {{}, {Lambert{}}};
    return s;
  }
  Scene scene_ = scene();
};

// What samples/tarini/measure-transfer measures of larger ones: 6240 faces become 150 and a map, which looks like them.
TEST(Detail, AMapGivesBackWhatFewerFacesLose) {
  const Mesh high = without_uvs(named_mesh("bumpy-sphere", 40));
  Mesh low = decimate(high, 150);
  add_atlas(low, 256);
  TransferOptions options;
  options.width = options.height = 256;
  const TransferMaps maps = transfer_detail(low, high, options);
  EXPECT_EQ(low.triangles.size(), 150u);
  EXPECT_EQ(maps.missed_texels, 0u);

  Views views;
  const std::vector<Frame> truth = views.of(high);
  const double bare = Views::psnr_db(views.of(low), truth), mapped = Views::psnr_db(views.of(low, &maps), truth);
  EXPECT_LT(bare, 30) << "there is detail to lose";
  EXPECT_GT(mapped - bare, 8) << "from " << bare << " dB to " << mapped;
}

}  // namespace
}  // namespace burnish
