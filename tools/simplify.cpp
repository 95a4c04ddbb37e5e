// burnish-simplify: fewer triangles for the same shape, and texture coordinates for a mesh that has none.
#include <limits>

#include "burnish/core/error.h"
#include "burnish/core/wording.h"
#include "burnish/mesh/atlas/atlas.h"
#include "burnish/mesh/simplify/decimate.h"
#include "cli/mesh_input.h"
#include "cli/options.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

int main(int argc, char** argv) {
  Tool tool({"burnish-simplify",
             "Fewer triangles for the same shape, a texture atlas for a mesh that has none, or another type of file.",
             "  burnish-simplify bunny.ply -o bunny_250.obj --faces 250 --atlas 1024\n"
             "  burnish-simplify teapot.obj -o teapot_1000.obj --faces 1000\n"
             "  burnish-simplify teapot.obj -o teapot.ply"});
  CLI::App& app = tool.app();
  std::string input, output;
  int faces = 0, atlas_size = 0;
  bool new_atlas = false;

  app.add_option("MESH", input, "Mesh: .obj, .ply, .off, .stl. Groups, objects and materials of an .obj are not kept")
      ->required();
  app.add_option("-o,--output", output, "Mesh to write: .obj or .ply; .off or .stl without texture coordinates")
      ->required()
      ->type_name("LOW");
  app.add_option(
         "--faces", faces,
         "Take triangles away down to so many; smooth normals take the place of MESH's own (default: all are kept)")
      ->check(in_range(4, std::numeric_limits<int>::max()))
      ->type_name("N");
  CLI::Option* atlas =
      app.add_option("--atlas", atlas_size,
                     "Add texture coordinates where MESH has none: charts at least two texels apart at PXxPX texels")
          ->check(in_range(16, 131072))
          ->type_name("PX");
  app.add_flag("--new-atlas", new_atlas,
               "With --atlas: give MESH new texture coordinates though it has some, such as ones beyond [0,1] or that "
               "overlap; maps made for the old ones do not fit then")
      ->needs(atlas);

  return tool.run(argc, argv, [&]() -> Json {
    const MeshFileType type = mesh_file_type_of(output);
    const bool holds_uvs = type == MeshFileType::kObj || type == MeshFileType::kPly;
    if (atlas_size && !holds_uvs)
      throw file_error(ErrorKind::kUnsupported, output, "texture coordinates are written as .obj or .ply only");
    const FileRef file = tool.read(input), target = tool.write(output);
    MeshReadStats read;
    Mesh mesh = read_mesh(tool, file, &read);
    if (new_atlas) mesh.uvs.clear(), mesh.triangle_uvs.clear();
    if (mesh.has_uvs() && !holds_uvs)
      throw file_error(ErrorKind::kUnsupported, output,
                       "'" + input + "' has texture coordinates, which are written as .obj or .ply only");
    if (!read.left_out.empty())
      tool.warn("'" + input + "': groups, objects and materials are not kept (" + joined(read.left_out) + ")");
    const std::size_t wanted = faces ? std::size_t(faces) : mesh.triangles.size();
    if (wanted > mesh.triangles.size())
      tool.warn("'" + input + "' has no more than " + counted(mesh.triangles.size(), "triangle") +
                "; none is taken away");

    const Progress progress = tool.progress();
    const double share = atlas_size ? 0.8 : 1;
    DecimateStats stats;
    Mesh low = decimate(mesh, wanted, &stats, [&](double f) { report_progress(progress, share * f); });
    if (stats.faces > wanted)
      tool.warn("'" + input + "': expected " + std::to_string(wanted) + " triangles, got " +
                std::to_string(stats.faces) + "; no more can be taken away without tearing or folding the surface");
    Json out{{"faces", stats.faces},
             {"vertices", stats.vertices},
             {"max_distance", stats.max_distance},
             {"rms_distance", stats.rms_distance}};
    if (atlas_size && low.has_uvs()) {
      tool.warn("'" + input + "' has texture coordinates, which are kept: no atlas is made (--new-atlas makes one)");
    } else if (atlas_size) {
      const AtlasStats made =
          add_atlas(low, atlas_size, [&](double f) { report_progress(progress, share + (1 - share) * f); });
      out["charts"] = made.charts;
      out["covered"] = made.covered;
    }
    write_mesh(target, type, low);
    return out;
  });
}
