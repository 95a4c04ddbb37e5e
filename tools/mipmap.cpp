// burnish-mipmap: the mip chain of a map.
#include "mipmap/mipmap.h"

#include <filesystem>

#include "burnish/core/error.h"
#include "burnish/core/wording.h"
#include "burnish/material/material_textures.h"
#include "burnish/ptm/files/ptm_file.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

void add_options(CLI::App& app, MipmapOptions& o) {
  app.add_option("MAP", o.input,
                 "Indexed normal map, normal map or polynomial texture map, '-' being standard input, or the PREFIX of "
                 "material textures or PREFIX/ of textures of a polynomial texture map")
      ->required();
  o.output.add_to(app);
  app.get_option("--output")
      ->required(false)
      ->description(
          "File to write: EXR, PNG, KTX2 or DDS of an indexed map; EXR, or of one level PNG or TIFF, of a normal "
          "map; a PREFIX of EXR files of material textures; EXR of a polynomial texture map. '-' is standard output");
  add_choice<std::optional<MapKind>>(app, "--kind", o.kind,
                                     {{"indexed", MapKind::kIndexed},
                                      {"normal", MapKind::kNormal},
                                      {"material", MapKind::kMaterial},
                                      {"ptm", MapKind::kPtm},
                                      {"colour", MapKind::kColour}},
                                     "What MAP is (default: told from it); colour is not there yet");
  app.add_option("--levels", o.levels, "How many levels, with the base (default all)")
      ->check(in_range(1, 32))
      ->type_name("N");
  app.add_option("--split", o.split, "Write one file a level, named by a pattern such as 'name_%d.png'")
      ->type_name("PATTERN");
  add_normal_coding(app, o.coding, true);
  const auto add = [&](const char* group, const char* flag, std::string& value, const char* type, const char* help) {
    return app.add_option(flag, value, help)->type_name(type)->group(group);
  };
  const char *indexed = "Indexed normal map", *normal = "Normal map", *material = "Material textures";
  app.get_option("--palette-output")->group(indexed);
  add(indexed, "--palette", o.palette, "FILE", "The palette of a MAP that holds indices only, as every DDS does");
  auto* from =
      add_choice<MipAverage>(app, "--from", o.average, {{"level", MipAverage::kLevel}, {"base", MipAverage::kBase}},
                             "Average the quantized level below (default) or the quantized base")
          ->group(indexed);
  add(indexed, "--source", o.source, "NORMAL", "Average these unquantized normals of the base instead")->excludes(from);
  auto* roughness = add(normal, "--roughness", o.roughness.text, "V",
                        "Roughness alpha of the base, a number or a map; coarser levels add what their normals lose");
  auto* beside = add(normal, "--roughness-output", o.roughness_output, "FILE",
                     "The chain of alpha, written as the normal map's; a pattern writes one file a level");
  roughness->needs(beside);
  beside->needs(roughness);
  app.add_flag("--khr", o.khr, "Write PREFIX_khr and PREFIX_roughness too, for KHR_materials_anisotropy")
      ->group(material);
}

bool is_material_prefix(const std::string& input) {
  if (input == "-" || std::filesystem::exists(input)) return false;
  for (const FileType type : {FileType::kExr, FileType::kPng, FileType::kTiff})
    if (std::filesystem::exists(material_file(input, 't', type))) return true;
  return false;
}

MapKind kind_of(const FileRef& file) {
  if (is_indexed_map(file) || has_own_palette(file)) return MapKind::kIndexed;
  if (is_ptm(file)) return MapKind::kPtm;
  const ImageReader reader(file);
  if (reader.text("burnish:ptm")) return MapKind::kPtm;
  if (reader.text("burnish:model"))
    throw file_error(ErrorKind::kUsage, file.name, "expected the PREFIX of material textures, got one of them");
  if (reader.channels() >= 3) return MapKind::kNormal;
  throw file_error(ErrorKind::kUsage, file.name,
                   "expected --kind to say what it is, which " + counted(std::size_t(reader.channels()), "channel") +
                       (reader.channels() == 1 ? " does not" : " do not"));
}

// Options that only one kind of map has a use for.
void require_options_of(const CLI::App& app, MapKind kind) {
  const std::tuple<const char*, MapKind, const char*> all[] = {
      {"--from", MapKind::kIndexed, "indexed"},    {"--source", MapKind::kIndexed, "indexed"},
      {"--palette", MapKind::kIndexed, "indexed"}, {"--palette-output", MapKind::kIndexed, "indexed"},
      {"--roughness", MapKind::kNormal, "normal"}, {"--khr", MapKind::kMaterial, "material"}};
  for (const auto& [flag, of, word] : all)
    if (kind != of && app.count(flag)) throw Error(ErrorKind::kUsage, std::string(flag) + " goes with --kind " + word);
}

Json mip(Tool& tool, MipmapOptions& o) {
  if (o.output.path.empty() && o.split.empty()) throw Error(ErrorKind::kUsage, "--output or --split is required");
  if (o.kind == MapKind::kMaterial || (!o.kind && is_material_prefix(o.input))) {
    require_options_of(tool.app(), MapKind::kMaterial);
    return mip_material(tool, o);
  }
  if (o.kind.value_or(MapKind::kPtm) == MapKind::kPtm && is_texture_prefix(o.input)) {
    require_options_of(tool.app(), MapKind::kPtm);
    return mip_ptm(tool, o, open_input(tool, o.input));
  }
  const FileRef file = tool.read(o.input);
  const MapKind kind = o.kind ? *o.kind : kind_of(file);
  if (kind == MapKind::kColour) throw Error(ErrorKind::kUnsupported, "--kind colour is not there yet");
  require_options_of(tool.app(), kind);
  if (kind == MapKind::kPtm) return mip_ptm(tool, o, open_input(file));
  return kind == MapKind::kIndexed ? mip_indices(tool, o, file) : mip_normals(tool, o, file);
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool(
      {"burnish-mipmap",
       "The mip chain of an indexed normal map, a normal map, a polynomial texture map, or the textures of a material.",
       "  burnish-mipmap rocks_q.exr -o rocks_m.exr\n"
       "  burnish-mipmap rocks_q.exr -o rocks_m.dds --palette-output rocks_p.exr\n"
       "  burnish-mipmap rocks_q.png --split 'rocks_%d.png' --source rocks_n.png\n"
       "  burnish-mipmap rocks_n.png -o rocks_m.exr --roughness 0.3 --roughness-output rocks_r.exr\n"
       "  burnish-mipmap brushed -o brushed_m -d float\n"
       "  burnish-mipmap coin.ptm --split 'coin_%d/'"});
  MipmapOptions options;
  add_options(tool.app(), options);
  return tool.run(argc, argv, [&] { return mip(tool, options); });
}
