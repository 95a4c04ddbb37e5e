// Makes maps over a mesh's texture coordinates out of where its surface lies in space, so that no seam shows.
//
//   make-surface-maps MESH.obj DIRECTORY [SIDE]      SIDE texels, 1024 by default
//
// halves.png   material of each texel: 1 in the upper half, 0 in the lower
// wood.png     colour of wood that the object is carved from, sRGB
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "burnish/core/image_io.h"
#include "burnish/core/parallel.h"
#include "burnish/mesh/bake/gutter.h"
#include "burnish/mesh/bake/uv_raster.h"
#include "burnish/mesh/files/mesh_io.h"
#include "burnish/mesh/mesh.h"
#include "noise.h"
#include "program.h"

using namespace burnish;

namespace {

// `p` in parts of the mesh's largest side, from the middle: wavering rings round a leaning trunk, and fibres along it.
Vec3d wood(Vec3d p) {
  const Vec3d bent =
      p + Vec3d{turbulence(p * 2.0, 2, 1), turbulence(p * 2.0, 2, 11), turbulence(p * 2.0, 2, 21)} * 0.12;
  const double x = bent.x + 0.25 * bent.y + 0.9, z = bent.z + 0.12 * bent.y + 0.35;
  const double ring = std::sqrt(x * x + z * z) * 17, within = ring - std::floor(ring);
  const double late = std::pow(within, 3) * (1 - std::pow(within, 24));  // dark towards the ring's end
  const double fibre = noise({p.x * 140, p.y * 9, p.z * 140}, 31) + 0.5 * noise({p.x * 60, p.y * 4, p.z * 60}, 41);
  const double dark = std::clamp(0.15 + 0.75 * late + 0.10 * fibre, 0.0, 1.0);
  return Vec3d{0.88, 0.66, 0.42} * (1 - dark) + Vec3d{0.42, 0.22, 0.10} * dark;
}

bool in_upper_half(Vec3d p) { return p.y > 0.012 * std::sin(14 * std::atan2(p.z, p.x)); }

void write(const std::string& file, const std::string& directory, int side) {
  const Mesh mesh = read_mesh(file);
  require_uvs(mesh, "which the maps are laid out by");
  require_atlas(mesh);
  const Bounds box = bounds(mesh);
  const Vec3d sides = box.most - box.least;
  const double largest = std::max({sides.x, sides.y, sides.z});
  const UvRaster raster(mesh, side, side);
  ByteImage covered(side, side, 1);
  std::vector<float> ids(covered.texels());
  std::vector<Vec3f> colours(covered.texels());
  parallel_for(side, [&](std::size_t y) {
    std::vector<std::uint32_t> triangles(side);
    std::vector<std::uint8_t> several(side);
    raster.row(int(y), triangles.data(), several.data());
    for (int x = 0; x < side; x++) {
      if (triangles[x] == UvRaster::kNone) continue;
      const std::size_t i = y * side + x;
      const Vec3d p = (position_at(mesh, raster.point(triangles[x], x, int(y))) - box.centre()) / largest;
      covered.data[i] = 1, ids[i] = in_upper_half(p) / 255.f, colours[i] = Vec3f(wood(p));
    }
  });
  const std::vector<std::uint32_t> sources = gutter_sources(covered, side / 64);
  fill_gutter(sources, ids), fill_gutter(sources, colours);
  Image halves(side, side, 1), grain(side, side, 3);
  halves.data = ids;
  for (std::size_t i = 0; i < colours.size(); i++)
    grain.data[3 * i] = colours[i].x, grain.data[3 * i + 1] = colours[i].y, grain.data[3 * i + 2] = colours[i].z;
  write_image(directory + "/halves.png", FileType::kPng, SampleType::kUint8, halves);
  write_image(directory + "/wood.png", FileType::kPng, SampleType::kUint8, grain);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("make-surface-maps MESH.obj DIRECTORY [SIDE]", argc, argv,
                     [](const Arguments& a) { write(a[0], a[1], integer_argument(a, 2, 1024, 1, 32768)); });
}
