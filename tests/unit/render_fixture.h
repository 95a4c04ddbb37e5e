// Scenes and maps made in memory, for the renderer's tests.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "burnish/render/assets.h"
#include "burnish/render/frame.h"
#include "burnish/render/scene.h"

namespace burnish::testing {

// A unit quad that fills the picture, seen straight on by an orthographic camera, lit from +z.
inline Scene quad_scene(int size_px = 16) {
  Scene s;
  s.name = "scene.toml";
  s.image.width = s.image.height = size_px;
  s.lights.push_back({});
  s.materials.push_back({});
  s.objects.push_back({});
  s.objects[0].normal_map = "normals.exr";
  return s;
}

inline Scene sphere_scene(int size_px = 64) {
  Scene s = quad_scene(size_px);
  s.objects[0].surface.type = SurfaceType::kSphere;
  s.objects[0].surface.radius = 0.5;
  s.objects[0].normal_space = NormalSpace::kObject;
  return s;
}

// A glossy material of one term, Phong's unless said otherwise.
template <typename Model = Phong>
Material glossy(Vec3d ambient, Vec3d diffuse, Vec3d specular, double exponent) {
  Model m;
  m.ambient = ambient, m.diffuse = diffuse, m.specular = specular, m.exponent = exponent;
  return {{}, {m}};
}

// A map of one normal.
inline ObjectAssets constant_normals(const Scene& scene, Vec3d n) {
  ObjectAssets a;
  a.width = a.height = 1;
  a.normals = {Vec3f(normalized(n))};
  a.only_material = &scene.materials[0];
  return a;
}

// Directions spread evenly over a hemisphere (z > 0) or the sphere.
inline std::vector<Vec3f> spread_normals(int count, bool hemisphere) {
  std::vector<Vec3f> out;
  for (int i = 0; i < count; i++) {
    const double z = 1 - (hemisphere ? 1 : 2) * (i + 0.5) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    out.push_back(Vec3f(Vec3d{r * std::cos(a), r * std::sin(a), z}));
  }
  return out;
}

// An indexed map with every entry somewhere, materials in equal shares, and the same normals as the analytic
// path's own.
inline ObjectAssets indexed_assets(const Scene& scene, int side, int entries, bool hemisphere, int materials = 1) {
  ObjectAssets a;
  a.indexed.emplace();
  Palette& palette = a.indexed->palette;
  palette.normals = spread_normals(entries, hemisphere);
  palette.space = hemisphere ? NormalSpace::kTangent : NormalSpace::kObject;
  for (int m = 0; m < materials; m++)
    palette.materials.push_back({m, m * entries / materials, (m + 1) * entries / materials - m * entries / materials});
  IndexImage base(side, side);
  for (std::size_t i = 0; i < base.data.size(); i++) base.data[i] = std::uint16_t((i * 7919) % entries);
  a.width = a.height = side;
  for (std::uint16_t index : base.data) a.normals.push_back(palette.normals[index]);
  a.indexed->levels.push_back(base);
  a.space = palette.space;
  if (materials == 1) a.only_material = &scene.materials[0];
  for (int m = 0; m < materials; m++) a.interval_materials.push_back(&scene.materials[m]);
  return a;
}

inline Frame render(const Scene& scene, const ObjectAssets& assets, RenderPath path,
                    const std::vector<Aov>& aovs = {}) {
  const std::vector<ObjectAssets> all{assets};
  return render_frame(scene, all, {path, scene.samples, 0, aovs});
}

}  // namespace burnish::testing
