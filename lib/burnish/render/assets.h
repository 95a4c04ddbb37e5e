// What a scene's files hold, in memory: for each object its mesh, its normals, its indexed map, which material serves
// which texel, and its base colour.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "burnish/palette/indexed_map.h"
#include "burnish/render/anisotropy/reflectance_maps.h"
#include "burnish/render/ptm/ptm_assets.h"
#include "burnish/render/scene.h"

namespace burnish {

struct ObjectAssets {
  std::shared_ptr<const MeshSurface> mesh;  // null for other surfaces
  std::size_t dropped_faces = 0;            // of the mesh; they have no area
  std::optional<Image> base_map;            // of the base colour: linear RGB, and alpha where gloss is asked for

  // The unquantized normal map; where the object has none, the indexed map's base level through its palette; empty
  // where it has neither.
  int width = 0, height = 0;
  std::vector<Vec3f> normals;
  NormalSpace space = NormalSpace::kTangent;
  std::size_t invalid_texels = 0;  // of the normal map; they became (0,0,1)

  std::optional<ReflectanceMaps> reflectance;  // where the object has one; it holds the normals then
  std::optional<MaterialTextures> textures;

  std::optional<PtmAssets> ptm;

  std::optional<IndexedMap> indexed;
  std::vector<const Material*> interval_materials;  // of each interval of the palette; into Scene::materials
  const Material* only_material = nullptr;          // serves all texels; null where intervals decide
};

// One entry an object; environment maps go into the scene's materials. The scene must outlive the result.
// Errors: of the files; kMalformed where an interval's id has no material, where materials have ids and no indexed map
// tells them apart, where a mesh has maps and no texture coordinates, or where a normal map says that it is in another
// space than the scene says, or than the indexed map where the scene says nothing.
std::vector<ObjectAssets> load_assets(Scene& scene);

}  // namespace burnish
