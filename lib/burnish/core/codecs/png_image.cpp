#include <algorithm>

#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/codecs/png_file.h"
#include "burnish/core/lower_case.h"

namespace burnish::detail {
namespace {

const std::string kDescription = "Description";  // of PNG; here it is ImageDescription

class PngSource final : public ImageSource {
 public:
  explicit PngSource(const FileRef& file) : in_(file, PngSamples::kColours) {
    const PngForm& png = in_.form();
    form_.width = png.width, form_.height = png.height;
    form_.channel_names = {"R", "G", "B", "A"};
    if (png.channels < 3) form_.channel_names = {"Y", "A"};
    form_.channel_names.resize(png.channels);
    form_.sample = png.bits == 16 ? SampleType::kUint16 : SampleType::kUint8;
    form_.texel_bytes = std::size_t(png.channels) * png.bits / 8;
    for (const PngText& text : png.texts)
      form_.attributes.emplace_back(lower_case(text.key) == "description" ? "ImageDescription" : text.key, text.text);
  }

  void read_rows(int first, int count, float* out) override {
    // By a part at a time, so that what is stored takes little room beside what it becomes.
    constexpr std::size_t kBytes = std::size_t(1) << 20;
    const int at_once = int(std::max<std::size_t>(1, kBytes / (form_.texel_bytes * form_.width)));
    const std::size_t row_samples = std::size_t(form_.width) * form_.channels();
    for (int end = first + count; first < end; first += at_once) {
      const int some = std::min(at_once, end - first);
      stored_.resize(form_.texel_bytes * form_.width * some);
      in_.read_rows(first, some, stored_.data());
      const std::size_t samples = row_samples * some;
      if (form_.sample == SampleType::kUint8) scale(stored_.data(), samples, 1.f / 255, out);
      else scale(reinterpret_cast<const std::uint16_t*>(stored_.data()), samples, 1.f / 65535, out);
      out += samples;
    }
  }
  void read_rows_stored(int first, int count, void* out) override { in_.read_rows(first, count, out); }

 private:
  template <typename T>
  static void scale(const T* from, std::size_t count, float by, float* to) {
    for (std::size_t i = 0; i < count; i++) to[i] = float(from[i]) * by;
  }

  PngReader in_;
  std::vector<std::uint8_t> stored_;
};

class PngSink final : public ImageSink {
 public:
  PngSink(const FileRef& file, const PngForm& form) : out_(file, form) {}
  void write_rows(int count, const void* rows) override { out_.write_rows(count, rows); }
  void close() override { out_.close(); }

 private:
  PngWriter out_;
};

}  // namespace

std::unique_ptr<ImageSource> open_png_image(const FileRef& file) { return std::make_unique<PngSource>(file); }

std::unique_ptr<ImageSink> create_png_image(const FileRef& file, const ImageShape& shape) {
  if (shape.channels() > 4)
    throw file_error(ErrorKind::kIo, file.name,
                     "cannot be written: PNG holds 1 to 4 channels, not " + std::to_string(shape.channels()));
  PngForm form{shape.width, shape.height, shape.channels(), shape.sample == SampleType::kUint16 ? 16 : 8, {}, {}};
  for (const auto& [name, value] : shape.attributes)
    form.texts.push_back({name == "ImageDescription" ? kDescription : name, std::get<std::string>(value)});
  return std::make_unique<PngSink>(file, form);
}

}  // namespace burnish::detail
