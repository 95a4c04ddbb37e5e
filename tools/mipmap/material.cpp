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

// Where levels from `first` on go, a file for each PREFIX_name.exr.
struct Target {
  int first, levels;
  std::map<std::string, FileRef> files;
  // Once they are open:
  std::vector<MaterialTexturesWriter> textures;
  std::map<std::string, ImageChainWriter> maps;

  void open(const MaterialTextures& like, int width, int height, SampleType sample,
            const std::map<std::string, int>& channels) {
    textures.emplace_back(like, width, height, levels, files.at("t"), files.at("b"), files.at("n"), FileType::kExr,
                          sample);
    for (const auto& [which, count] : channels)
      maps.try_emplace(which, files.at(which), sample, width, height, count, levels);
  }
  void write_rows(int level, const MaterialTextures& rows, const std::map<std::string, Image>& beside) {
    if (level < first || level >= first + levels) return;
    textures[0].write_rows(level - first, rows.t.levels[0], rows.b.levels[0], rows.n.levels[0]);
    for (const auto& [which, image] : beside) maps.at(which).write_rows(level - first, image.height, image.data.data());
  }
  void close() {
    textures[0].close();
    for (auto& [which, map] : maps) map.close();
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
  MaterialTexturesReader base(t, b, n);
  const int count = levels_to_make(base.width(), base.height(), o.levels);
  const bool has_alpha = base.model() != MaterialModel::kBanks;
  if (o.khr && !has_alpha) require_alpha(base.model());

  std::map<std::string, int> beside{{"direction", 3}};  // maps, and their channels
  if (has_alpha) beside["alpha"] = 3;
  if (o.khr) beside["khr"] = 3, beside["roughness"] = 1;
  std::vector<Target> targets;
  const auto add_target = [&](const std::string& of, int first, int levels) {
    Target& target = targets.emplace_back(Target{first, levels, {}, {}, {}});
    for (const char* which : {"t", "b", "n", "direction", "alpha", "khr", "roughness"})
      if (!which[1] || beside.contains(which)) target.files[which] = tool.write(of + "_" + which + ".exr");
  };
  if (!prefix.empty()) {
    add_target(prefix, 0, count);
    require_chain(targets[0].files["t"], base.width(), base.height(), count);
  }
  for (int l = 0; l < count && !o.split.empty(); l++) add_target(level_prefix(o.split, l), l, 1);
  for (Target& target : targets) {
    const int l = target.first;
    target.open(base.head(), level_size(base.width(), l), level_size(base.height(), l), sample, beside);
  }

  std::size_t wider_texels = 0;
  const auto read = [&](int first, int rows) { return base.rows(first, rows); };
  const auto take = [&](int level, const MaterialTextures& rows) {
    std::map<std::string, Image> maps{{"direction", direction_maps(rows)[0]}};
    if (has_alpha) maps["alpha"] = alpha_maps(rows)[0];
    if (o.khr) {
      KhrMaps khr = khr_maps(rows);
      wider_texels += khr.wider_texels;
      maps["khr"] = std::move(khr.anisotropy[0]), maps["roughness"] = std::move(khr.roughness[0]);
    }
    for (Target& target : targets) target.write_rows(level, rows, maps);
  };
  const std::vector<MaterialMipLevel> stats =
      make_material_mips(base.width(), base.height(), count, o.input, read, take, tool.progress());
  if (wider_texels)
    tool.warn(counted(wider_texels, "texel") + " with an alpha beyond 1, which KHR_materials_anisotropy cannot say");
  for (Target& target : targets) target.close();
  Json levels = Json::array();
  for (const MaterialMipLevel& l : stats)
    levels.push_back(
        {{"width", l.width}, {"height", l.height}, {"rms_deg", l.rms_deg}, {"relative_error", l.relative_error}});
  return {{"levels", levels}};
}

}  // namespace burnish::cli
