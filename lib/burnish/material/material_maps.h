// What a material is baked from: the frame of every texel, and the parameters of its model.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/parameter.h"
#include "burnish/core/vec3.h"
#include "burnish/material/directions/orthonormal_directions.h"
#include "burnish/material/material_textures.h"

namespace burnish {

struct MaterialSource {
  MaterialModel model = MaterialModel::kWard;
  ParameterSource alpha_x, alpha_y;  // not of banks
  ParameterSource k_s{1, {}};
  ParameterSource exponent{32, {}};  // N, of blinn-phong only
  // Where the tangent points: a map of directions, or an angle for all, counter-clockwise from +u.
  FileRef directions;
  DirectionCoding direction_coding;
  double angle_rad = 0;
  FileRef normals;  // none: (0,0,1)
  NormalCoding normal_coding;
};

// All of the maps, or some rows of them.
struct MaterialMaps {
  MaterialModel model = MaterialModel::kWard;
  int width = 1, height = 1;
  std::vector<Vec3f> t, n;  // orthonormal; b = n × t
  Parameter alpha_x, alpha_y, k_s, exponent;
  std::size_t degenerate_texels = 0;      // their t is their nearest neighbour's (orthonormal_directions.h)
  std::size_t invalid_normal_texels = 0;  // too short: (0,0,1)
};

// A material's maps in bands of rows. All have one size, and the material theirs; without maps it is one texel. Only
// what the model uses is read.
class MaterialReader {
 public:
  // Errors of ParameterReader, DirectionReader and SurfaceNormalReader.
  explicit MaterialReader(const MaterialSource& source);

  MaterialModel model() const { return source_.model; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  bool has_parameter_maps() const;

  // Rows [first, first + count) without their frames. α must be above 0, k_s and N at least 0, all finite: kUsage for a
  // number, kMalformed for a map.
  MaterialMaps parameters(int first, int count);
  // Gives the frames of all rows, without their parameters, a band after the other from the top; what is invalid is
  // counted in each. Returns how many texels are degenerate. `directory`: for a temporary file. Errors of
  // orthonormal_bands().
  std::size_t frames(const std::string& directory, const std::function<void(int first, MaterialMaps& rows)>& take);

 private:
  struct Entry {
    std::optional<ParameterReader> reader;  // none: the model has no use for it
    bool zero_too = false;
  };
  void open(Entry& entry, const char* name, const ParameterSource& from, bool zero_too);

  MaterialSource source_;
  SharedSize size_;
  Entry alpha_x_, alpha_y_, k_s_, exponent_;
  std::optional<SurfaceNormalReader> normals_;
  std::optional<DirectionReader> directions_;
};

// All of it. Errors as MaterialReader.
MaterialMaps read_material_maps(const MaterialSource& source);

}  // namespace burnish
