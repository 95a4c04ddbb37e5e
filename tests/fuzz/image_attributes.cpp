// What images say beside their texels: lookup tables, polynomial texture maps and material textures, of which t, b and
// n each stand beside two sound ones of Ward's model.
#include <algorithm>
#include <vector>

#include "burnish/brdf/tables/table_file.h"
#include "burnish/core/error.h"
#include "burnish/material/material_textures.h"
#include "burnish/ptm/files/ptm_exr.h"
#include "target.h"

namespace {

using namespace burnish;

struct SoundTextures {
  fuzz::MemoryFile t{"sound_t.exr"}, b{"sound_b.exr"}, n{"sound_n.exr"};

  SoundTextures() {
    MaterialTextures textures;
    for (auto [texture, channels] : {std::pair(&textures.t, 3), {&textures.b, 3}, {&textures.n, 4}})
      texture->levels.emplace_back(2, 2, channels);
    write_material_textures(textures, t.ref(), b.ref(), n.ref(), FileType::kExr, SampleType::kHalf);
  }
};

void read_ptm(const FileRef& file) {
  const auto rows = open_ptm_exr(file);
  const PtmShape& shape = rows->shape();
  constexpr int kRows = 16;
  std::vector<float> coefficients(std::size_t(shape.width) * kRows * shape.polynomials() * kPtmTerms),
      colour(std::size_t(shape.width) * kRows * shape.colours());
  for (int y = 0; y < shape.height; y += kRows)
    rows->read(y, std::min(kRows, shape.height - y), coefficients.data(), colour.data());
}

// Of several readers one may take the file.
template <typename Read>
void attempt(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInternal) throw;
  }
}

void read(const FileRef& file) {
  static const SoundTextures sound;
  attempt([&] { read_table(file); });
  attempt([&] { read_ptm(file); });
  attempt([&] { read_material_textures(file, sound.b.ref(), sound.n.ref()); });
  read_material_textures(sound.t.ref(), sound.b.ref(), file);
}

const fuzz::Target target("image_attributes", "image", read);

}  // namespace
