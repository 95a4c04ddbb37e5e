#include "burnish/render/anisotropy/scene_reflectance.h"

#include "burnish/core/error.h"

namespace burnish {
namespace {

constexpr NumberRange kExponent{0, 1e6, "a number from 0 to 1000000"},
    kStrandExponent{kAboveZero, 1e6, "a number above 0, up to 1000000"};

// A number, or the file of a map.
void read_parameter(const TomlTable& t, const std::string& key, const std::string& directory, const NumberRange& range,
                    ParameterSource& out) {
  if (t.is_text(key)) out.map = t.file(key, directory);
  else out.number = float(t.number(key, range, double(out.number)));
}

MaterialModel textures_of(ReflectanceModel model) {
  switch (model) {
    case ReflectanceModel::kBlinnPhong:
    case ReflectanceModel::kBlinnPhongEquation1:
      return MaterialModel::kBlinnPhong;
    case ReflectanceModel::kWard:
      return MaterialModel::kWard;
    default:
      return MaterialModel::kBanks;
  }
}

}  // namespace

std::vector<std::string> Reflectance::files() const {
  std::vector<std::string> out;
  for (const FileRef& file :
       {source.alpha_x.map, source.alpha_y.map, source.k_s.map, source.exponent.map, source.directions})
    if (!file.empty()) out.push_back(file.name);
  if (!textures.empty())
    for (const char which : {'t', 'b', 'n'}) out.push_back(texture_file(which));
  return out;
}

std::string Reflectance::texture_file(char which) const {
  try {
    return material_file(textures, which);
  } catch (const Error& error) {  // what would be an option elsewhere is a key of the scene here
    if (error.kind() != ErrorKind::kUsage) throw;
    throw Error(ErrorKind::kMalformed, error.what());
  }
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
  MaterialSource& source = r.source;
  source.model = textures_of(r.model);
  if (r.is_strand()) {
    r.strand_exponent = t.number("exponent", kStrandExponent, r.strand_exponent);
    r.gloss = t.choice<bool>("gloss", {{"none", false}, {"base-alpha", true}}, r.gloss);
  } else {
    const auto parameter = [&](const std::string& key, const NumberRange& range, ParameterSource& out) {
      read_parameter(t, key, directory, range, out);
    };
    source.alpha_x.number = source.alpha_y.number = 0.2f;
    parameter("ks", kNotNegative, source.k_s);
    if (source.model != MaterialModel::kBanks) {
      parameter("alpha_x", kPositive, source.alpha_x);
      parameter("alpha_y", kPositive, source.alpha_y);
    }
    if (r.model == ReflectanceModel::kBlinnPhong) parameter("exponent", kExponent, source.exponent);
    r.textures = t.file("textures", directory);
  }
  const std::string directions = t.file("direction_map", directory);
  if (!directions.empty()) source.directions = directions;
  else source.angle_rad = radians(t.number("angle_deg", kAnyNumber, 0.0));
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
        std::pair("strand", LookupKind::kStrand), std::pair("light_factor", LookupKind::kLightFactor)}) {
    const std::string file = t.file(key, directory);
    if (!file.empty()) tables[kind] = {file, nullptr};
  }
  t.refuse_unknown();
  return tables;
}

}  // namespace burnish
