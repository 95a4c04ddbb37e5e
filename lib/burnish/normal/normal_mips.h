// The mip chain of a normal map, and of the roughness beside it.
//
// Each texel is the renormalised mean n' = m/‖m‖ of the base normals under it, m = Σ w n with the weights of
// core/mip.h; where all cancel out, (0,0,1). What the mean loses, the roughness gains: the variance of the slope that a
// mean's length tells of, σ² = (1 − ‖m‖)/‖m‖ along either axis, adds to the squares of the base's α,
//
//   α'² = Σ w α² + 2 σ².
//
// Levels are made together, in bands of rows, as those of the base are read: memory grows with the width only.
//
// Sources: Toksvig, "Mipmapping normal maps" (2005), for σ²; Olano & Baker, "LEAN mapping" (2010), for α² = 2σ² and
// that variances add.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "burnish/core/parameter.h"
#include "burnish/core/progress.h"
#include "burnish/normal/coding.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

class NormalMips {
 public:
  // Rows of a level, in images of their own.
  struct Rows {
    int level, first;
    Image means;   // m, 3 channels; the base's are unit vectors
    Image alphas;  // α, without a roughness none
  };

  // `levels` with the base, 0: all. kUsage for more than there are; else as NormalReader.
  NormalMips(const FileRef& file, const NormalCoding& coding, int levels);

  // α of the base. kUsage for a number below 0, NaN and infinity, which are called `name`; kMalformed where a map has
  // another size than the normals.
  void add_roughness(const std::string& name, const ParameterSource& source);

  int levels() const { return levels_; }
  int width(int level) const;
  int height(int level) const;
  std::optional<NormalSpace> space() const { return space_; }  // what the file says

  // Makes all rows: of each level from the top. kMalformed for what NormalReader refuses, and for a map's α below 0,
  // NaN and infinity. To be called once.
  void make(const std::function<void(const Rows&)>& take, const Progress& progress = {});
  // Of those that were read, shorter than 1e-3: (0,0,1).
  std::size_t invalid_texels() const { return reader_.invalid_texels(); }

 private:
  NormalReader reader_;
  int levels_;
  std::optional<NormalSpace> space_;
  std::optional<ParameterReader> roughness_;
};

// The unit vectors of a level as a file of such samples holds them, row by row.
class NormalLevelEncoder {
 public:
  NormalLevelEncoder(const NormalCoding& coding, SampleType sample);

  // The next rows, 3 channels, integers in [0,1].
  Image encode(const Image& means);
  // The RMS angle between what was encoded and the means.
  double rms_deg() const;

 private:
  NormalCoding stored_;
  SampleType sample_;
  double squares_ = 0;
  std::size_t texels_ = 0;
};

}  // namespace burnish
