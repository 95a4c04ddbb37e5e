// How much nearer one mip chain of material textures is than another to the mean reflectance of what is under each
// texel.
//
//   compare-mips BASE CHAIN OTHER      prefixes, as of burnish-material and burnish-mipmap
//
// Over 512 random pairs of lights within 72.5° and views within 46° of (0,0,1), whole blocks of the base only. CSV: the
// level, RMS error of either chain over the RMS of the mean, and how much nearer the first is in dB.
#include <cmath>
#include <random>

#include "burnish/core/parallel.h"
#include "burnish/material/mips/lobe_kernels.h"
#include "program.h"

using namespace burnish;

namespace {

std::vector<PairBlock> random_pairs() {
  std::vector<PairBlock> blocks(32);
  std::mt19937_64 random(1);
  const auto uniform = [&](double most) { return most * double(random()) / double(std::mt19937_64::max()); };
  const auto direction = [&](double cosine) {
    const double turn_rad = uniform(2 * kPi), sine = std::sqrt(1 - cosine * cosine);
    return Vec3d{sine * std::cos(turn_rad), sine * std::sin(turn_rad), cosine};
  };
  const auto put = [](Vec3d v, float(&to)[3][PairBlock::kPairs], int i) {
    to[0][i] = float(v.x), to[1][i] = float(v.y), to[2][i] = float(v.z);
  };
  for (PairBlock& block : blocks)
    for (int i = 0; i < PairBlock::kPairs; i++) {
      const Vec3d l = direction(1 - uniform(0.7)), v = direction(std::cos(uniform(0.8)));
      put(l, block.l, i), put(v, block.v, i), put(normalized(l + v), block.h, i);
    }
  return blocks;
}

MaterialTextures textures_of(const std::string& prefix) {
  return read_material_textures(material_file(prefix, 't'), material_file(prefix, 'b'), material_file(prefix, 'n'));
}

struct Sums {
  double square = 0, error[2] = {};
  Sums& operator+=(const Sums& o) {
    square += o.square, error[0] += o.error[0], error[1] += o.error[1];
    return *this;
  }
};

}  // namespace

int main(int argc, char** argv) {
  return run_program("compare-mips BASE CHAIN OTHER", argc, argv, [](const Arguments& a) {
    const MaterialTextures base = textures_of(a[0]), chains[] = {textures_of(a[1]), textures_of(a[2])};
    const std::vector<PairBlock> pairs = random_pairs();
    const std::size_t count = pairs.size() * PairBlock::kPairs;
    std::puts("level,error,other_error,nearer_db");
    for (int level = 1; level < int(chains[0].t.levels.size()); level++) {
      const int side = 1 << level, width = base.width() / side, height = base.height() / side;
      if (width == 0 || height == 0) break;
      const Sums sums = parallel_sum<Sums>(std::size_t(width) * height, 1, [&](std::size_t begin, std::size_t end) {
        Sums s;
        std::vector<float> one(count);
        std::vector<double> mean(count);
        const auto reflect = [&](const MaterialTextures& of, int l, int x, int y) {
          kernels::reflectance(of.model, lobe_at(of, l, x, y), pairs, one.data());
        };
        for (std::size_t texel = begin; texel < end; texel++) {
          const int x = int(texel % width), y = int(texel / width);
          std::ranges::fill(mean, 0);
          for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++) {
              reflect(base, 0, x * side + i, y * side + j);
              for (std::size_t p = 0; p < count; p++) mean[p] += one[p] / (double(side) * side);
            }
          for (const double m : mean) s.square += m * m;
          for (int c = 0; c < 2; c++) {
            reflect(chains[c], level, x, y);
            for (std::size_t p = 0; p < count; p++) s.error[c] += std::pow(one[p] - mean[p], 2);
          }
        }
        return s;
      });
      std::printf("%d,%.4f,%.4f,%.1f\n", level, std::sqrt(sums.error[0] / sums.square),
                  std::sqrt(sums.error[1] / sums.square), 10 * std::log10(sums.error[1] / sums.error[0]));
    }
  });
}
