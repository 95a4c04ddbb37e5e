// The chain of a normal map, and of the roughness beside it.
#include <algorithm>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/wording.h"
#include "burnish/normal/normal_mips.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {
namespace {

// Nothing is clamped: integers hold alpha up to 1.
void require_in_range(const std::vector<Image>& alphas, const LevelFiles& target) {
  if (!is_integer(target.sample())) return;
  for (std::size_t l = 0; l < alphas.size(); l++)
    if (const float most = *std::ranges::max_element(alphas[l].data); most > 1)
      throw file_error(ErrorKind::kUnsupported, target.name(),
                       std::string(name(target.sample())) + " holds alpha up to 1, not the " + number_text(most) +
                           " of level " + std::to_string(l) + " (EXR does)");
}

}  // namespace

Json mip_normals(Tool& tool, const MipmapOptions& o, const FileRef& file) {
  const auto image_output = [&](const std::string& path, const std::string& what) {
    return ImageOutput{
        path, o.output.output_type, o.output.format, {what, {FileType::kExr, FileType::kPng, FileType::kTiff}}};
  };
  const ImageOutput output = image_output(o.output.path, "a normal map");
  const NormalMips mips = build_normal_mips(file, o.coding, o.levels);
  if (mips.invalid_texels) tool.warn(counted(mips.invalid_texels, "normal") + " had no length: (0,0,1)");
  const int count = int(mips.means.size());
  std::vector<LevelFiles> targets;
  if (!output.path.empty()) targets.emplace_back(tool, output, count);
  if (!o.split.empty()) targets.emplace_back(tool, o.split, "--split", output, count);
  Json levels = Json::array();
  const Attributes attributes = mips.space ? space_attributes(*mips.space) : Attributes{};
  for (const LevelFiles& target : targets) {
    require_encodable(o.coding, target.sample(), target.name());
    target.write(
        [&](int l) {
          EncodedNormals encoded = encoded_level(mips, l, o.coding, target.sample());
          if (int(levels.size()) == l)  // of the first target
            levels.push_back({{"width", mips.width(l)}, {"height", mips.height(l)}, {"rms_deg", encoded.rms_deg}});
          return std::move(encoded.image);
        },
        attributes);
  }
  if (o.roughness.given()) {
    const std::string option = "--roughness-output";
    const bool split = o.roughness_output.find('%') != std::string::npos;
    const ImageOutput to = image_output(o.roughness_output, "a roughness map");
    const LevelFiles target =
        split ? LevelFiles(tool, o.roughness_output, option, to, count) : LevelFiles(tool, to, count);
    const Image base = read_roughness("roughness", o.roughness.source(tool), mips, file.name);
    const std::vector<Image> alphas = roughness_levels(mips, base);
    require_in_range(alphas, target);
    target.write([&](int l) { return alphas[l]; }, {});
  }
  return {{"levels", levels}};
}

}  // namespace burnish::cli
