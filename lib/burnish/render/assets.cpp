#include "burnish/render/assets.h"

#include <algorithm>
#include <cmath>

#include "burnish/brdf/tables/table_file.h"
#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/render/picture.h"

namespace burnish {
namespace {

// Reads the normals; what their file says of their space.
std::optional<NormalSpace> read_normal_map(const Object& object, ObjectAssets& assets) {
  NormalReader reader(object.normal_map, object.coding);
  assets.width = reader.width(), assets.height = reader.height();
  assets.normals = reader.read_all();
  assets.invalid_texels = reader.invalid_texels();
  return recorded_space(reader.image());
}

// What would be an option elsewhere is a key of the scene here.
IndexedMap read_map(const Scene& scene, const Object& object) {
  try {
    return read_indexed_map(object.indexed_map, object.coding.green, object.palette);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kUsage) throw;
    throw file_error(ErrorKind::kMalformed, scene.name, error.what());
  }
}

void dequantize(ObjectAssets& assets) {
  const IndexImage& base = assets.indexed->levels[0];
  assets.width = base.width, assets.height = base.height;
  assets.normals.reserve(base.texels());
  for (std::uint16_t index : base.data) assets.normals.push_back(assets.indexed->palette.normals[index]);
}

// Of both maps: as the scene says, otherwise as they do.
NormalSpace space_of(const Scene& scene, const Object& object, const ObjectAssets& assets,
                     std::optional<NormalSpace> recorded) {
  const auto scene_error = [&](const std::string& message) {
    return file_error(ErrorKind::kMalformed, scene.name, message);
  };
  if (const auto given = object.normal_space) {
    if (recorded && *recorded != *given)
      throw scene_error(std::string("expected normal_space = '") + name(*recorded) + "', as '" + object.normal_map +
                        "' says of itself, got '" + name(*given) + "'");
    return *given;
  }
  if (!assets.indexed) return recorded.value_or(NormalSpace::kTangent);
  const NormalSpace space = assets.indexed->palette.space;
  if (recorded && *recorded != space)
    throw scene_error("expected maps in one space, or 'normal_space' to say which, got '" + object.normal_map +
                      "' in " + name(*recorded) + " space and '" + object.indexed_map + "' in " + name(space) +
                      " space");
  return space;
}

std::shared_ptr<const MeshSurface> read_surface(const Object& object, std::size_t& dropped_faces) {
  MeshReadStats stats;
  Mesh mesh = read_mesh(object.mesh, &stats);
  dropped_faces = stats.dropped_faces;
  if (!object.normal_map.empty() || !object.indexed_map.empty() || !object.base.map.empty())
    require_uvs(mesh, "since the object has maps");
  if (object.reflectance) require_uvs(mesh, "which tell its reflectance the direction of the tangents");
  if (object.ptm) require_uvs(mesh, "which tell its polynomial texture map where it lies");
  return std::make_shared<const MeshSurface>(std::move(mesh), object.shading);
}

// Linear RGB, and alpha where that is asked for.
Image read_base_map(const BaseColour& base, bool with_alpha) {
  ImageReader reader(base.map);
  const Image stored = reader.read_level(0);
  const bool srgb = base.srgb.value_or(reader.integer());
  if (reader.channels() == 2)
    throw file_error(ErrorKind::kMalformed, base.map, "expected 1 channel, or 3 and more, got 2");
  if (with_alpha && reader.channels() < 4)
    throw file_error(ErrorKind::kMalformed, base.map,
                     "expected 4 channels, the last of which is gloss, got " + std::to_string(reader.channels()));
  Image out(stored.width, stored.height, with_alpha ? 4 : 3);
  for (std::size_t i = 0; i < out.texels(); i++) {
    const float* from = stored.data.data() + i * stored.channels;
    float* to = out.data.data() + i * out.channels;
    if (with_alpha) to[3] = from[3];
    for (int c = 0; c < 3; c++) {
      const float s = from[stored.channels >= 3 ? c : 0];
      if (!(s >= 0 && std::isfinite(s)))
        throw file_error(ErrorKind::kMalformed, base.map, "expected colours of at least 0, got " + number_text(s));
      if (srgb && s > 1)
        throw file_error(ErrorKind::kMalformed, base.map,
                         "expected sRGB colours of at most 1, got " + number_text(s) +
                             "; base_color_transfer = \"linear\" takes more");
      to[c] = srgb ? float(linear_from_srgb(s)) : s;
    }
  }
  return out;
}

void read_reflectance(const Object& object, ObjectAssets& assets) {
  const Reflectance& r = *object.reflectance;
  assets.reflectance = read_reflectance_maps(r);
  assets.invalid_texels = assets.reflectance->material.invalid_normal_texels;
  if (r.textures.empty()) return;
  assets.textures = read_material_textures(r.texture_file('t'), r.texture_file('b'), r.texture_file('n'));
  if (assets.textures->model != r.source.model)
    throw file_error(ErrorKind::kMalformed, r.texture_file('t'),
                     std::string("expected textures of the model ") + name(r.source.model) + ", got " +
                         name(assets.textures->model));
  if (object.mip != MipMode::kOff && assets.textures->t.levels.size() == 1 && assets.textures->width() > 1)
    throw file_error(ErrorKind::kMalformed, r.texture_file('t'),
                     "expected a chain of mip levels, as 'mip' asks for, got one level");
}

void read_tables(Scene& scene) {
  for (auto& [kind, table] : scene.tables) {
    const auto read = std::make_shared<const TableFile>(read_table(table.file));
    if (read->function.kind != kind)
      throw file_error(ErrorKind::kMalformed, table.file,
                       std::string("expected a table of ") + name(kind) + ", got one of " + name(read->function.kind));
    table.table = read;
  }
}

void read_panoramas(Scene& scene) {
  for (Material& material : scene.materials)
    for (LightingModel& term : material.terms)
      if (auto* environment = std::get_if<Environment>(&term))
        environment->panorama = Panorama::read(environment->file);
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
                     "materials have ids, and " + described(object) + " has no 'indexed_map' that tells them apart");
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

std::vector<ObjectAssets> load_assets(Scene& scene) {
  read_panoramas(scene);
  read_tables(scene);
  std::vector<ObjectAssets> out;
  for (const Object& object : scene.objects) {
    ObjectAssets assets;
    if (!object.mesh.empty()) assets.mesh = read_surface(object, assets.dropped_faces);
    if (!object.base.map.empty())
      assets.base_map = read_base_map(object.base, object.reflectance && object.reflectance->gloss);
    if (object.reflectance) {
      read_reflectance(object, assets);
      out.push_back(std::move(assets));
      continue;
    }
    if (object.ptm) {
      assets.ptm = load_ptm(*object.ptm);
      out.push_back(std::move(assets));
      continue;
    }
    if (!object.indexed_map.empty()) assets.indexed = read_map(scene, object);
    std::optional<NormalSpace> recorded;
    if (!object.normal_map.empty()) recorded = read_normal_map(object, assets);
    else if (assets.indexed) dequantize(assets);
    assets.space = space_of(scene, object, assets, recorded);
    assign_materials(scene, object, assets);
    out.push_back(std::move(assets));
  }
  return out;
}

}  // namespace burnish
