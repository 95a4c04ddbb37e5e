#include <algorithm>

#include "burnish/core/codecs/png_file.h"
#include "burnish/core/error.h"
#include "burnish/palette/files/indexed_files.h"
#include "burnish/palette/files/png_metadata.h"

namespace burnish::detail {
namespace {

Palette palette_of(const PngForm& form, const FileRef& file, GreenAxis green) {
  if (const std::string* text = metadata_of(form)) return palette_from_metadata(*text, file);
  Palette palette;
  const float y_sign = green == GreenAxis::kDown ? -1.f : 1.f;
  for (const PngColour& c : form.palette) {
    const Vec3d v{c[0] / 127.5 - 1, y_sign * (c[1] / 127.5 - 1), c[2] / 127.5 - 1};
    palette.normals.push_back(length(v) < 1e-3 ? Vec3f{0, 0, 1} : Vec3f(normalized(v)));
  }
  palette.materials = {{0, 0, int(form.palette.size())}};
  return palette;
}

class PngSource final : public IndexSource {
 public:
  PngSource(const FileRef& file, GreenAxis green) : in_(file, PngSamples::kStored) {
    width = in_.form().width, height = in_.form().height;
    palette = palette_of(in_.form(), file, green);
  }

  void read_rows(int, int first, int count, std::uint16_t* out) override {
    if (in_.form().bits == 16) return in_.read_rows(first, count, out);
    std::vector<std::uint8_t> row(width);
    for (int y = first; y < first + count; y++, out += width) {
      in_.read_rows(y, 1, row.data());
      std::ranges::copy(row, out);
    }
  }

 private:
  PngReader in_;
};

PngForm form_of(const IndexShape& shape) {
  PngForm form{shape.width, shape.height, 1, 16, {}, {metadata_text(shape.palette)}};
  if (shape.palette.normals.size() > 256) return form;
  form.bits = 8;
  for (const Vec3f& n : shape.palette.normals) form.palette.push_back(to_colour(n));
  return form;
}

class PngTarget final : public IndexTarget {
 public:
  PngTarget(const FileRef& file, const IndexShape& shape)
      : out_(file, form_of(shape)), width_(shape.width), small_(shape.palette.normals.size() <= 256) {}

  void write_rows(int, int count, const std::uint16_t* rows) override {
    if (!small_) return out_.write_rows(count, rows);
    std::vector<std::uint8_t> row(width_);
    for (int y = 0; y < count; y++, rows += width_) {
      std::copy_n(rows, width_, row.begin());
      out_.write_rows(1, row.data());
    }
  }
  void close() override { out_.close(); }

 private:
  PngWriter out_;
  int width_;
  bool small_;
};

}  // namespace

bool is_indexed_png(const FileRef& file) {
  try {
    const PngReader in(file, PngSamples::kStored);
    return !in.form().palette.empty() || (in.form().channels == 1 && metadata_of(in.form()));
  } catch (const Error&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_png(const FileRef& file, GreenAxis green) {
  return std::make_unique<PngSource>(file, green);
}

std::unique_ptr<IndexTarget> create_indexed_png(const FileRef& file, const IndexShape& shape) {
  return std::make_unique<PngTarget>(file, shape);
}

}  // namespace burnish::detail
