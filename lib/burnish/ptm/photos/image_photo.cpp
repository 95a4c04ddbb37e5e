// Photographs in what ImageReader reads, and the choice of the reader.
#include <cmath>
#include <fstream>
#include <string_view>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/ptm/photos/photo.h"

namespace burnish {
namespace {

constexpr int kWhite = 255;

// R, G, B of texels of any number of channels.
template <typename T>
void take_colours(const std::vector<T>& from, int channels, T* rgb) {
  const int green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  for (std::size_t i = 0; i < from.size(); i += channels, rgb += 3)
    rgb[0] = from[i], rgb[1] = from[i + green], rgb[2] = from[i + blue];
}

// PNG says so in the last byte of its header; TIFF, EXR and BMP come in rows, of all else the codec may hold
// everything.
bool is_read_whole(const FileRef& file) {
  char head[29] = {};
  std::ifstream(file.path, std::ios::binary).read(head, sizeof head);
  const std::string_view h(head, sizeof head);
  if (h.starts_with("\x89PNG")) return h[28] != 0;
  return !h.starts_with("II") && !h.starts_with("MM") && !h.starts_with("v/1\x01") && !h.starts_with("BM");
}

class ImagePhoto : public Photo {
 public:
  explicit ImagePhoto(const FileRef& file) : in_(file) {
    form_.width = in_.width(), form_.height = in_.height();
    form_.bytes = in_.integer() && in_.sample_type() == SampleType::kUint8 && in_.has_exact_samples();
    form_.whole = is_read_whole(file);
  }

  void read(int rows, std::uint8_t* rgb) override {
    std::vector<std::uint8_t> texels(std::size_t(rows) * form_.width * in_.channels());
    in_.read_rows_stored(next_, rows, texels.data());
    take_colours(texels, in_.channels(), rgb);
    next_ += rows;
  }

  void read(int rows, float* rgb) override {
    std::vector<float> texels(std::size_t(rows) * form_.width * in_.channels());
    in_.read_rows(next_, rows, texels.data());
    take_colours(texels, in_.channels(), rgb);
    const std::size_t row = std::size_t(form_.width) * 3;
    for (std::size_t i = 0; i < row * rows; i++) {
      if (!std::isfinite(rgb[i]))
        throw file_error(ErrorKind::kMalformed, in_.name(),
                         "expected finite values, got " + number_text(rgb[i]) + " at column " +
                             std::to_string(i % row / 3) + ", row " + std::to_string(next_ + i / row));
      rgb[i] *= kWhite;
    }
    next_ += rows;
  }

 private:
  ImageReader in_;
  int next_ = 0;
};

}  // namespace

std::unique_ptr<Photo> detail::open_image_photo(const FileRef& file) { return std::make_unique<ImagePhoto>(file); }

std::unique_ptr<Photo> open_photo(const FileRef& file) {
  require_readable(file);
  return detail::is_jpeg(file) ? detail::open_jpeg_photo(file) : detail::open_image_photo(file);
}

}  // namespace burnish
