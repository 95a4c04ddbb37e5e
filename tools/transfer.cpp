// burnish-transfer: detail of a mesh into maps over the texture coordinates of a coarser one.
#include "burnish/mesh/bake/transfer.h"

#include <cstdio>
#include <tuple>
#include <utility>

#include "burnish/core/error.h"
#include "burnish/core/wording.h"
#include "burnish/mesh/bake/baked_files.h"
#include "cli/mesh_input.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

namespace {

std::string percent(std::size_t part, std::size_t whole) {
  char text[16];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * double(part) / double(whole));
  return text;
}

// An optional file beside the normals.
struct ExtraOutput {
  WrittenAs as;
  std::string path{};
  FileType type = FileType::kPng;
  FileRef file{};

  void reserve(Tool& tool, const std::string& option) {
    if (path.empty()) return;
    type = as.type_of(path, option);
    file = tool.write(path);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"burnish-transfer", "Detail of a mesh into maps over the texture coordinates of a coarser one.",
             "  burnish-transfer bunny_250.obj bunny.ply -o bunny_n.png --size 1024 --mask-output bunny_m.png"});
  CLI::App& app = tool.app();
  std::string low, high;
  ImageOutput output;
  TransferOptions options;
  NormalCoding coding;
  ExtraOutput displacement{{"a displacement map", {FileType::kExr, FileType::kPng, FileType::kTiff}}},
      mask{{"a mask", output.as.types}};

  app.add_option("LOW", low, "Coarse mesh, with texture coordinates in [0,1]: .obj, .ply, .off")->required();
  app.add_option("HIGH", high, "Detailed mesh at the same place: .obj, .ply, .off, .stl")->required();
  output.add_to(app);
  app.add_option_function<std::string>(
         "--size",
         [&](const std::string& t) {
           std::tie(options.width, options.height) = parse_texels("--size", t);
           if (!options.height) options.height = options.width;
         },
         "Texels of the maps (default 1024x1024)")
      ->type_name("W[xH]");
  add_choice<NormalSpace>(app, "--space", options.space,
                          {{"object", NormalSpace::kObject}, {"tangent", NormalSpace::kTangent}},
                          "Space of the normals (default object; tangent: MikkTSpace frames of LOW)");
  app.add_option("--max-distance", options.max_distance,
                 "How far from LOW detail may lie, in its units (default 10 % of HIGH's diagonal)")
      ->type_name("D");
  app.add_option("--cage", options.cage, "The same, outwards only (default as --max-distance)")->type_name("D");
  add_choice<RayDirection>(
      app, "--rays", options.rays, {{"smooth", RayDirection::kSmooth}, {"halfway", RayDirection::kHalfway}},
      "Search along LOW's smooth normals (default), or halfway to each face's own: less parallax, steps at edges");
  app.add_option("--samples", options.samples, "NxN samples a texel, averaged (default 2)")
      ->check(in_range(1, 16))
      ->type_name("N");
  app.add_option("--padding", options.padding,
                 "Gutter round each chart, in texels (default 16: four mip levels find no seam)")
      ->check(in_range(0, 65536))
      ->type_name("PX");
  app.add_option(
         "--displacement", displacement.path,
         "Write signed distances along the rays, whatever -d says: as they are in .exr (float); -m to m as 0 to 1 in "
         ".png and .tif (uint16), m the report's max_distance")
      ->type_name("FILE");
  app.add_option("--mask-output", mask.path,
                 "Write 1 where a texel found detail, 0 elsewhere, in the samples of the file's type")
      ->type_name("FILE");
  add_normal_coding(app, coding, false);

  return tool.run(argc, argv, [&]() -> Json {
    const FileType type = output.type();
    const SampleType sample = output.sample();
    const FileRef low_file = tool.read(low), high_file = tool.read(high);
    const NormalMapTarget target{tool.write(output.path), type, sample, coding};
    require_encodable(coding, sample, target.file.name);
    displacement.reserve(tool, "--displacement"), mask.reserve(tool, "--mask-output");
    Mesh coarse = read_mesh(tool, low_file), detailed = read_mesh(tool, high_file);
    TransferMaps maps = transfer_detail(std::move(coarse), std::move(detailed), options, tool.progress());
    write_baked_normals(target, options.space, maps.width, maps.height, maps.normals);
    if (!displacement.path.empty())
      write_displacement(displacement.file, displacement.type, maps.displacement, maps.max_distance);
    if (!mask.path.empty()) {
      for (std::uint8_t& c : maps.coverage.data) c = c == kFound;
      write_mask(mask.file, mask.type, maps.coverage);
    }
    if (maps.missed_texels)
      tool.warn(std::to_string(maps.missed_texels) + " of " + counted(maps.covered_texels, "covered texel") + " (" +
                percent(maps.missed_texels, maps.covered_texels) + ") found no detail of '" + high +
                "' and took the normal of '" + low + "'; a larger --max-distance or --cage may reach it");
    warn_of_overlaps(tool, low, maps.overlapped_texels, "detail");
    return {{"covered_texels", maps.covered_texels},
            {"missed_texels", maps.missed_texels},
            {"overlapped_texels", maps.overlapped_texels},
            {"max_distance", maps.max_distance}};
  });
}
