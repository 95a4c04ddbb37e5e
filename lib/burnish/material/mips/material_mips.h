// Mip chains of material textures, which Kautz & Seidel (section 7) call "not a simple task".
//
// Each coarser texel is the lobe whose reflectance is nearest to the mean reflectance of the base texels under it
// (lobe_fit.h), starting from the lobe that has their mean normal and widths (lobe_moments.h). Means use the weights of
// core/mip.h. Those of reflectance add up pair by pair, so that each level is averaged from the one below. t is the
// axis of the lobe that lies nearest to the mean of the base's, so that textures can be filtered.
//
// blinn-phong keeps the mean N (weighted by energy): where N is not small, N and α say the same. banks has no α: what
// it cannot say of a mean, normal, direction and k_s are fitted to all the same.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "burnish/core/progress.h"
#include "burnish/material/material_textures.h"

namespace burnish {

struct MaterialMipLevel {
  int width, height;
  double rms_deg;  // between its normals and the renormalised mean of the base normals under each texel
  // RMS of its L_o minus the mean of the base's, over the RMS of that mean, over all texels and pairs.
  double relative_error;
};

// Rows [first, first + count) of the base, as the one level of textures.
using ReadMaterialRows = std::function<MaterialTextures(int first, int count)>;
// The next rows of a level, as the one level of textures.
using TakeMaterialRows = std::function<void(int level, const MaterialTextures& rows)>;

// Goes through a base of that size twice, in ascending bands, and gives the rows of all levels, the base's too.
// `levels` with the base, 0: all. What a level's alpha of ward's n is may exceed the base's maximum. kUsage for more
// levels than there are; kMalformed, beginning with `name`, for texels that are no lobe. In parallel; the result does
// not depend on threads. Time is proportional to texels, memory to the width: from level 1 on two rows a level, three
// of odd heights, of up to 1024 floats a texel.
std::vector<MaterialMipLevel> make_material_mips(int width, int height, int levels, const std::string& name,
                                                 const ReadMaterialRows& read, const TakeMaterialRows& take,
                                                 const Progress& progress = {});

}  // namespace burnish
