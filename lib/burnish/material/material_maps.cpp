#include "burnish/material/material_maps.h"

#include <cmath>
#include <utility>

#include "burnish/material/directions/orthonormal_directions.h"

namespace burnish {
namespace {

SurfaceNormals read_normals(const MaterialSource& source, SharedSize& size) {
  if (source.normals.empty()) return {};
  SurfaceNormals normals = read_surface_normals(source.normals, source.normal_coding);
  size.take(normals.width, normals.height, source.normals.name);
  return normals;
}

DirectionMap read_directions(const MaterialSource& source, SharedSize& size) {
  if (source.directions.empty()) return {source.normals.name, 0, 0, {}, 0, {}};
  DirectionMap map = read_direction_map(source.directions, source.direction_coding);
  size.take(map.width, map.height, map.name);
  return map;
}

}  // namespace

MaterialMaps read_material_maps(const MaterialSource& source) {
  MaterialMaps maps;
  maps.model = source.model;
  SharedSize size;
  const auto read = [&](const char* name, const ParameterSource& from, bool zero_too) {
    Parameter parameter = read_parameter(name, from, size);
    const std::string above = zero_too ? "of at least 0" : "above 0";
    parameter.require([](float v) { return !std::isinf(v); }, "a finite number " + above);
    parameter.require([&](float v) { return v > 0 || (zero_too && v == 0); }, "a number " + above);
    return parameter;
  };
  if (source.model != MaterialModel::kBanks) {
    maps.alpha_x = read("alpha-x", source.alpha_x, false);
    maps.alpha_y = read("alpha-y", source.alpha_y, false);
  }
  maps.k_s = read("ks", source.k_s, true);
  if (source.model == MaterialModel::kBlinnPhong) maps.exponent = read("exponent", source.exponent, true);
  SurfaceNormals normals = read_normals(source, size);
  DirectionMap directions = read_directions(source, size);

  if (size.width) maps.width = size.width, maps.height = size.height;
  const std::size_t texels = std::size_t(maps.width) * maps.height;
  const auto everywhere = [&](auto& map, Vec3d vector) {
    if (!map.vectors.empty()) return;
    map.width = maps.width, map.height = maps.height;
    map.vectors.assign(texels, Vec3f(vector));
  };
  everywhere(normals, {0, 0, 1});
  everywhere(directions, {std::cos(source.angle_rad), std::sin(source.angle_rad), 0});
  maps.invalid_normal_texels = normals.invalid_texels;
  maps.degenerate_texels = orthonormalise(directions, &normals, false);
  maps.t = std::move(directions.vectors);
  maps.n = std::move(normals.vectors);
  return maps;
}

}  // namespace burnish
