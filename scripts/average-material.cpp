// Mip chains of material textures by averaging and renormalising, as colours and normals are commonly treated: what
// burnish-mipmap --kind material is held against.
//
//   average-material PREFIX OUT      of burnish-material --encode float --extension exr; writes OUT_t, OUT_b, OUT_n
#include <cmath>
#include <string>
#include <vector>

#include "burnish/core/mip_average.h"
#include "burnish/material/material_textures.h"
#include "program.h"

using namespace burnish;

namespace {

double length_of(const float* v) { return std::sqrt(double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2]); }

// Vectors take the mean length of the base's; further channels are averaged as they are.
void average(MaterialTexture& texture) {
  const Image& base = texture.levels[0];
  Image means = base, lengths(base.width, base.height, 1);
  for (std::size_t i = 0; i < lengths.data.size(); i++)
    lengths.data[i] = float(length_of(&base.data[i * base.channels]));
  while (means.width > 1 || means.height > 1) {
    means = next_mean_level(means), lengths = next_mean_level(lengths);
    Image level = means;
    for (std::size_t i = 0; i < lengths.data.size(); i++) {
      float* v = &level.data[i * level.channels];
      const double mean_length = length_of(v);
      for (int c = 0; c < 3 && mean_length > 0; c++) v[c] = float(v[c] * (lengths.data[i] / mean_length));
    }
    texture.levels.push_back(level);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("average-material PREFIX OUT", argc, argv, [](const Arguments& a) {
    const auto file = [](const std::string& prefix, char which) {
      return material_file(prefix, which, FileType::kExr);
    };
    MaterialTextures textures = read_material_textures(file(a[0], 't'), file(a[0], 'b'), file(a[0], 'n'));
    for (MaterialTexture* texture : {&textures.t, &textures.b, &textures.n}) average(*texture);
    write_material_textures(textures, file(a[1], 't'), file(a[1], 'b'), file(a[1], 'n'), FileType::kExr,
                            SampleType::kFloat);
  });
}
