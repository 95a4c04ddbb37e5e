#include <algorithm>
#include <cstring>

#include "burnish/palette/files/indexed_files.h"
#include "burnish/palette/files/png_file.h"

namespace burnish::detail {
namespace {

Palette palette_of(const PngReader& in, const FileRef& file, GreenAxis green) {
  if (const std::optional<std::string> text = in.text()) return palette_from_metadata(*text, file);
  Palette palette;
  png_colorp colours;
  int count = 0;
  png_get_PLTE(in.png, in.info, &colours, &count);
  const float y_sign = green == GreenAxis::kDown ? -1.f : 1.f;
  for (int i = 0; i < count; i++) {
    const Vec3d v{colours[i].red / 127.5 - 1, y_sign * (colours[i].green / 127.5 - 1), colours[i].blue / 127.5 - 1};
    palette.normals.push_back(length(v) < 1e-3 ? Vec3f{0, 0, 1} : Vec3f(normalized(v)));
  }
  palette.materials = {{0, 0, count}};
  return palette;
}

class PngSource final : public IndexSource {
 public:
  PngSource(const FileRef& file, GreenAxis green) : file_(file) {
    open();
    palette = palette_of(*in_, file, green);
  }

  void read_rows(int, int first, int count, std::uint16_t* out) override {
    guarded(file_, ErrorKind::kMalformed, [&] {
      if (interlaced_) return copy_rows(whole(), first, count, out);
      if (first < next_row_) open();
      std::vector<png_byte> row(row_bytes_);
      for (; next_row_ < first + count; next_row_++) {
        png_read_row(in_->png, row.data(), nullptr);
        if (next_row_ >= first) widen(row.data(), out), out += width;
      }
      if (next_row_ == height) png_read_end(in_->png, nullptr);  // what follows is checked too
    });
  }

 private:
  void open() {
    in_.emplace(file_);
    depth_ = png_get_bit_depth(in_->png, in_->info);
    require_room_for(file_, png_get_image_width(in_->png, in_->info), png_get_image_height(in_->png, in_->info),
                     depth_);
    png_set_packing(in_->png);
    if (depth_ == 16) png_set_swap(in_->png);
    interlaced_ = png_set_interlace_handling(in_->png) > 1;
    png_read_update_info(in_->png, in_->info);
    row_bytes_ = png_get_rowbytes(in_->png, in_->info);
    next_row_ = 0;
    const auto size =
        std::pair(int(png_get_image_width(in_->png, in_->info)), int(png_get_image_height(in_->png, in_->info)));
    if (width > 0 && size != std::pair(width, height))
      throw file_error(ErrorKind::kIo, file_.name, "has changed while it was read");
    width = size.first, height = size.second;
  }

  void widen(const png_byte* row, std::uint16_t* out) const {
    if (depth_ == 16) std::memcpy(out, row, row_bytes_);
    else std::copy_n(row, width, out);
  }

  // The rows of an interlaced image come all at once.
  const std::vector<png_byte>& whole() {
    if (whole_.empty()) {
      whole_.resize(row_bytes_ * height);
      std::vector<png_bytep> rows(height);
      for (int y = 0; y < height; y++) rows[y] = whole_.data() + row_bytes_ * y;
      png_read_image(in_->png, rows.data());
      png_read_end(in_->png, nullptr);
    }
    return whole_;
  }
  void copy_rows(const std::vector<png_byte>& from, int first, int count, std::uint16_t* out) const {
    for (int y = first; y < first + count; y++, out += width) widen(from.data() + row_bytes_ * y, out);
  }

  FileRef file_;
  std::optional<PngReader> in_;
  int depth_ = 0, next_row_ = 0;
  bool interlaced_ = false;
  std::size_t row_bytes_ = 0;
  std::vector<png_byte> whole_;
};

class PngTarget final : public IndexTarget {
 public:
  PngTarget(const FileRef& file, const IndexShape& shape)
      : file_(file), out_(file), width_(shape.width), small_(shape.palette.normals.size() <= 256) {
    out_.header(width_, shape.height, small_ ? 8 : 16, small_ ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY,
                shape.palette);
    if (small_) {
      std::vector<png_color> colours;
      for (const Vec3f& n : shape.palette.normals) colours.push_back({to_byte(n.x), to_byte(n.y), to_byte(n.z)});
      png_set_PLTE(out_.png, out_.info, colours.data(), int(colours.size()));
    }
    png_write_info(out_.png, out_.info);
    if (!small_) png_set_swap(out_.png);
  }

  void write_rows(int, int count, const std::uint16_t* rows) override {
    guarded(file_, ErrorKind::kIo, [&] {
      std::vector<png_byte> bytes(width_);
      for (int y = 0; y < count; y++, rows += width_) {
        if (small_) std::copy_n(rows, width_, bytes.begin());
        png_write_row(out_.png, small_ ? bytes.data() : reinterpret_cast<const png_byte*>(rows));
      }
    });
  }

  void close() override {
    guarded(file_, ErrorKind::kIo, [&] { out_.finish(); });
  }

 private:
  FileRef file_;
  PngWriter out_;
  int width_;
  bool small_;
};

}  // namespace

bool is_indexed_png(const FileRef& file) {
  try {
    return PngReader(file).is_indexed();
  } catch (const PngFailure&) {
    return false;  // whoever reads it says what is wrong
  }
}

std::unique_ptr<IndexSource> open_indexed_png(const FileRef& file, GreenAxis green) {
  return guarded(file, ErrorKind::kMalformed, [&] { return std::make_unique<PngSource>(file, green); });
}

std::unique_ptr<IndexTarget> create_indexed_png(const FileRef& file, const IndexShape& shape) {
  return guarded(file, ErrorKind::kIo, [&] { return std::make_unique<PngTarget>(file, shape); });
}

}  // namespace burnish::detail
