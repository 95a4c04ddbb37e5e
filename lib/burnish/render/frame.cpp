#include "burnish/render/frame.h"

#include <algorithm>
#include <optional>

#include "burnish/core/parallel.h"
#include "burnish/render/visibility.h"

namespace burnish {
namespace {

class PixelLoop {
 public:
  PixelLoop(const FrameSetup& setup, const ShadingPath& path, const std::vector<Aov>& aovs, Frame& frame)
      : setup_(setup), path_(path), aovs_(aovs), frame_(frame) {}

  void row(int y) const {
    for (int x = 0; x < frame_.colour.width; x++) {
      colour(x, y);
      if (aovs_.empty()) continue;
      const std::optional<Seen> seen = nearest_point(setup_, setup_.camera.ray(x + 0.5, y + 0.5));
      for (std::size_t i = 0; i < aovs_.size(); i++)
        write_aov(aovs_[i], setup_, path_, seen ? seen->object : 0, seen ? &seen->point : nullptr,
                  frame_.aovs[i].at(x, y));
    }
  }

 private:
  void colour(int x, int y) const {
    const int n = setup_.samples;
    Vec3d sum;
    bool covered = false;
    for (int j = 0; j < n; j++)
      for (int i = 0; i < n; i++) {
        const Ray ray = setup_.camera.ray(x + (i + 0.5) / n, y + (j + 0.5) / n);
        const std::optional<Seen> seen = nearest_point(setup_, ray);
        covered |= seen.has_value();
        sum += seen ? path_.shade(seen->object, seen->point) : setup_.scene.image.background;
      }
    const Vec3d mean = sum / (double(n) * n);
    float* out = frame_.colour.at(x, y);
    out[0] = float(mean.x), out[1] = float(mean.y), out[2] = float(mean.z);
    *frame_.covered.at(x, y) = covered;
  }

  const FrameSetup& setup_;
  const ShadingPath& path_;
  const std::vector<Aov>& aovs_;
  Frame& frame_;
};

}  // namespace

Frame render_frame(const Scene& scene, const std::vector<ObjectAssets>& assets, const FrameSettings& settings,
                   const Progress& progress) {
  constexpr int kBand = 32;  // rows between two reports of progress
  const int width = scene.image.width, height = scene.image.height;
  const Camera camera(scene.camera, width, height);
  std::vector<Light> lights = scene.lights;
  if (settings.turn_rad != 0)
    for (Light& light : lights) light = turned(light, rotation_about(scene.turn_axis, settings.turn_rad));
  const FrameSetup setup{scene, assets, camera, lights, settings.samples};
  const std::unique_ptr<ShadingPath> path = make_path(settings.path, setup);

  Frame frame{Image(width, height, 3), ByteImage(width, height), {}, path->table_ms()};
  for (Aov aov : settings.aovs) frame.aovs.emplace_back(width, height, channel_count(aov));
  const PixelLoop loop(setup, *path, settings.aovs, frame);
  for (int first = 0; first < height; first += kBand) {
    const int count = std::min(kBand, height - first);
    parallel_for(count, [&](std::size_t i) { loop.row(first + int(i)); });
    report_progress(progress, double(first + count) / height);
  }
  return frame;
}

}  // namespace burnish
