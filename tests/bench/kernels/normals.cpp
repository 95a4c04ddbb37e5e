// Displacement to normals, and the means of their mip levels.
#include <cmath>
#include <cstdint>
#include <vector>

#include "bandwidth.h"
#include "burnish/core/mip_average.h"
#include "burnish/core/parallel.h"
#include "burnish/normal/band_fitter.h"

namespace burnish {
namespace {

constexpr int kWidth = 4096, kRows = 128;

float height(int x, int y) { return 0.5f + 0.25f * std::sin(0.05f * float(x)) * std::cos(0.031f * float(y)); }

struct Fitting {
  Fitting(int neighbors, SampleType sample)
      : neighborhood(make_neighborhood(neighbors, FitWeights::kUniform)),
        target{{}, FileType::kTiff, sample, {}},
        fitter(neighborhood, options, kWidth, kRows, target, "bench") {
    band.rows = kRows, band.stride = kWidth + 2 * neighborhood.radius;
    band.displacement.resize(std::size_t(kRows + 2 * neighborhood.radius) * band.stride);
    for (std::size_t i = 0; i < band.displacement.size(); i++)
      band.displacement[i] = height(int(i % band.stride), int(i / band.stride));
  }

  Neighborhood neighborhood;
  static HeightMapOptions repeated() {
    HeightMapOptions options;
    options.height = 20, options.wrap_u = options.wrap_v = Wrap::kRepeat;
    return options;
  }

  HeightMapOptions options = repeated();
  NormalMapTarget target;
  BandFitter fitter;
  HeightBand band;
};

void plane_fit_float_to_float(benchmark::State& state) {
  const Fitting f(int(state.range(0)), SampleType::kFloat);
  for (auto _ : state) benchmark::DoNotOptimize(f.fitter.fit(f.band));
  bench::report(state, std::size_t(kWidth) * kRows * (4 + 12), std::size_t(kWidth) * kRows);
}
BENCHMARK(plane_fit_float_to_float)->Arg(4)->Arg(8)->Arg(24)->Arg(80);

void plane_fit_uint16_to_uint8(benchmark::State& state) {
  Fitting f(int(state.range(0)), SampleType::kUint8);
  std::vector<std::uint16_t> stored(f.band.displacement.size());
  for (std::size_t i = 0; i < stored.size(); i++) stored[i] = std::uint16_t(f.band.displacement[i] * 65535.f);
  for (auto _ : state) {
    for (std::size_t i = 0; i < stored.size(); i++) f.band.displacement[i] = float(stored[i]) * (1.f / 65535.f);
    benchmark::DoNotOptimize(f.fitter.fit(f.band));
  }
  bench::report(state, std::size_t(kWidth) * kRows * (2 + 3), std::size_t(kWidth) * kRows);
}
BENCHMARK(plane_fit_uint16_to_uint8)->Arg(4)->Arg(8)->Arg(24)->Arg(80);

void mip_level_means(benchmark::State& state) {
  const ThreadLimit one(1);
  Image image(2048, 2048, 3);
  for (std::size_t i = 0; i < image.data.size(); i++) image.data[i] = height(int(i % 6144), int(i / 6144));
  for (auto _ : state) benchmark::DoNotOptimize(next_mean_level(image));
  bench::report(state, image.data.size() * 5, image.data.size() / 3);  // and a quarter of it is written
}
BENCHMARK(mip_level_means);

}  // namespace
}  // namespace burnish
