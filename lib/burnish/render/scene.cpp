#include "burnish/render/scene.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "burnish/core/toml_file.h"
#include "burnish/core/whole_file.h"
#include "burnish/core/wording.h"
#include "burnish/render/anisotropy/scene_reflectance.h"
#include "burnish/render/scene_materials.h"
#include "burnish/render/scene_objects.h"

namespace burnish {
namespace {

constexpr NumberRange kFovDeg{kAboveZero, 179.999, "an angle above 0 and below 180"};
constexpr NumberRange kExposure{-64, 64, "a number of stops from -64 to 64"};
constexpr int kLargestSide = 32768, kMostSamples = 64;

Vec3d unit_vector(const TomlTable& table, const std::string& key, std::optional<Vec3d> fallback = {}) {
  const Vec3d v = table.vector(key, kAnyNumber, fallback);
  if (!(length(v) > 0)) table.fail(key, "expected a direction, got a vector of no length");
  return normalized(v);
}

ImageSettings image_settings(const TomlTable& t) {
  ImageSettings image;
  image.width = t.integer("width", 1, kLargestSide, image.width);
  image.height = t.integer("height", 1, kLargestSide, image.height);
  image.background = t.vector("background", kNotNegative, image.background);
  image.exposure_stops = t.number("exposure", kExposure, image.exposure_stops);
  t.refuse_unknown();
  return image;
}

CameraSettings camera_settings(const TomlTable& t) {
  CameraSettings camera;
  camera.type = t.choice<CameraType>(
      "type", {{"orthographic", CameraType::kOrthographic}, {"perspective", CameraType::kPerspective}}, camera.type);
  camera.position = t.vector("position", kAnyNumber, camera.position);
  camera.look_at = t.vector("look_at", kAnyNumber, camera.look_at);
  camera.up = unit_vector(t, "up", camera.up);
  if (camera.type == CameraType::kOrthographic) camera.height = t.number("height", kPositive, camera.height);
  else camera.fov_deg = t.number("fov_deg", kFovDeg, camera.fov_deg);
  const Vec3d view = camera.look_at - camera.position;
  if (!(length(view) > 0)) t.fail("look_at", "expected a point other than 'camera.position'");
  if (length(cross(normalized(view), camera.up)) < 1e-6) t.fail("up", "expected a direction other than the view's own");
  t.refuse_unknown();
  return camera;
}

Light light(const TomlTable& t) {
  Light light;
  light.type =
      t.choice<LightType>("type", {{"directional", LightType::kDirectional}, {"point", LightType::kPoint}}, light.type);
  light.colour = t.vector("color", kNotNegative, light.colour);
  light.intensity = t.number("intensity", kNotNegative, light.intensity);
  if (light.type == LightType::kDirectional) {
    light.direction = unit_vector(t, "direction");
  } else {
    light.position = t.vector("position", kAnyNumber);
    light.falloff = t.choice<Falloff>(
        "falloff", {{"none", Falloff::kNone}, {"inverse-square", Falloff::kInverseSquare}}, light.falloff);
  }
  t.refuse_unknown();
  return light;
}

ValidationSettings validation(const TomlTable& t) {
  ValidationSettings v;
  const auto optional_number = [&](const std::string& key, const NumberRange& range) -> std::optional<double> {
    if (!t.has(key)) return {};
    return t.number(key, range);
  };
  v.tolerances.min_psnr_db = optional_number("min_psnr_db", kAnyNumber);
  v.tolerances.max_abs = optional_number("max_abs", kNotNegative);
  v.tolerances.max_rmse = optional_number("max_rmse", kNotNegative);
  v.tolerances.max_p95_abs = optional_number("max_p95_abs", kNotNegative);
  if (t.has("samples")) v.samples = t.integer("samples", 1, kMostSamples);
  v.heat_max = optional_number("heat_max", kPositive);
  t.refuse_unknown();
  return v;
}

const std::vector<std::pair<const char*, RenderPath>> kPaths{
    {"analytic", RenderPath::kAnalytic},
    {"palette", RenderPath::kPalette},
    {"palette-expanded", RenderPath::kPaletteExpanded},
    {"banks", RenderPath::kBanks},
    {"banks-approximate", RenderPath::kBanksApproximate},
    {"blinn-phong", RenderPath::kBlinnPhong},
    {"blinn-phong-eq1", RenderPath::kBlinnPhongEquation1},
    {"ward", RenderPath::kWard},
    {"combiner", RenderPath::kCombiner},
    {"imaging", RenderPath::kImaging},
    {"strand-ps11", RenderPath::kStrandPs11},
    {"strand-ps14", RenderPath::kStrandPs14},
    {"strand-bump", RenderPath::kStrandBump},
    {"strand-bump-unnormalised", RenderPath::kStrandBumpUnnormalised},
    {"ptm", RenderPath::kPtm},
    {"ptm-brdf", RenderPath::kPtmBrdf},
};

}  // namespace

const char* name(RenderPath path) {
  return std::ranges::find(kPaths, path, &std::pair<const char*, RenderPath>::second)->first;
}

RenderPath render_path(const std::string& name, ErrorKind unknown) {
  std::vector<std::string> all;
  for (const auto& [word, path] : kPaths) {
    if (name == word) return path;
    all.emplace_back(word);
  }
  throw Error(unknown, "expected a path, one of " + joined(all) + ", got '" + name + "'");
}

std::string described(const Object& object) {
  for (const std::string& file : {object.indexed_map, object.normal_map, object.mesh})
    if (!file.empty()) return "the object with '" + file + "'";
  return std::string("the ") + name(object.surface.type);
}

std::vector<std::string> Scene::files() const {
  std::vector<std::string> out;
  const auto add = [&](const std::string& file) {
    if (!file.empty() && std::ranges::find(out, file) == out.end()) out.push_back(file);
  };
  for (const Object& o : objects)
    for (const std::string& file : {o.mesh, o.normal_map, o.indexed_map, o.palette, o.base.map}) add(file);
  for (const Object& o : objects)
    if (o.reflectance)
      for (const std::string& file : o.reflectance->files()) add(file);
  for (const Object& o : objects)
    if (o.ptm)
      for (const std::string& file : o.ptm->files()) add(file);
  for (const auto& [kind, table] : tables) add(table.file);
  for (const Material& m : materials)
    for (const LightingModel& term : m.terms)
      if (const auto* environment = std::get_if<Environment>(&term)) add(environment->file);
  return out;
}

Scene parse_scene(std::string_view text, const std::string& name, const std::string& directory) {
  const TomlTable root = TomlTable::parse(text, name);
  Scene scene;
  scene.name = name;
  if (root.has("path")) {
    try {
      scene.path = render_path(root.text("path"), ErrorKind::kMalformed);
    } catch (const Error& error) {
      root.fail("path", error.what());
    }
  }
  scene.samples = root.integer("samples", 1, kMostSamples, scene.samples);
  scene.image = image_settings(root.table("image"));
  scene.camera = camera_settings(root.table("camera"));
  scene.ambient = root.vector("ambient", kNotNegative, scene.ambient);
  scene.shadows = root.choice<bool>("shadows", {{"none", false}, {"cast", true}}, scene.shadows);
  for (const TomlTable& t : root.tables("light")) scene.lights.push_back(light(t));
  scene.turn_axis = unit_vector(root, "turn_axis", scene.camera.up);
  for (const TomlTable& t : root.tables("object")) scene.objects.push_back(parse_object(t, directory));
  if (scene.objects.empty()) root.fail("object", "expected at least one [[object]], got none");
  scene.materials = parse_materials(root, directory);
  scene.tables = parse_tables(root.table("tables"), directory);
  if (root.has("material") &&
      std::ranges::all_of(scene.objects, [](const Object& o) { return o.reflectance || o.ptm; }))
    root.fail("material", "expected no [[material]] where every object has an [object.reflectance] or [object.ptm]");
  scene.validation = validation(root.table("validate"));
  root.refuse_unknown();
  return scene;
}

Scene read_scene(const FileRef& file) {
  namespace fs = std::filesystem;
  return parse_scene(read_file(file), file.name,
                     file.name == kStandardInput ? "" : fs::path(file.name).parent_path().string());
}

}  // namespace burnish
