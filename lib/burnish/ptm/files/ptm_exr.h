// Coefficients of a polynomial texture map as they are, in an EXR of 32-bit floats.
//
//   burnish:ptm = lrgb   channels a0 … a5, R, G, B
//   burnish:ptm = rgb    channels R.a0 … R.a5, G.a0 … G.a5, B.a0 … B.a5
//
// in the units of .ptm files (ptm.h); row 0 is the top row. Files are written and read in bands of rows.
#pragma once

#include <memory>
#include <span>

#include "burnish/core/file_ref.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

// kIo where it cannot be written.
void write_ptm_exr(const FileRef& file, const PtmRows& rows);
// The levels of a mip chain, of one type and of the sizes of core/mip.h: one, or all. kUnsupported for any other
// number.
void write_ptm_exr_chain(const FileRef& file, std::span<const Ptm> levels);
// kMalformed where the attribute or channels are others, and from read() for NaN and infinity.
std::unique_ptr<PtmRows> open_ptm_exr(const FileRef& file);

}  // namespace burnish
