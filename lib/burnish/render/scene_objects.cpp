#include "burnish/render/scene_objects.h"

#include "burnish/core/number_text.h"
#include "burnish/render/anisotropy/scene_reflectance.h"

namespace burnish {
namespace {

Surface surface(const TomlTable& t) {
  Surface s;
  s.type = t.choice<SurfaceType>("surface",
                                 {{"quad", SurfaceType::kQuad},
                                  {"sphere", SurfaceType::kSphere},
                                  {"torus", SurfaceType::kTorus},
                                  {"mesh", SurfaceType::kMesh}},
                                 s.type);
  if (s.type == SurfaceType::kMesh) return s;
  if (s.type == SurfaceType::kSphere) {
    s.radius = t.number("radius", kPositive, s.radius);
    return s;
  }
  if (s.type == SurfaceType::kTorus) {
    s.radius = t.number("radius", kPositive, 0.35);
    s.tube_radius = t.number("tube_radius", kPositive, s.tube_radius);
    if (!(s.tube_radius < s.radius))
      t.fail("tube_radius", "expected less than the ring's 'radius', " + number_text(s.radius));
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
  base.map = t.file("base_color_map", directory);
  if (!base.map.empty() && t.has("base_color_transfer"))
    base.srgb = t.choice<bool>("base_color_transfer", {{"srgb", true}, {"linear", false}});
  base.blend = t.choice<Blend>(
      "blend", {{"exact", Blend::kExact}, {"approximate", Blend::kApproximate}, {"material", Blend::kMaterial}},
      given ? Blend::kExact : Blend::kMaterial);
  if (given && base.blend == Blend::kMaterial)
    t.fail("blend", "expected exact or approximate, since material takes no base colour, got 'material'");
  return base;
}

}  // namespace

Object parse_object(const TomlTable& t, const std::string& directory) {
  Object o;
  o.surface = surface(t);
  o.transform.translation = t.vector("translate", kAnyNumber, Vec3d{});
  const Vec3d turn_deg = t.vector("rotate_deg", kAnyNumber, Vec3d{});
  o.transform.rotation = rotation_xyz({radians(turn_deg.x), radians(turn_deg.y), radians(turn_deg.z)});
  o.transform.scale = scale(t);
  if (o.surface.type == SurfaceType::kMesh) {
    o.mesh = t.file("mesh", directory);
    if (o.mesh.empty()) t.fail("mesh", "expected the mesh's file name, got nothing");
    o.shading =
        t.choice<MeshShading>("shading", {{"smooth", MeshShading::kSmooth}, {"flat", MeshShading::kFlat}}, o.shading);
  }
  o.normal_map = t.file("normal_map", directory);
  o.indexed_map = t.file("indexed_map", directory);
  if (!o.indexed_map.empty()) o.palette = t.file("palette", directory);
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
  if (t.has("reflectance")) {
    if (o.normal_space == NormalSpace::kObject)
      t.fail("normal_space", "expected tangent beside [object.reflectance], got object");
    if (t.has("blend"))
      t.fail("blend", "expected no blending beside [object.reflectance], which the base colour is part of");
    if (!o.indexed_map.empty()) t.fail("indexed_map", "expected no indexed map beside [object.reflectance]");
    o.reflectance = parse_reflectance(t.table("reflectance"), directory);
    o.reflectance->source.normals = o.normal_map;
    o.reflectance->source.normal_coding = o.coding;
    o.reflectance->source.direction_coding.green = o.coding.green;
    if (o.reflectance->gloss && o.base.map.empty())
      t.fail("base_color_map", "expected a map, whose alpha is the gloss that [object.reflectance] asks for, got none");
  }
  if (t.has("ptm")) {
    for (const char* key : {"reflectance", "normal_map", "indexed_map", "base_color", "base_color_map", "blend"})
      if (t.has(key)) t.fail(key, "expected none beside [object.ptm]");
    o.ptm = parse_ptm(t.table("ptm"), directory);
  }
  if (o.ptm && !o.ptm->is_brdf())
    o.filter = t.choice<Filter>("filter", {{"nearest", Filter::kNearest}, {"bilinear", Filter::kBilinear}}, o.filter);
  if (!o.indexed_map.empty() || o.reflectance) {
    o.filter = t.choice<Filter>("filter", {{"nearest", Filter::kNearest}, {"bilinear", Filter::kBilinear}}, o.filter);
    o.mip = t.choice<MipMode>(
        "mip", {{"off", MipMode::kOff}, {"nearest", MipMode::kNearest}, {"linear", MipMode::kLinear}}, o.mip);
    if (o.mip != MipMode::kOff && o.reflectance && o.reflectance->is_strand())
      t.fail("mip", "expected off, since direction maps have one level");
  }
  t.refuse_unknown();
  return o;
}

}  // namespace burnish
