// burnish-simplify: fewer triangles for the same shape, and texture coordinates for a mesh that has none.
#include <limits>

#include "burnish/core/error.h"
#include "burnish/mesh/atlas/atlas.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/simplify/decimate.h"
#include "cli/tool.h"

using namespace burnish;
using namespace burnish::cli;

int main(int argc, char** argv) {
  Tool tool({"burnish-simplify", "Fewer triangles for the same shape, and a texture atlas for a mesh that has none.",
             "  burnish-simplify bunny.ply -o bunny_250.obj --faces 250 --atlas 1024\n"
             "  burnish-simplify teapot.obj -o teapot_1000.obj --faces 1000"});
  CLI::App& app = tool.app();
  std::string input, output;
  int faces = 0, atlas = 0;

  app.add_option("MESH", input, "Mesh: .obj, .ply, .off, .stl")->required();
  app.add_option("-o,--output", output, "Mesh to write: .obj or .ply; .off or .stl without texture coordinates")
      ->required()
      ->type_name("LOW");
  app.add_option("--faces", faces, "At most so many triangles (default: all)")
      ->check(CLI::Range(4, std::numeric_limits<int>::max()))
      ->type_name("N");
  app.add_option("--atlas", atlas,
                 "Add texture coordinates where MESH has none: charts at least two texels apart at PXxPX texels")
      ->check(CLI::Range(16, 131072))
      ->type_name("PX");

  return tool.run(argc, argv, [&]() -> Json {
    if (!faces && !atlas) throw Error(ErrorKind::kUsage, "--faces or --atlas is required");
    const MeshFileType type = mesh_file_type_of(output);
    const bool holds_uvs = type == MeshFileType::kObj || type == MeshFileType::kPly;
    if (atlas && !holds_uvs)
      throw file_error(ErrorKind::kUnsupported, output, "texture coordinates are written as .obj or .ply only");
    const FileRef file = tool.read(input), target = tool.write(output);
    MeshReadStats read;
    const Mesh mesh = read_mesh(file, &read);
    if (mesh.has_uvs() && !holds_uvs)
      throw file_error(ErrorKind::kUnsupported, output,
                       "'" + input + "' has texture coordinates, which are written as .obj or .ply only");
    if (read.dropped_faces)
      tool.warn("'" + input + "': " + std::to_string(read.dropped_faces) + " faces without area are left out");
    const std::size_t wanted = faces ? std::size_t(faces) : mesh.triangles.size();
    if (wanted > mesh.triangles.size())
      tool.warn("'" + input + "' has no more than " + std::to_string(mesh.triangles.size()) +
                " triangles; none is taken away");

    const Progress progress = tool.progress();
    const double share = atlas ? 0.8 : 1;
    DecimateStats stats;
    Mesh low = decimate(mesh, wanted, &stats, [&](double f) { report_progress(progress, share * f); });
    if (stats.faces > wanted)
      tool.warn("'" + input + "': expected " + std::to_string(wanted) + " triangles, got " +
                std::to_string(stats.faces) + "; no more can be taken away without tearing or folding the surface");
    Json out{{"faces", stats.faces},
             {"vertices", stats.vertices},
             {"max_distance", stats.max_distance},
             {"rms_distance", stats.rms_distance}};
    if (atlas && low.has_uvs()) {
      tool.warn("'" + input + "' has texture coordinates, which are kept: no atlas is made");
    } else if (atlas) {
      const AtlasStats made =
          add_atlas(low, atlas, [&](double f) { report_progress(progress, share + (1 - share) * f); });
      out["charts"] = made.charts;
      out["covered"] = made.covered;
    }
    write_mesh(target, type, low);
    return out;
  });
}
