// A polynomial texture map under one light: an image of what a photograph would show, 255 being 1.
#pragma once

#include <cstddef>

#include "burnish/core/image_io.h"
#include "burnish/core/progress.h"
#include "burnish/core/vec3.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct RelightStats {
  std::size_t clipped_samples = 0;  // below 0 or above 1, where the image holds no such
};

// Whether it has a length, above 1e-6, and z > 0.
bool is_from_above(Vec3d light);

// Three channels. `light`: towards it, of any length. Polynomials exceed [0,1]: integers hold what is clipped to it,
// floats hold all. kUsage where the light is not from above; else as ImageWriter.
RelightStats relight(const PtmRows& rows, Vec3d light, const FileRef& file, FileType type, SampleType sample,
                     const Progress& progress = {});

}  // namespace burnish
