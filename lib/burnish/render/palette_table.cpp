#include "burnish/render/palette_table.h"

#include "burnish/core/parallel.h"

namespace burnish {

std::vector<Vec3d> shade_palette(const Palette& palette, std::span<const Material* const> materials, Vec3d ambient,
                                 std::span<const Arriving> lights, Vec3d to_viewer) {
  constexpr std::size_t kGrain = 1024;
  std::vector<Vec3d> colours(palette.normals.size());
  for (std::size_t m = 0; m < palette.materials.size(); m++) {
    const std::size_t first = palette.materials[m].first, count = palette.materials[m].count;
    std::visit(
        [&](const auto& model) {
          parallel_for_chunks(count, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = first + begin; i < first + end; i++) {
              const Vec3d n(palette.normals[i]);
              Vec3d colour = ambient * model.ambient;
              for (const Arriving& light : lights)
                colour += light.colour * model.reflect(n, light.direction, to_viewer);
              colours[i] = colour;
            }
          });
        },
        materials[m]->model);
  }
  return colours;
}

}  // namespace burnish
