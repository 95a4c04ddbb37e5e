// The chains of material textures, and of the maps that say the same to renderers of today.
#include <map>

#include "burnish/core/error.h"
#include "burnish/core/image_chain.h"
#include "burnish/core/mip.h"
#include "burnish/core/wording.h"
#include "burnish/material/mips/lobe_maps.h"
#include "burnish/material/mips/material_mips.h"
#include "mipmap/mipmap.h"

namespace burnish::cli {
namespace {

// Levels [first, end), a file for each PREFIX_name.exr.
struct Target {
  int first, end;
  std::map<std::string, FileRef> files;

  std::vector<Image> share(const std::vector<Image>& levels) const {
    return {levels.begin() + first, levels.begin() + end};
  }
  MaterialTextures share(MaterialTextures textures) const {
    for (MaterialTexture* texture : {&textures.t, &textures.b, &textures.n}) texture->levels = share(texture->levels);
    return textures;
  }
};

// The PREFIX of a level; .exr may stand at the pattern's end.
std::string level_prefix(std::string pattern, int level) {
  if (const std::optional<FileType> type = find_file_type(pattern)) {
    if (*type != FileType::kExr)
      throw file_error(
          ErrorKind::kUnsupported, pattern,
          std::string("chains of material textures are written as EXR, not ") + name(*type) + " (--split)");
    pattern.resize(pattern.rfind('.'));
  }
  return level_name(pattern, level);
}

}  // namespace

Json mip_material(Tool& tool, const MipmapOptions& o) {
  const std::string& prefix = o.output.path;
  if (prefix == "-" || !o.output.output_type.empty())
    throw Error(ErrorKind::kUsage, "output: expected the PREFIX of files, got standard output");
  const SampleType sample = ImageOutput{prefix, "", o.output.format}.sample_or(SampleType::kHalf);
  require_can_hold(FileType::kExr, sample, prefix.empty() ? o.split : prefix);
  const auto input = [&](char which) { return tool.read(material_file(o.input, which)); };
  const FileRef t = input('t'), b = input('b'), n = input('n');
  MaterialTextures textures = read_material_textures(t, b, n);
  const int count = levels_to_make(textures.width(), textures.height(), o.levels);
  const bool has_alpha = textures.model != MaterialModel::kBanks;

  std::vector<std::string> names{"t", "b", "n", "direction"};
  if (has_alpha) names.push_back("alpha");
  if (o.khr) names.insert(names.end(), {"khr", "roughness"});
  std::vector<Target> targets;
  const auto add_target = [&](const std::string& of, int first, int end) {
    Target& target = targets.emplace_back(Target{first, end, {}});
    for (const std::string& which : names) target.files[which] = tool.write(of + "_" + which + ".exr");
  };
  if (!prefix.empty()) {
    add_target(prefix, 0, count);
    require_chain(targets[0].files["t"], textures.width(), textures.height(), count);
  }
  for (int l = 0; l < count && !o.split.empty(); l++) add_target(level_prefix(o.split, l), l, l + 1);
  if (o.khr && !has_alpha) require_alpha(textures.model);

  const std::vector<MaterialMipLevel> stats = build_material_mips(textures, count, o.input, tool.progress());
  std::map<std::string, std::vector<Image>> maps{{"direction", direction_maps(textures)}};
  if (has_alpha) maps["alpha"] = alpha_maps(textures);
  if (o.khr) {
    KhrMaps khr = khr_maps(textures);
    if (khr.wider_texels)
      tool.warn(counted(khr.wider_texels, "texel") +
                " with an alpha beyond 1, which KHR_materials_anisotropy cannot say");
    maps["khr"] = std::move(khr.anisotropy), maps["roughness"] = std::move(khr.roughness);
  }
  for (const Target& to : targets) {
    write_material_textures(to.share(textures), to.files.at("t"), to.files.at("b"), to.files.at("n"), FileType::kExr,
                            sample);
    for (const auto& [which, levels] : maps) write_image_chain(to.files.at(which), sample, to.share(levels));
  }
  Json levels = Json::array();
  for (const MaterialMipLevel& l : stats)
    levels.push_back(
        {{"width", l.width}, {"height", l.height}, {"rms_deg", l.rms_deg}, {"relative_error", l.relative_error}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
