// What a frame costs: colour tables, and register combiners in software.
#include <cmath>
#include <vector>

#include "bandwidth.h"
#include "burnish/core/parallel.h"
#include "burnish/render/anisotropy/register_combiners.h"
#include "burnish/render/palette/palette_table.h"

namespace burnish {
namespace {

std::vector<Vec3f> directions(std::size_t n) {
  std::vector<Vec3f> v(n);
  for (std::size_t i = 0; i < n; i++) {
    const double z = 1 - (double(i) + 0.5) / double(n), r = std::sqrt(1 - z * z), turn = 2.399963229728653 * double(i);
    v[i] = Vec3f(Vec3d{r * std::cos(turn), r * std::sin(turn), z});
  }
  return v;
}

void table_shading(benchmark::State& state) {
  const ThreadLimit one(1);
  const std::size_t n = std::size_t(state.range(0));
  const Palette palette{.normals = directions(n), .materials = {{0, 0, int(n)}}};
  const Material phong{.id = {}, .terms = {Lambert{}, Phong{}}};
  const Material* const materials[] = {&phong};
  PaletteTable table(palette, materials, Transform{}, Blend{});
  const Arriving sun{normalized(Vec3d{0.3, 0.4, 0.8}), {1, 1, 1}};
  const Illumination light{.lights = {&sun, 1}, .ambient = {}, .to_viewer = {0, 0, 1}};
  for (auto _ : state) {
    table.shade(light);
    benchmark::DoNotOptimize(table.plane(0).data());
  }
  bench::report(state, n * (24 + 12), n);
}
BENCHMARK(table_shading)->Arg(256)->Arg(2048)->Arg(16384)->Arg(65536);

// Kautz & Seidel, section 4.1: the two stages and the final combiner of a texel.
void combiner_emulation(benchmark::State& state) {
  const std::size_t texels = 1 << 16;
  const std::vector<Vec3f> t = directions(texels);
  std::vector<Vec3f> b(t.rbegin(), t.rend());
  const Vec3f half{0.2f, 0.1f, 0.97f};
  std::vector<float> out(texels);
  for (auto _ : state) {
    for (std::size_t i = 0; i < texels; i++) {
      const float x = combiners::dot_stage(combiners::expand_normal(t[i]), half, 4);
      const float y = combiners::dot_stage(combiners::expand_normal(b[i]), half, 4);
      out[i] = combiners::final_one_minus(combiners::sum_stage(x, x, y, y, 1), 0.8f);
    }
    benchmark::DoNotOptimize(out.data());
  }
  bench::report(state, texels * (24 + 4), texels);
}
BENCHMARK(combiner_emulation);

}  // namespace
}  // namespace burnish
