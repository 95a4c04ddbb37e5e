// A polynomial texture map, whatever file it lies in.
#pragma once

#include <memory>
#include <string>

#include "burnish/core/file_ref.h"
#include "burnish/ptm/ptm_rows.h"

namespace burnish {

struct OpenPtm {
  std::unique_ptr<PtmRows> rows;
  std::string format;  // "PTM_1.2 LRGB", "EXR", "textures"
};

// A .ptm, in memory as bytes, or an .exr, read in bands; told apart by what they begin with. Errors as read_ptm() and
// open_ptm_exr().
OpenPtm open_ptm(const FileRef& file);

}  // namespace burnish
