// What an object reflects by, where it is one of Kautz & Seidel's models or Isidoro & Brennan's strands: its [object.
// reflectance] in a scene.
//
// The analytic path evaluates the formula from the parameters and maps; the other paths from the files that were baked
// of them. Light that reaches a point, per light of colour c:
//
//   c · (diffuse · base · (n·l)⁺ + specular · L_o)                      the three models
//   c · (diffuse · base · √(1−(l·t)²) + specular · gloss · (V·R')ⁿ)     strands
#pragma once

#include <map>
#include <memory>
#include <string>

#include "burnish/brdf/tables/table_file.h"
#include "burnish/core/vec3.h"
#include "burnish/material/material_maps.h"

namespace burnish {

enum class ReflectanceModel { kBanks, kBanksApproximate, kBlinnPhong, kBlinnPhongEquation1, kWard, kStrand };

// Where a lookup falls between texels: these are interpolated and then shaded with, as hardware does, or each is shaded
// and the results are interpolated (Kautz & Seidel, section 5.1).
enum class FilterOrder { kBeforeShading, kAfterShading };

struct Reflectance {
  ReflectanceModel model = ReflectanceModel::kWard;
  Vec3d diffuse{1, 1, 1}, specular{0.5, 0.5, 0.5}, ambient{1, 1, 1};
  MaterialSource source;        // of strands: the direction and the normals
  double strand_exponent = 16;  // of the formula; paths have it in their table
  std::string textures;         // prefix of the material textures; empty: none
  bool gloss = false;           // strands: the alpha of the base colour's map weighs the specular part
  FilterOrder order = FilterOrder::kBeforeShading;

  bool is_strand() const { return model == ReflectanceModel::kStrand; }
  // All that it names, but for the normals.
  std::vector<std::string> files() const;
  // The file of a material texture, t, b or n. kIo where there is none, kMalformed where there are several.
  std::string texture_file(char which) const;
};

// The lookup tables of a scene, by what they hold.
struct SceneTable {
  std::string file;
  std::shared_ptr<const TableFile> table;  // once the scene's assets are loaded
};
using SceneTables = std::map<LookupKind, SceneTable>;

}  // namespace burnish
