// A scene as the renderer takes it: what stands where, lit by what, seen from where, and how exact a path
// must be.
//
// Read from TOML; every key, its range and its default stand in samples/README.md. Paths in the file are
// relative to the file. Space is right-handed; angles are degrees in the file and radians here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/vec3.h"
#include "burnish/normal/coding.h"
#include "burnish/palette/indexed_map.h"
#include "burnish/render/anisotropy/reflectance.h"
#include "burnish/render/blend.h"
#include "burnish/render/camera.h"
#include "burnish/render/light.h"
#include "burnish/render/lighting/material.h"
#include "burnish/render/lookup.h"
#include "burnish/render/mesh_surface.h"
#include "burnish/render/mip_level.h"
#include "burnish/render/ptm/scene_ptm.h"
#include "burnish/render/surface.h"
#include "burnish/render/transform.h"

namespace burnish {

enum class RenderPath {
  kAnalytic,
  kPalette,
  kPaletteExpanded,
  kBanks,
  kBanksApproximate,
  kBlinnPhong,
  kBlinnPhongEquation1,
  kWard,
  kCombiner,
  kImaging,
  kStrandPs11,
  kStrandPs14,
  kStrandBump,
  kStrandBumpUnnormalised,
  kPtm,
  kPtmBrdf,
};
const char* name(RenderPath path);  // "analytic", "palette", "palette-expanded", "banks", …
// Throws `unknown`, with the names that there are, for any other.
RenderPath render_path(const std::string& name, ErrorKind unknown);

// The surface's own colour, which shading is blended with (Tarini et al., section 7).
struct BaseColour {
  Vec3d colour{1, 1, 1};
  std::string map;                 // empty: none; otherwise multiplied by the colour
  std::optional<bool> srgb;        // whether the map's samples are; none: integers are, floats are linear
  Blend blend = Blend::kMaterial;  // kMaterial: there is no base colour
};

struct Object {
  Surface surface;
  std::string mesh;  // surface mesh: its file
  MeshShading shading = MeshShading::kSmooth;
  Transform transform;
  std::string normal_map, indexed_map;  // empty: none; with neither the surface's own normals are shaded
  std::string palette;                  // of an indexed map whose file holds none (DDS); otherwise empty
  BaseColour base;
  std::optional<NormalSpace> normal_space;  // of both maps; none: as they say, otherwise tangent
  NormalCoding coding;  // of the normal map; its green axis also of an indexed map that does not tell its own
  std::optional<Reflectance> reflectance;  // none: a PTM, or the scene's materials
  std::optional<PtmSource> ptm;
  Filter filter = Filter::kNearest;
  MipMode mip = MipMode::kOff;
};

// For messages: the object with 'a.exr', by the first file it has; otherwise the quad or the sphere.
std::string described(const Object& object);

struct ImageSettings {
  int width = 512, height = 512;
  Vec3d background;
  double exposure_stops = 0;  // pictures only: linear values are multiplied by 2^exposure before they are encoded
};

// What a path must keep to, held against its twin; none: not asked for.
struct Tolerances {
  std::optional<double> min_psnr_db, max_abs, max_rmse, max_p95_abs;
};

struct ValidationSettings {
  Tolerances tolerances;
  std::optional<int> samples;      // of the twin; none: as the path
  std::optional<double> heat_max;  // difference that takes the heat map's last colour; none: the largest there is
};

struct Scene {
  std::string name;  // of the file, for messages
  RenderPath path = RenderPath::kAnalytic;
  int samples = 1;  // n: n × n a pixel, on a regular grid
  ImageSettings image;
  CameraSettings camera;
  Vec3d ambient;
  std::vector<Light> lights;
  bool shadows = false;      // whether objects keep lights off each other and themselves
  Vec3d turn_axis{0, 1, 0};  // unit; frames turn the lights about it, through the world's origin
  std::vector<Object> objects;
  std::vector<Material> materials;  // one without an id, or all with ids that differ
  SceneTables tables;
  ValidationSettings validation;

  // Every file that the scene names, in their order, each once.
  std::vector<std::string> files() const;
};

// kIo where the file cannot be read; kMalformed for what is no TOML, unknown keys, wrong types, values out of
// range and keys that exclude each other.
Scene read_scene(const FileRef& file);
// The same from memory; `directory` is what its paths are relative to (empty: the working directory).
Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory);

}  // namespace burnish
