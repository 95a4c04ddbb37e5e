// Fitting polynomial texture maps, block by block of 64 texels.
#include <cmath>
#include <cstdint>
#include <vector>

#include "bandwidth.h"
#include "burnish/ptm/fit/fit_kernels.h"
#include "burnish/ptm/light_matrix.h"

namespace burnish {
namespace {

void ptm_band(benchmark::State& state) {
  const std::size_t photos = std::size_t(state.range(0)), blocks = 64, stride = blocks * kernels::kSamples;
  std::vector<Vec3d> lights(photos);
  for (std::size_t i = 0; i < photos; i++) {
    const double z = 1 - 0.9 * (double(i) + 0.5) / double(photos), r = std::sqrt(1 - z * z), turn = 2.4 * double(i);
    lights[i] = {r * std::cos(turn), r * std::sin(turn), z};
  }
  const LightMatrix matrix = light_matrix(lights, 0, "bench");
  const auto root = upper_factor(matrix.normal);
  std::vector<std::uint8_t> samples(photos * stride);
  for (std::size_t i = 0; i < samples.size(); i++) samples[i] = std::uint8_t(i * 2654435761u >> 24);
  kernels::SampleTerms channels;
  kernels::TexelTerms texels;
  for (auto _ : state)
    for (std::size_t block = 0; block < blocks; block++) {
      kernels::project(kernels::BlockSamples<std::uint8_t>{samples.data() + block * kernels::kSamples, stride},
                       matrix.pseudo_inverse, channels);
      kernels::rank_one(channels, root, texels);
      benchmark::DoNotOptimize(texels);
    }
  bench::report(state, samples.size() + blocks * sizeof texels, blocks * kernels::kTexels);
}
BENCHMARK(ptm_band)->Arg(6)->Arg(50)->Arg(200);

}  // namespace
}  // namespace burnish
