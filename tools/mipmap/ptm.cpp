// The chain of a polynomial texture map.
#include "ptm/ptm.h"

#include "burnish/core/error.h"
#include "burnish/core/mip.h"
#include "burnish/ptm/light_matrix.h"
#include "burnish/ptm/ptm_mips.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {

Json mip_ptm(Tool& tool, const MipmapOptions& o, const PtmInput& map) {
  if (!o.output.format.empty())
    throw Error(ErrorKind::kUsage, "--format does not go with --kind ptm: an .exr holds floats, all else bytes");
  const PtmShape& shape = map.rows->shape();
  const int count = levels_to_make(shape.width, shape.height, o.levels);
  std::vector<PtmTarget> chain, parts;
  if (!o.output.path.empty()) {
    chain.emplace_back(tool, PtmOutput{o.output.path, o.output.output_type});
    chain[0].require_levels(shape, count);
  }
  for (int l = 0; l < count && !o.split.empty(); l++) parts.emplace_back(tool, PtmOutput{level_name(o.split, l), ""});

  const PtmMips mips = build_ptm_mips(*map.rows, o.levels);
  std::vector<PtmBytes> bytes;
  if (!(chain.empty() || chain[0].holds_floats()) || !(parts.empty() || parts[0].holds_floats()))
    bytes = rounded(mips, *map.rows, uniform_normal_matrix());
  for (const PtmTarget& target : chain) target.write(mips.levels, bytes, map.members());
  for (std::size_t l = 0; l < parts.size(); l++)
    parts[l].write(std::span(mips.levels).subspan(l, 1), std::span(bytes).subspan(bytes.empty() ? 0 : l),
                   map.members());
  Json levels = Json::array();
  for (int l = 0; l < count; l++)
    levels.push_back(
        {{"width", mips.levels[l].width}, {"height", mips.levels[l].height}, {"rms_deg", mips.rms_deg[l]}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
