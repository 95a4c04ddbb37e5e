// A way to the colour of a point: what every path offers to the pixel loop.
#pragma once

#include <memory>
#include <vector>

#include "burnish/render/assets.h"
#include "burnish/render/camera.h"
#include "burnish/render/scene.h"

namespace burnish {

// All that a frame is lit and seen by; outlives the path.
struct FrameSetup {
  const Scene& scene;
  const std::vector<ObjectAssets>& assets;
  const Camera& camera;
  const std::vector<Light>& lights;  // as they stand in this frame
  int samples;                       // n × n a pixel
};

// What a path looks up at a point, for auxiliary images. Of filtered lookups it is the nearest texel of the
// nearest level.
struct LookedUp {
  Vec3d normal;       // object space, of any length
  int index = -1;     // into the palette; −1 where the object has none
  int material = -1;  // id of the texel's interval; −1 where there is none
  int level = 0;
};

class ShadingPath {
 public:
  virtual ~ShadingPath() = default;
  // Linear colour that leaves the point towards the viewer. Called from many threads.
  virtual Vec3d shade(std::size_t object, const SurfacePoint& point) const = 0;
  virtual LookedUp look_up(std::size_t object, const SurfacePoint& point) const = 0;
  // Time spent on tables before the first pixel, in milliseconds; the only figure here that differs between
  // runs.
  virtual double table_ms() const { return 0; }
};

// Shades per pixel in double precision, in world space, from the unquantized normals: the nearest texel of
// the base level.
std::unique_ptr<ShadingPath> make_analytic_path(const FrameSetup& setup);

// Shades the palette once, in object space, with light and view as they are at the object's origin; pixels
// only look colours up (Tarini et al., section 5). Exact for directional lights under an orthographic view.
// kMalformed where an object has no indexed map, where its palette is in tangent space and the surface is not
// flat, or where mip levels are asked for and the map has but one.
// Expanded: for each frame the whole map is turned into colours first, as the paper does where hardware has no
// palettes.
std::unique_ptr<ShadingPath> make_palette_path(const FrameSetup& setup, bool expanded);

// The base colour at a point and the alpha of its map, of one texel or filtered; white and 1 where there is none.
struct BaseSample {
  Vec3d colour;
  double alpha;
};
BaseSample base_sample(const Object& object, const ObjectAssets& assets, const SurfacePoint& point, Filter filter);

std::unique_ptr<ShadingPath> make_path(RenderPath path, const FrameSetup& setup);

// The map ends at a sphere's poles and repeats everywhere else.
inline Addressing addressing_of(const Surface& surface) { return {surface.type != SurfaceType::kSphere}; }

}  // namespace burnish
