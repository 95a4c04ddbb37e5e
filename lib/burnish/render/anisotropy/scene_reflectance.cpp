#include "burnish/render/anisotropy/scene_reflectance.h"

namespace burnish {
namespace {

constexpr NumberRange kExponent{kAboveZero, 1e6, "a number above 0, up to 1000000"};

MapOrNumber map_or_number(const TomlTable& t, const std::string& key, const std::string& directory,
                          const NumberRange& range, double fallback) {
  if (t.is_text(key)) return {fallback, t.file(key, directory)};
  return {t.number(key, range, fallback), {}};
}

}  // namespace

MaterialModel Reflectance::material_model() const {
  switch (model) {
    case ReflectanceModel::kBanks:
    case ReflectanceModel::kBanksApproximate:
      return MaterialModel::kBanks;
    case ReflectanceModel::kBlinnPhong:
    case ReflectanceModel::kBlinnPhongEquation1:
      return MaterialModel::kBlinnPhong;
    case ReflectanceModel::kWard:
    case ReflectanceModel::kStrand:
      break;
  }
  return MaterialModel::kWard;
}

std::vector<std::string> Reflectance::files() const {
  std::vector<std::string> out;
  for (const std::string& file : {alpha_x.map, alpha_y.map, k_s.map, exponent.map, direction_map})
    if (!file.empty()) out.push_back(file);
  if (!textures.empty())
    for (const char which : {'t', 'b', 'n'}) out.push_back(material_file(textures, which));
  return out;
}

Reflectance parse_reflectance(const TomlTable& t, const std::string& directory) {
  Reflectance r;
  r.model = t.choice<ReflectanceModel>("model", {{"banks", ReflectanceModel::kBanks},
                                                 {"banks-approximate", ReflectanceModel::kBanksApproximate},
                                                 {"blinn-phong", ReflectanceModel::kBlinnPhong},
                                                 {"blinn-phong-eq1", ReflectanceModel::kBlinnPhongEquation1},
                                                 {"ward", ReflectanceModel::kWard},
                                                 {"strand", ReflectanceModel::kStrand}});
  r.diffuse = t.vector("diffuse", kNotNegative, r.diffuse);
  r.specular = t.vector("specular", kNotNegative, r.specular);
  r.ambient = t.vector("ambient", kNotNegative, r.diffuse);
  const auto field = [&](const std::string& key, const NumberRange& range, MapOrNumber& value) {
    value = map_or_number(t, key, directory, range, value.number);
  };
  const MaterialModel textures = r.material_model();
  if (r.is_strand()) {
    r.exponent.number = t.number("exponent", kExponent, 16);
    if (t.has("gloss")) r.gloss = t.choice<bool>("gloss", {{"none", false}, {"base-alpha", true}});
  } else {
    field("ks", kNotNegative, r.k_s);
    r.textures = t.file("textures", directory);
    if (textures != MaterialModel::kBanks) {
      field("alpha_x", kPositive, r.alpha_x);
      field("alpha_y", kPositive, r.alpha_y);
    }
    if (r.model == ReflectanceModel::kBlinnPhong) field("exponent", kExponent, r.exponent);
  }
  r.direction_map = t.file("direction_map", directory);
  if (r.direction_map.empty()) r.angle_rad = radians(t.number("angle_deg", kAnyNumber, 0.0));
  r.order = t.choice<FilterOrder>(
      "filter_order", {{"before", FilterOrder::kBeforeShading}, {"after", FilterOrder::kAfterShading}}, r.order);
  t.refuse_unknown();
  return r;
}

SceneTables parse_tables(const TomlTable& t, const std::string& directory) {
  SceneTables tables;
  for (const auto& [key, kind] :
       {std::pair("banks_r", LookupKind::kBanksR), std::pair("blinn_phong_f", LookupKind::kBlinnPhongF),
        std::pair("ward_s", LookupKind::kWardS), std::pair("ward_e", LookupKind::kWardE),
        std::pair("strand", LookupKind::kStrand)}) {
    const std::string file = t.file(key, directory);
    if (!file.empty()) tables[kind] = {file, nullptr};
  }
  t.refuse_unknown();
  return tables;
}

}  // namespace burnish
