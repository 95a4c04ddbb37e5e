// Measured reflectance from files.
//
//   .binary  MERL (Matusik et al., "A data-driven reflectance model", 2003): three int32, the cells of θ_h, θ_d, φ_d,
//            then a double each for red, all cells, for green and for blue, to be multiplied by 1/1500, 1.15/1500 and
//            1.66/1500. Cells as in half_difference_table.h. Below 0: not measured.
//   .brdf    Cornell University, Program of Computer Graphics: text, '#' begins a comment; the number of wavelengths,
//            those in nm, then samples: θ_i, φ_i, θ_s, φ_s in radians and a value in 1/sr for each wavelength, at
//            directions that are scattered. Isotropic. Interpolated: scattered_brdf.h. To linear sRGB: observer.h.
//   .mbsdf   NVIDIA (MDL SDK, IBsdf_isotropic_data): "NVIDIA ARC MBSDF V1", lines KEY="…", then
//            "MBSDF_DATA_REFLECTION=" or "MBSDF_DATA=" and uint32 type (0 grey, 1 RGB), cells of θ from 0 to π/2, cells
//            of φ from 0 to π; float32 in 1/sr by [θ_in][θ_out][φ_out − φ_in]. Isotropic and mirrored; values stand at
//            the middles of cells, as the SDK's lookups have it. What follows is not read.
//
// The files are little-endian. Values between cells are interpolated linearly. Colours that sRGB cannot show have
// components below 0, which are kept.
#pragma once

#include <memory>

#include "burnish/brdf/brdf.h"
#include "burnish/core/file_ref.h"

namespace burnish {

// kUsage where a name does not end as those of measurements do.
void require_measurements(const std::string& name);

// By the extension. kUsage for any other; kIo where it cannot be read; kMalformed where sizes do not fit each other or
// the file, or values are no numbers; kUnsupported for an .mbsdf of transmission only.
std::shared_ptr<const Brdf> read_measured_brdf(const FileRef& file);

}  // namespace burnish
