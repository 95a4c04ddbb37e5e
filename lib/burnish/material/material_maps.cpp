#include "burnish/material/material_maps.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "burnish/core/portable_math.h"

namespace burnish {
namespace {

void require_parameter(const Parameter& parameter, bool zero_too) {
  const std::string above = zero_too ? "of at least 0" : "above 0";
  parameter.require([](float v) { return !std::isinf(v); }, "a finite number " + above);
  parameter.require([&](float v) { return v > 0 || (zero_too && v == 0); }, "a number " + above);
}

}  // namespace

MaterialReader::MaterialReader(const MaterialSource& source) : source_(source) {
  if (source.model != MaterialModel::kBanks) {
    open(alpha_x_, "alpha-x", source.alpha_x, false);
    open(alpha_y_, "alpha-y", source.alpha_y, false);
  }
  open(k_s_, "ks", source.k_s, true);
  if (source.model == MaterialModel::kBlinnPhong) open(exponent_, "exponent", source.exponent, true);
  if (!source.normals.empty()) {
    normals_.emplace(source.normals, source.normal_coding);
    size_.take(normals_->width(), normals_->height(), source.normals.name);
  }
  if (!source.directions.empty()) {
    directions_.emplace(source.directions, source.direction_coding);
    size_.take(directions_->width(), directions_->height(), source.directions.name);
  }
  if (size_.width == 0) size_ = {1, 1, ""};
}

void MaterialReader::open(Entry& entry, const char* name, const ParameterSource& from, bool zero_too) {
  entry.reader.emplace(name, from, size_);
  entry.zero_too = zero_too;
}

bool MaterialReader::has_parameter_maps() const {
  const auto is_map = [](const Entry& of) { return of.reader && of.reader->is_map(); };
  return is_map(alpha_x_) || is_map(alpha_y_) || is_map(k_s_) || is_map(exponent_);
}

MaterialMaps MaterialReader::parameters(int first, int count) {
  MaterialMaps rows;
  rows.model = source_.model;
  rows.width = width(), rows.height = count;
  const auto read = [&](Entry& from, Parameter& to) {
    if (!from.reader) return;
    to = from.reader->rows(first, count);
    require_parameter(to, from.zero_too);
  };
  read(alpha_x_, rows.alpha_x), read(alpha_y_, rows.alpha_y), read(k_s_, rows.k_s), read(exponent_, rows.exponent);
  return rows;
}

std::size_t MaterialReader::frames(const std::string& directory,
                                   const std::function<void(int first, MaterialMaps& rows)>& take) {
  const Vec3f along(Vec3d{portable::cos(source_.angle_rad), portable::sin(source_.angle_rad), 0});
  const auto read = [&](int first, int count) {
    const std::size_t texels = std::size_t(width()) * count;
    DirectionBand band;
    if (directions_) band.map = directions_->rows(first, count);
    else band.map = {source_.normals.name, width(), count, std::vector<Vec3f>(texels, along), 0, {}};
    if (normals_) band.normals = normals_->rows(first, count);
    else band.normals = {width(), count, std::vector<Vec3f>(texels, {0, 0, 1}), 0, 0};
    return band;
  };
  int first = 0;
  return orthonormal_bands(width(), height(), false, directory, read, [&](DirectionBand& band) {
    MaterialMaps rows;
    rows.model = source_.model;
    rows.width = width(), rows.height = band.map.height;
    rows.t = std::move(band.map.vectors);
    rows.n = std::move(band.normals->vectors);
    rows.invalid_normal_texels = band.normals->invalid_texels;
    take(first, rows);
    first += rows.height;
  });
}

MaterialMaps read_material_maps(const MaterialSource& source) {
  MaterialReader reader(source);
  MaterialMaps maps = reader.parameters(0, reader.height());
  const std::string directory = std::filesystem::temp_directory_path().string();
  maps.degenerate_texels = reader.frames(directory, [&](int, const MaterialMaps& rows) {
    maps.t.insert(maps.t.end(), rows.t.begin(), rows.t.end());
    maps.n.insert(maps.n.end(), rows.n.begin(), rows.n.end());
    maps.invalid_normal_texels += rows.invalid_normal_texels;
  });
  return maps;
}

}  // namespace burnish
