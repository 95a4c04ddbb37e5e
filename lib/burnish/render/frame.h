// One picture of a scene: the pixel loop.
//
// A pixel is the mean of samples² colours on a regular grid, background included where a sample meets no
// object; of several objects the nearest is seen. Rows run in parallel; a pixel depends on nothing but
// itself.
#pragma once

#include <vector>

#include "burnish/core/image.h"
#include "burnish/core/progress.h"
#include "burnish/render/aov.h"
#include "burnish/render/assets.h"
#include "burnish/render/scene.h"

namespace burnish {

struct FrameSettings {
  RenderPath path = RenderPath::kAnalytic;
  int samples = 1;
  double turn_rad = 0;  // of all lights, about Scene::turn_axis
  std::vector<Aov> aovs;
};

struct Frame {
  Image colour;             // linear RGB
  ByteImage covered;        // whether any sample of the pixel met an object
  std::vector<Image> aovs;  // as FrameSettings::aovs
  double table_ms = 0;      // time to shade the palettes; 0 where the path has no table
};

// `assets` is load_assets(scene). Errors as of the path's making: see shading_path.h.
Frame render_frame(const Scene& scene, const std::vector<ObjectAssets>& assets, const FrameSettings& settings,
                   const Progress& progress = {});

}  // namespace burnish
