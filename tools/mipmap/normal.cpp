// The chain of a normal map, and of the roughness beside it.
#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/wording.h"
#include "burnish/normal/normal_mips.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {
namespace {

// A target of normals, and what encodes each of its levels.
struct NormalTarget {
  LevelFiles files;
  std::vector<NormalLevelEncoder> levels;
};

// Nothing is clamped: integers hold alpha up to 1. `most`: the largest of each level.
void require_in_range(const std::vector<float>& most, const LevelFiles& target) {
  if (!is_integer(target.sample())) return;
  for (std::size_t l = 0; l < most.size(); l++)
    if (most[l] > 1)
      throw file_error(ErrorKind::kUnsupported, target.name(),
                       std::string(name(target.sample())) + " holds alpha up to 1, not the " + number_text(most[l]) +
                           " of level " + std::to_string(l) + " (EXR does)");
}

}  // namespace

Json mip_normals(Tool& tool, const MipmapOptions& o, const FileRef& file) {
  const auto image_output = [&](const std::string& path, const std::string& what) {
    return ImageOutput{
        path, o.output.output_type, o.output.format, {what, {FileType::kExr, FileType::kPng, FileType::kTiff}}};
  };
  const ImageOutput output = image_output(o.output.path, "a normal map");
  NormalMips mips(file, o.coding, o.levels);
  const int count = mips.levels(), width = mips.width(0), height = mips.height(0);
  std::vector<NormalTarget> targets;
  if (!output.path.empty()) targets.push_back({LevelFiles(tool, output, count), {}});
  if (!o.split.empty()) targets.push_back({LevelFiles(tool, o.split, "--split", output, count), {}});
  const Attributes attributes = mips.space() ? space_attributes(*mips.space()) : Attributes{};
  for (NormalTarget& target : targets) {
    require_encodable(o.coding, target.files.sample(), target.files.name());
    target.levels.assign(count, NormalLevelEncoder(o.coding, target.files.sample()));
    target.files.open(width, height, 3, attributes);
  }
  std::optional<LevelFiles> roughness;
  if (o.roughness.given()) {
    const std::string option = "--roughness-output";
    const bool split = o.roughness_output.find('%') != std::string::npos;
    const ImageOutput to = image_output(o.roughness_output, "a roughness map");
    roughness.emplace(split ? LevelFiles(tool, o.roughness_output, option, to, count) : LevelFiles(tool, to, count));
    mips.add_roughness("roughness", o.roughness.source(tool));
    roughness->open(width, height, 1, {});
  }

  std::vector<float> most_alpha(count);
  mips.make(
      [&](const NormalMips::Rows& rows) {
        for (NormalTarget& target : targets)
          target.files.write_rows(rows.level, target.levels[rows.level].encode(rows.means));
        if (!roughness) return;
        most_alpha[rows.level] = std::max(most_alpha[rows.level], std::ranges::max(rows.alphas.data));
        roughness->write_rows(rows.level, rows.alphas);
      },
      tool.progress());
  if (mips.invalid_texels()) tool.warn(counted(mips.invalid_texels(), "normal") + " had no length: (0,0,1)");
  for (NormalTarget& target : targets) target.files.close();
  if (roughness) {
    require_in_range(most_alpha, *roughness);
    roughness->close();
  }
  Json levels = Json::array();
  for (int l = 0; l < count; l++)
    levels.push_back(
        {{"width", mips.width(l)}, {"height", mips.height(l)}, {"rms_deg", targets[0].levels[l].rms_deg()}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
