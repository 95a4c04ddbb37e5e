#include "burnish/render/scene_materials.h"

#include <set>

namespace burnish {
namespace {

constexpr NumberRange kExponent{0, 1e6, "a number from 0 to 1000000"};

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
  m.file = t.file("map", directory);
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

}  // namespace

std::vector<Material> parse_materials(const TomlTable& root, const std::string& directory) {
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

}  // namespace burnish
