// The mip chain of a normal map, and of the roughness beside it.
//
// Each texel is the renormalised mean n' = m/‖m‖ of the base normals under it, m = Σ w n with the weights of
// core/mip.h; where all cancel out, (0,0,1). What the mean loses, the roughness gains: the variance of the slope that a
// mean's length tells of, σ² = (1 − ‖m‖)/‖m‖ along either axis, adds to the squares of the base's α,
//
//   α'² = Σ w α² + 2 σ².
//
// Sources: Toksvig, "Mipmapping normal maps" (2005), for σ²; Olano & Baker, "LEAN mapping" (2010), for α² = 2σ² and
// that variances add.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/core/parameter.h"
#include "burnish/normal/coding.h"
#include "burnish/normal/normal_space.h"

namespace burnish {

struct NormalMips {
  std::vector<Image> means;          // m of each level, 3 channels; the base's are unit vectors
  std::optional<NormalSpace> space;  // what the file says
  std::size_t invalid_texels = 0;    // shorter than 1e-3: (0,0,1)

  int width(int level) const { return means[level].width; }
  int height(int level) const { return means[level].height; }
};

// `levels` with the base, 0: all. kUsage for more than there are; else as NormalReader. Memory: 16 bytes a texel.
NormalMips build_normal_mips(const FileRef& file, const NormalCoding& coding, int levels);

// The unit vectors of a level as a file of such samples holds them, integers in [0,1]; and the RMS angle between those
// and the means.
struct EncodedNormals {
  Image image;  // 3 channels
  double rms_deg;
};
EncodedNormals encoded_level(const NormalMips& mips, int level, const NormalCoding& coding, SampleType sample);

// α of every level, one channel. `base`: α of the base's size, at least 0.
std::vector<Image> roughness_levels(const NormalMips& mips, Image base);
// α of the base. kUsage for a number below 0, NaN and infinity, which are called `name`; kMalformed for such texels of
// a map, and where it has another size than the normals, which are called `normals`.
Image read_roughness(const std::string& name, const ParameterSource& source, const NormalMips& mips,
                     const std::string& normals);

}  // namespace burnish
