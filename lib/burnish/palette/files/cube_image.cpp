#include "burnish/palette/files/cube_image.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "burnish/core/error.h"
#include "burnish/core/parallel.h"
#include "burnish/palette/indexed_map.h"

namespace burnish {
namespace {

using ColourOf = std::function<Colour(const TexelRows& rows, int x, int y)>;

constexpr int kRows = 64;

// The colours of the texels that count, from the first on and round again.
class CountedColours {
 public:
  CountedColours(OpenMap map, const ColourOf& colour_of) : map_(std::move(map)), colour_of_(colour_of) {}
  // None where no texel counts.
  std::optional<Colour> next() {
    for (std::size_t left = none_ ? 0 : std::size_t(map_.width()) * map_.height(); left > 0; left--) {
      advance();
      if (rows_.counts_at(x_, y_)) return colour_of_(rows_, x_, y_);
    }
    none_ = true;
    return std::nullopt;
  }

 private:
  void advance() {
    if (++x_ < rows_.width) return;
    x_ = 0;
    if (++y_ < rows_.count) return;
    first_ += rows_.count;
    if (first_ == map_.height()) first_ = 0;
    map_.read_rows(first_, std::min(kRows, map_.height() - first_), rows_);
    y_ = 0;
  }

  OpenMap map_;
  const ColourOf& colour_of_;
  TexelRows rows_;
  bool none_ = false;
  int first_ = 0, x_ = 0, y_ = 0;  // of rows_ in the map; in rows_
};

}  // namespace

void write_cube_image(const FileRef& file, const MapFiles& files, const NormalCoding& coding, const MaterialCube& cube,
                      const std::vector<int>& materials) {
  std::vector<int> number(256);
  for (std::size_t k = 0; k < materials.size(); k++) number[materials[k]] = int(k);
  const ColourOf colour_of = [&](const TexelRows& rows, int x, int y) {
    bool invalid;
    return cube.encode(number[rows.material_at(x, y)], TexelKeys::decode(rows.row(y)[x], invalid));
  };
  OpenMap map(files, coding);
  std::optional<CountedColours> counted;
  if (!files.mask.empty()) counted.emplace(OpenMap(files, coding), colour_of);
  const int channels = cube.channels();
  ImageWriter writer(file, FileType::kPng, SampleType::kUint8, map.width(), map.height(), channels);
  TexelRows rows;
  ByteImage image(map.width(), kRows, channels);
  const auto set = [&](int x, int y, const Colour& c) {
    for (int i = 0; i < channels; i++) image.at(x, y)[i] = std::uint8_t(c[i]);
  };
  for (int y0 = 0; y0 < map.height(); y0 += kRows) {
    map.read_rows(y0, std::min(kRows, map.height() - y0), rows);
    parallel_for(rows.count, [&](std::size_t y) {
      for (int x = 0; x < rows.width; x++) set(x, int(y), colour_of(rows, x, int(y)));
    });
    for (int y = 0; y < rows.count && counted; y++)
      for (int x = 0; x < rows.width; x++)
        if (!rows.counts_at(x, y))
          if (const std::optional<Colour> colour = counted->next()) set(x, y, *colour);
    writer.write_rows_stored(rows.count, image.data.data());
  }
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
