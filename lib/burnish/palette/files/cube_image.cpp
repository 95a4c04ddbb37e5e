#include "burnish/palette/files/cube_image.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/indexed_map.h"

namespace burnish {
namespace {

// Texels whose mask is 0 take the colours of the others, one after the other and round again.
void fill_masked(const TexelClasses& classes, ByteImage& image) {
  const auto counts = [&](std::size_t i) { return classes.mask.data[i] != 0; };
  const std::size_t texels = image.texels();
  if (classes.mask.data.empty() || std::ranges::count(classes.mask.data, 0) == std::ptrdiff_t(texels)) return;
  std::size_t from = texels - 1;
  for (std::size_t i = 0; i < texels; i++) {
    if (counts(i)) continue;
    do from = (from + 1) % texels;
    while (!counts(from));
    std::copy_n(image.data.data() + from * image.channels, image.channels, image.data.data() + i * image.channels);
  }
}

}  // namespace

void write_cube_image(const FileRef& file, OpenMap& map, const MaterialCube& cube, const std::vector<int>& materials) {
  const int w = map.texels.width(), h = map.texels.height();
  std::vector<int> number(256);
  for (std::size_t k = 0; k < materials.size(); k++) number[materials[k]] = int(k);
  ByteImage image(w, h, cube.channels());
  constexpr int kRows = 64;
  std::vector<std::uint64_t> keys(std::size_t(w) * kRows);
  for (int y0 = 0; y0 < h; y0 += kRows) {
    const int rows = std::min(kRows, h - y0);
    map.texels.read_rows(y0, rows, keys.data());
    parallel_for(rows, [&](std::size_t r) {
      for (int x = 0; x < w; x++) {
        bool invalid;
        const Vec3f normal = map.texels.decode(keys[r * w + x], invalid);
        const Colour c = cube.encode(number[map.classes.material_at(x, y0 + int(r))], normal);
        for (int i = 0; i < image.channels; i++) image.at(x, y0 + int(r))[i] = std::uint8_t(c[i]);
      }
    });
  }
  fill_masked(map.classes, image);
  ImageWriter writer(file, FileType::kPng, SampleType::kUint8, w, h, image.channels);
  writer.write_rows_stored(h, image.data.data());
  writer.close();
}

std::vector<Colour> read_cube_colours(const FileRef& file, const MaterialCube& cube) {
  const auto refuse = [&](const std::string& got) {
    return file_error(ErrorKind::kMalformed, file.name,
                      "expected " + std::to_string(cube.channels()) + " channels of a quantizer's colours, got " + got);
  };
  if (has_own_palette(file))
    throw refuse("a palette of normals, as burnish writes it: leave --material-encoding out, which it does not need");
  ImageReader reader(file);
  const int channels = reader.channels();
  if (channels < cube.channels()) throw refuse(std::to_string(channels));
  if (!reader.has_exact_samples() || reader.sample_type() != SampleType::kUint8)
    throw file_error(ErrorKind::kMalformed, file.name,
                     std::string("expected colours of uint8, got ") + name(reader.sample_type()));
  std::set<Colour> colours;
  std::vector<std::uint8_t> row(std::size_t(reader.width()) * channels);
  Colour last{};
  for (int y = 0; y < reader.height(); y++) {
    reader.read_rows_stored(y, 1, row.data());
    for (int x = 0; x < reader.width(); x++) {
      Colour c{0, 0, 0, 255};
      for (int i = 0; i < cube.channels(); i++) c[i] = row[std::size_t(x) * channels + i];
      if (c != last || colours.empty()) colours.insert(last = c);
    }
    if (colours.size() > std::size_t(kMaxPaletteSize))
      throw file_error(ErrorKind::kMalformed, file.name, "expected at most 65536 colours, got more: is it quantized?");
  }
  return {colours.begin(), colours.end()};
}

}  // namespace burnish
