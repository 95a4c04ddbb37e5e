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
  s.type = t.choice<SurfaceType>(
      "surface", {{"quad", SurfaceType::kQuad}, {"sphere", SurfaceType::kSphere}, {"mesh", SurfaceType::kMesh}},
      s.type);
  if (s.type == SurfaceType::kMesh) return s;
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

// One number for all axes, or one each.
Vec3d scale(const TomlTable& t) {
  if (t.has_array("scale")) return t.vector("scale", kPositive);
  const double s = t.number("scale", kPositive, 1.0);
  return {s, s, s};
}

BaseColour base_colour(const TomlTable& t, const std::string& directory) {
  BaseColour base;
  const bool given = t.has("base_color") || t.has("base_color_map");
  base.colour = t.vector("base_color", kNotNegative, base.colour);
  base.map = map_path(t, "base_color_map", directory);
  if (!base.map.empty() && t.has("base_color_transfer"))
    base.srgb = t.choice<bool>("base_color_transfer", {{"srgb", true}, {"linear", false}});
  base.blend = t.choice<Blend>(
      "blend", {{"exact", Blend::kExact}, {"approximate", Blend::kApproximate}, {"material", Blend::kMaterial}},
      given ? Blend::kExact : Blend::kMaterial);
  if (given && base.blend == Blend::kMaterial)
    t.fail("blend", "expected exact or approximate, since material takes no base colour, got 'material'");
  return base;
}

Object object(const TomlTable& t, const std::string& directory) {
  Object o;
  o.surface = surface(t);
  o.transform.translation = t.vector("translate", kAnyNumber, Vec3d{});
  const Vec3d turn_deg = t.vector("rotate_deg", kAnyNumber, Vec3d{});
  o.transform.rotation = rotation_xyz({radians(turn_deg.x), radians(turn_deg.y), radians(turn_deg.z)});
  o.transform.scale = scale(t);
  if (o.surface.type == SurfaceType::kMesh) {
    o.mesh = map_path(t, "mesh", directory);
    if (o.mesh.empty()) t.fail("mesh", "expected the mesh's file name, got nothing");
    o.shading =
        t.choice<MeshShading>("shading", {{"smooth", MeshShading::kSmooth}, {"flat", MeshShading::kFlat}}, o.shading);
  }
  o.normal_map = map_path(t, "normal_map", directory);
  o.indexed_map = map_path(t, "indexed_map", directory);
  if (!o.indexed_map.empty()) o.palette = map_path(t, "palette", directory);
  if (o.indexed_map.ends_with(".dds") && o.palette.empty())
    t.fail("palette", "expected the file of the palette, which a DDS does not hold, got nothing");
  o.base = base_colour(t, directory);
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

template <typename Model>
Model glossy(const TomlTable& t, const Lambert& lambert) {
  Model m;
  m.ambient = lambert.ambient, m.diffuse = lambert.diffuse;
  m.specular = t.vector("specular", kNotNegative, m.specular);
  m.exponent = t.number("exponent", kExponent, m.exponent);
  return m;
}

Lambert lambert(const TomlTable& t) {
  Lambert m;
  m.diffuse = t.vector("diffuse", kNotNegative, m.diffuse);
  m.ambient = t.vector("ambient", kNotNegative, m.diffuse);
  return m;
}

Cartoon cartoon(const TomlTable& t) {
  Cartoon m;
  m.diffuse = t.vector("diffuse", kNotNegative, m.diffuse);
  m.shadow = t.vector("shadow", kNotNegative, m.diffuse * 0.3);
  m.bands = t.integer("bands", 2, 256, m.bands);
  m.outline = t.vector("outline", kNotNegative, m.outline);
  m.outline_cosine = t.number("outline_cosine", {0, 1, "a cosine from 0 to 1"}, m.outline_cosine);
  return m;
}

Chrome chrome(const TomlTable& t) {
  Chrome m;
  m.specular = t.vector("specular", kNotNegative, m.specular);
  m.sky = t.vector("sky", kNotNegative, m.sky);
  m.horizon = t.vector("horizon", kNotNegative, m.horizon);
  m.ground = t.vector("ground", kNotNegative, m.ground);
  m.nadir = t.vector("nadir", kNotNegative, m.nadir);
  return m;
}

Environment environment(const TomlTable& t, const std::string& directory) {
  Environment m;
  m.file = map_path(t, "map", directory);
  if (m.file.empty()) t.fail("map", "expected the panorama's file name, got nothing");
  m.specular = t.vector("specular", kNotNegative, m.specular);
  m.turn_rad = radians(t.number("turn_deg", kAnyNumber, 0.0));
  return m;
}

LightingModel lighting_model(const TomlTable& t, const std::string& directory) {
  enum class Model { kLambert, kPhong, kNprDouble, kCartoon, kChrome, kEnvironment };
  switch (t.choice<Model>("model",
                          {{"lambert", Model::kLambert},
                           {"phong", Model::kPhong},
                           {"npr-double", Model::kNprDouble},
                           {"cartoon", Model::kCartoon},
                           {"chrome", Model::kChrome},
                           {"environment", Model::kEnvironment}},
                          Model::kLambert)) {
    case Model::kPhong:
      return glossy<Phong>(t, lambert(t));
    case Model::kNprDouble:
      return glossy<NprDouble>(t, lambert(t));
    case Model::kCartoon:
      return cartoon(t);
    case Model::kChrome:
      return chrome(t);
    case Model::kEnvironment:
      return environment(t, directory);
    case Model::kLambert:
      break;
  }
  return lambert(t);
}

// One model with its keys, or a sum of them, a [[material.term]] each.
Material material(const TomlTable& t, const std::string& directory) {
  Material m;
  if (t.has("id")) m.id = t.integer("id", 0, 255);
  m.terms.clear();
  for (const TomlTable& term : t.tables("term")) {
    m.terms.push_back(lighting_model(term, directory));
    term.refuse_unknown();
  }
  if (m.terms.empty()) m.terms.push_back(lighting_model(t, directory));
  t.refuse_unknown();
  return m;
}

std::vector<Material> materials(const TomlTable& root, const std::string& directory) {
  std::vector<Material> out;
  std::set<int> ids;
  const std::vector<TomlTable> blocks = root.tables("material");
  for (const TomlTable& t : blocks) {
    out.push_back(material(t, directory));
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

const char* name(RenderPath path) {
  switch (path) {
    case RenderPath::kPalette:
      return "palette";
    case RenderPath::kPaletteExpanded:
      return "palette-expanded";
    case RenderPath::kAnalytic:
      break;
  }
  return "analytic";
}

RenderPath render_path(const std::string& name, ErrorKind unknown) {
  static const std::set<std::string> kLater{
      "banks",       "banks-approximate", "blinn-phong", "blinn-phong-eq1",          "ward", "combiner", "imaging",
      "strand-ps11", "strand-ps14",       "strand-bump", "strand-bump-unnormalised", "ptm",  "ptm-brdf"};
  for (RenderPath path : {RenderPath::kAnalytic, RenderPath::kPalette, RenderPath::kPaletteExpanded})
    if (name == burnish::name(path)) return path;
  if (kLater.contains(name))
    throw Error(ErrorKind::kUnsupported,
                "path '" + name + "' is not there yet; there are analytic, palette and palette-expanded");
  throw Error(unknown, "expected a path, analytic, palette or palette-expanded, got '" + name + "'");
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
  scene.materials = materials(root, directory);
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
