// Codebooks of normals, and indices into them.
#include <cmath>
#include <cstdint>
#include <vector>

#include "bandwidth.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/codebook.h"
#include "burnish/palette/dither.h"
#include "burnish/palette/fit/lloyd.h"
#include "burnish/palette/index_mips.h"
#include "burnish/palette/nearest_entry.h"

namespace burnish {
namespace {

// Normals of a bumpy map: a wide lobe about z, dense in the middle; the same every time.
Vec3f bumpy(std::size_t i) {
  const double u = std::fmod(double(i) * 0.7548776662466927, 1), v = std::fmod(double(i) * 0.5698402909980532, 1);
  const double tilt = 1.2 * u * u, turn = 6.283185307179586 * v;
  return Vec3f(Vec3d{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)});
}

std::vector<Vec3f> entries(std::size_t n) {
  std::vector<Vec3f> e(n);
  for (std::size_t i = 0; i < n; i++) e[i] = bumpy(i);
  return e;
}

constexpr std::size_t kTexels = 1 << 18;

void nearest_entry(benchmark::State& state) {
  const std::size_t n = std::size_t(state.range(0));
  const NearestEntry nearest(entries(n));
  std::vector<Vec3f> normals(kTexels);
  for (std::size_t i = 0; i < kTexels; i++) normals[i] = bumpy(7 * i + n);
  std::vector<std::uint16_t> out(kTexels);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kTexels; i++) out[i] = std::uint16_t(nearest(normals[i]));
    benchmark::DoNotOptimize(out.data());
  }
  bench::report(state, kTexels * (12 + 2), kTexels);
}
BENCHMARK(nearest_entry)->RangeMultiplier(4)->Range(16, 65536);

void lloyd_step(benchmark::State& state) {
  const ThreadLimit one(1);
  const int n = int(state.range(0));
  std::vector<WeightedNormal> points(kTexels);
  for (std::size_t i = 0; i < kTexels; i++) points[i] = {bumpy(i), float(1 + i % 7)};
  std::vector<Cells> cells;
  cells.emplace_back(points, 64);
  cells[0].centres = entries(std::size_t(n));
  lloyd(cells);
  const std::vector<Vec3f> early = cells[0].centres;
  lloyd(cells);
  for (auto _ : state) {
    cells[0].centres = early;  // moved again, by as much as the step before has moved them
    benchmark::DoNotOptimize(lloyd(cells));
  }
  bench::report(state, kTexels * sizeof(WeightedNormal), kTexels);
}
BENCHMARK(lloyd_step)->Arg(256)->Arg(2048)->Arg(16384);

void error_diffusion(benchmark::State& state) {
  const int width = 4096, rows = 64;
  const std::vector<Vec3f> palette = entries(std::size_t(state.range(0)));
  const EntryRange range{0, NearestEntry(palette)};
  const EntryRange* const ranges[] = {&range};
  std::vector<Vec3f> normals(std::size_t(width) * rows);
  for (std::size_t i = 0; i < normals.size(); i++) normals[i] = bumpy(3 * i);
  const std::vector<std::uint16_t> regions(width, 0);
  std::vector<std::uint16_t> out(width);
  for (auto _ : state) {
    ErrorDiffusion diffusion(palette, ranges, width, 1);
    for (int y = 0; y < rows; y++)
      diffusion.row(normals.data() + std::size_t(y) * width, regions.data(), y + 1 < rows ? regions.data() : nullptr,
                    out.data());
    benchmark::DoNotOptimize(out.data());
  }
  bench::report(state, normals.size() * (12 + 2 + 2), normals.size());
}
BENCHMARK(error_diffusion)->Arg(256)->Arg(2048)->Arg(16384);

void index_mips(benchmark::State& state) {
  const ThreadLimit one(1);
  const int side = 1024, n = int(state.range(0));
  const Palette palette{.normals = entries(std::size_t(n)), .materials = {{0, 0, n}}};
  std::vector<std::uint16_t> indices(std::size_t(side) * side);
  for (std::size_t i = 0; i < indices.size(); i++) indices[i] = std::uint16_t(i * 2654435761u % unsigned(n));
  const IndexRows map{palette, side, side, [&](int first, int count, std::uint16_t* out) {
                        std::copy_n(indices.data() + std::size_t(first) * side, std::size_t(count) * side, out);
                      }};
  for (auto _ : state)
    make_index_mips(map, {}, [](int, int, const std::uint16_t* rows) { benchmark::DoNotOptimize(rows); });
  bench::report(state, indices.size() * 2 * 7 / 3, indices.size());  // the base is read, and all levels are written
}
BENCHMARK(index_mips)->Arg(256)->Arg(2048)->Arg(16384);

}  // namespace
}  // namespace burnish
