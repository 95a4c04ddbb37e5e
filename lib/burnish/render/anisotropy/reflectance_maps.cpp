#include "burnish/render/anisotropy/reflectance_maps.h"

#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/material/orthonormal_directions.h"
#include "burnish/material/shared_size.h"

namespace burnish {
namespace {

FieldMap read_field(const MapOrNumber& field, bool above_zero, SharedSize& size) {
  FieldMap out{field.number, {}};
  if (field.map.empty()) return out;
  const Image image = read_image(field.map);
  size.take(image.width, image.height, field.map);
  for (std::size_t i = 0; i < image.texels(); i++) {
    const float v = image.data[i * image.channels];
    if (!(std::isfinite(v) && (above_zero ? v > 0 : v >= 0)))
      throw file_error(ErrorKind::kMalformed, field.map,
                       std::string("expected values ") + (above_zero ? "above 0" : "of at least 0") + ", got " +
                           number_text(v) + " at column " + std::to_string(i % image.width) + ", row " +
                           std::to_string(i / image.width));
    out.texels.push_back(v);
  }
  return out;
}

}  // namespace

ReflectanceMaps read_reflectance_maps(const Reflectance& r, const std::string& normal_map, const NormalCoding& coding) {
  ReflectanceMaps out;
  SharedSize size;
  SurfaceNormals normals;
  if (!normal_map.empty()) {
    normals = read_surface_normals(normal_map, coding);
    size.take(normals.width, normals.height, normal_map);
    out.invalid_normals = normals.invalid_texels;
  }
  out.alpha_x = read_field(r.alpha_x, true, size);
  out.alpha_y = read_field(r.alpha_y, true, size);
  out.k_s = read_field(r.k_s, false, size);
  out.exponent = read_field(r.exponent, true, size);
  out.direction = Vec3f{float(std::cos(r.angle_rad)), float(std::sin(r.angle_rad)), 0};
  if (!r.direction_map.empty()) {
    DirectionMap map = read_direction_map(r.direction_map, {DirectionForm::kVector, coding.green});
    size.take(map.width, map.height, r.direction_map);
    out.directions = map.vectors;
    for (Vec3f& t : out.directions) t = length(t) > 0 ? normalized(t) : t;
    orthonormalise(map, normals.vectors.empty() ? nullptr : &normals, false);
    out.tangents = std::move(map.vectors);
  }
  out.normals = std::move(normals.vectors);
  if (size.width) out.width = size.width, out.height = size.height;
  return out;
}

}  // namespace burnish
