#include "burnish/render/assets.h"

#include <algorithm>

#include "burnish/core/error.h"

namespace burnish {
namespace {

void read_normal_map(const Object& object, ObjectAssets& assets) {
  NormalReader reader(object.normal_map, object.coding);
  assets.width = reader.width(), assets.height = reader.height();
  assets.normals.resize(std::size_t(assets.width) * assets.height);
  reader.read_rows(0, assets.height, assets.normals.data());
  assets.invalid_texels = reader.invalid_texels();
}

void dequantize(ObjectAssets& assets) {
  const IndexImage& base = assets.indexed->levels[0];
  assets.width = base.width, assets.height = base.height;
  assets.normals.reserve(base.texels());
  for (std::uint16_t index : base.data) assets.normals.push_back(assets.indexed->palette.normals[index]);
}

void assign_materials(const Scene& scene, const Object& object, ObjectAssets& assets) {
  if (!scene.materials[0].id) {
    assets.only_material = &scene.materials[0];
    if (assets.indexed)
      assets.interval_materials.assign(assets.indexed->palette.materials.size(), assets.only_material);
    return;
  }
  if (!assets.indexed)
    throw file_error(ErrorKind::kMalformed, scene.name,
                     "materials have ids, and the object with '" + object.normal_map +
                         "' has no 'indexed_map' that tells them apart");
  for (const MaterialInterval& interval : assets.indexed->palette.materials) {
    const auto found = std::ranges::find(scene.materials, std::optional(interval.id), &Material::id);
    if (found == scene.materials.end())
      throw file_error(ErrorKind::kMalformed, scene.name,
                       "expected a [[material]] with id = " + std::to_string(interval.id) + ", which '" +
                           object.indexed_map + "' uses, got none");
    assets.interval_materials.push_back(&*found);
  }
}

}  // namespace

std::vector<ObjectAssets> load_assets(const Scene& scene) {
  std::vector<ObjectAssets> out;
  for (const Object& object : scene.objects) {
    ObjectAssets assets;
    if (!object.indexed_map.empty()) {
      assets.indexed = read_indexed_map(object.indexed_map, object.coding.green);
      assets.space = assets.indexed->palette.space;
    }
    if (object.normal_space) assets.space = *object.normal_space;
    if (object.normal_map.empty()) dequantize(assets);
    else read_normal_map(object, assets);
    assign_materials(scene, object, assets);
    out.push_back(std::move(assets));
  }
  return out;
}

}  // namespace burnish
