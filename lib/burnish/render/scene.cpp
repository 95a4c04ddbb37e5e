#include "burnish/render/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "burnish/render/toml_file.h"

namespace burnish {
namespace {

constexpr NumberRange kFovDeg{kAboveZero, 179.999, "an angle above 0 and below 180"};
constexpr NumberRange kExposure{-64, 64, "a number of stops from -64 to 64"};
constexpr NumberRange kExponent{0, 1e6, "a number from 0 to 1000000"};
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

Surface surface(const TomlTable& t) {
  Surface s;
  s.type = t.choice<SurfaceType>("surface", {{"quad", SurfaceType::kQuad}, {"sphere", SurfaceType::kSphere}}, s.type);
  if (s.type == SurfaceType::kSphere) {
    s.radius = t.number("radius", kPositive, s.radius);
    return s;
  }
  if (t.has("size")) {
    const std::vector<double> size = t.numbers("size", 2, kPositive);
    s.size_x = size[0], s.size_y = size[1];
  }
  if (t.has("repeat")) {
    const std::vector<double> repeat = t.numbers("repeat", 2, kPositive);
    s.repeat_u = repeat[0], s.repeat_v = repeat[1];
  }
  return s;
}

std::string map_path(const TomlTable& t, const std::string& key, const std::string& directory) {
  if (!t.has(key)) return {};
  const std::string path = t.text(key);
  if (path.empty()) t.fail(key, "expected a file name, got ''");
  return (std::filesystem::path(directory) / path).string();
}

Object object(const TomlTable& t, const std::string& directory) {
  Object o;
  o.surface = surface(t);
  o.transform.translation = t.vector("translate", kAnyNumber, Vec3d{});
  const Vec3d turn_deg = t.vector("rotate_deg", kAnyNumber, Vec3d{});
  o.transform.rotation = rotation_xyz({radians(turn_deg.x), radians(turn_deg.y), radians(turn_deg.z)});
  o.normal_map = map_path(t, "normal_map", directory);
  o.indexed_map = map_path(t, "indexed_map", directory);
  if (o.normal_map.empty() && o.indexed_map.empty())
    t.fail("normal_map", "expected a file name here or in 'indexed_map', got nothing");
  if (t.has("normal_space"))
    o.normal_space =
        t.choice<NormalSpace>("normal_space", {{"tangent", NormalSpace::kTangent}, {"object", NormalSpace::kObject}});
  o.coding.green = t.choice<GreenAxis>("y", {{"up", GreenAxis::kUp}, {"down", GreenAxis::kDown}}, o.coding.green);
  if (!o.normal_map.empty()) {
    if (t.has("encoding"))
      o.coding.encoding = t.choice<NormalEncoding>(
          "encoding", {{"biased", NormalEncoding::kBiased}, {"signed", NormalEncoding::kSigned}});
    o.coding.channels = t.text("channels", "");
    const auto& letters = o.coding.channels;
    if (t.has("channels") && ((letters.size() != 2 && letters.size() != 3) ||
                              letters.find_first_not_of("xyzwrgbaXYZWRGBA") != std::string::npos))
      t.fail("channels", "expected two or three letters of x y z w or r g b a, got '" + letters + "'");
  }
  if (!o.indexed_map.empty()) {
    o.filter = t.choice<Filter>("filter", {{"nearest", Filter::kNearest}, {"bilinear", Filter::kBilinear}}, o.filter);
    o.mip = t.choice<MipMode>(
        "mip", {{"off", MipMode::kOff}, {"nearest", MipMode::kNearest}, {"linear", MipMode::kLinear}}, o.mip);
  }
  t.refuse_unknown();
  return o;
}

Material material(const TomlTable& t) {
  enum class Model { kLambert, kPhong };
  Material m;
  if (t.has("id")) m.id = t.integer("id", 0, 255);
  const Model model =
      t.choice<Model>("model", {{"lambert", Model::kLambert}, {"phong", Model::kPhong}}, Model::kLambert);
  const Vec3d diffuse = t.vector("diffuse", kNotNegative, Vec3d{1, 1, 1});
  const Vec3d ambient = t.vector("ambient", kNotNegative, diffuse);
  if (model == Model::kLambert) {
    m.model = Lambert{ambient, diffuse};
  } else {
    Phong phong;
    phong.ambient = ambient, phong.diffuse = diffuse;
    phong.specular = t.vector("specular", kNotNegative, phong.specular);
    phong.exponent = t.number("exponent", kExponent, phong.exponent);
    m.model = phong;
  }
  t.refuse_unknown();
  return m;
}

std::vector<Material> materials(const TomlTable& root) {
  std::vector<Material> out;
  std::set<int> ids;
  const std::vector<TomlTable> blocks = root.tables("material");
  for (const TomlTable& t : blocks) {
    out.push_back(material(t));
    if (!out.back().id && blocks.size() > 1)
      t.fail("id", "expected an id from 0 to 255 in each of several materials, got none");
    if (out.back().id && !ids.insert(*out.back().id).second)
      t.fail("id", "expected ids that differ, got " + std::to_string(*out.back().id) + " twice");
  }
  if (out.empty()) out.push_back({});
  return out;
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

}  // namespace

const char* name(RenderPath path) { return path == RenderPath::kAnalytic ? "analytic" : "palette"; }

RenderPath render_path(const std::string& name, ErrorKind unknown) {
  static const std::set<std::string> kLater{"palette-expanded",
                                            "banks",
                                            "banks-approximate",
                                            "blinn-phong",
                                            "blinn-phong-eq1",
                                            "ward",
                                            "combiner",
                                            "imaging",
                                            "strand-ps11",
                                            "strand-ps14",
                                            "strand-bump",
                                            "strand-bump-unnormalised",
                                            "ptm",
                                            "ptm-brdf"};
  for (RenderPath path : {RenderPath::kAnalytic, RenderPath::kPalette})
    if (name == burnish::name(path)) return path;
  if (kLater.contains(name))
    throw Error(ErrorKind::kUnsupported, "path '" + name + "' is not there yet; there are analytic and palette");
  throw Error(unknown, "expected a path, analytic or palette, got '" + name + "'");
}

std::vector<std::string> Scene::files() const {
  std::vector<std::string> out;
  for (const Object& o : objects)
    for (const std::string& file : {o.normal_map, o.indexed_map})
      if (!file.empty() && std::ranges::find(out, file) == out.end()) out.push_back(file);
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
      if (error.kind() == ErrorKind::kUnsupported) throw file_error(error.kind(), name, error.what());
      root.fail("path", error.what());
    }
  }
  scene.samples = root.integer("samples", 1, kMostSamples, scene.samples);
  scene.image = image_settings(root.table("image"));
  scene.camera = camera_settings(root.table("camera"));
  scene.ambient = root.vector("ambient", kNotNegative, scene.ambient);
  for (const TomlTable& t : root.tables("light")) scene.lights.push_back(light(t));
  scene.turn_axis = unit_vector(root, "turn_axis", scene.camera.up);
  for (const TomlTable& t : root.tables("object")) scene.objects.push_back(object(t, directory));
  if (scene.objects.empty()) root.fail("object", "expected at least one [[object]], got none");
  scene.materials = materials(root);
  scene.validation = validation(root.table("validate"));
  root.refuse_unknown();
  return scene;
}

Scene read_scene(const FileRef& file) {
  namespace fs = std::filesystem;
  require_readable(file);
  std::ifstream in(file.path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
  return parse_scene(text, file.name, file.name == kStandardInput ? "" : fs::path(file.name).parent_path().string());
}

}  // namespace burnish
