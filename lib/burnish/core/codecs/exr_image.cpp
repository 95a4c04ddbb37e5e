#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <tuple>

#include "burnish/core/codecs/exr_file.h"
#include "burnish/core/codecs/image_codecs.h"
#include "burnish/core/lower_case.h"

namespace burnish::detail {
namespace {

// By layer, within one by what names are known to mean, then by themselves. X is known beside Y or Z only, and so is Z
// as the third of them: by itself it is a depth.
void sort(std::vector<ExrChannel>& channels) {
  static constexpr std::string_view kKnown[] = {"r",  "red",  "g",    "green",   "b",     "blue", "x",  "y",
                                                "z",  "real", "imag", "a",       "alpha", "ar",   "ra", "ag",
                                                "ga", "ab",   "ba",   "z alone", "depth", "zback"};
  const auto parts = [](const std::string& name) {
    const std::size_t at = name.rfind('.') + 1;
    return std::pair(name.substr(0, at), lower_case(name.substr(at)));
  };
  std::set<std::pair<std::string, std::string>> names;
  for (const ExrChannel& c : channels) names.insert(parts(c.name));
  std::ranges::sort(channels, {}, [&](const ExrChannel& c) {
    auto [layer, known] = parts(c.name);
    const bool vectors = names.contains({layer, "x"}) && (names.contains({layer, "y"}) || names.contains({layer, "z"}));
    if ((known == "x" || known == "z") && !vectors) known += " alone";
    return std::tuple(std::move(layer), std::ranges::find(kKnown, known) - kKnown, c.name);
  });
}

class ExrSource final : public ImageSource {
 public:
  explicit ExrSource(const FileRef& file) : in_(file), channels_(in_.channels()) {
    const ExrReader::Windows& windows = in_.windows();
    require_whole(file, windows.whole, {in_.width(), in_.height()}, {windows.full_width, windows.full_height});
    sort(channels_);
    form_.width = in_.width(), form_.height = in_.height();
    for (const ExrChannel& c : channels_) {
      form_.channel_names.push_back(c.name);
      form_.texel_bytes += size_of(c.type);
    }
    const ExrType type = channels_[0].type;
    const bool alike = std::ranges::count(channels_, type, &ExrChannel::type) == std::ssize(channels_);
    form_.integer = alike && type == ExrType::kUint;
    form_.exact = alike && type != ExrType::kUint;
    form_.sample = form_.integer                     ? SampleType::kUint16
                   : alike && type == ExrType::kHalf ? SampleType::kHalf
                                                     : SampleType::kFloat;
    for (const auto& [name, value] : in_.attributes()) {
      if (const auto* text = std::get_if<std::string>(&value); text && !text->empty())
        form_.attributes.emplace_back(name == "comments" ? "ImageDescription" : name, *text);
      else if (const auto* floats = std::get_if<std::vector<float>>(&value); floats && !floats->empty())
        form_.attributes.emplace_back(name, std::vector<double>(floats->begin(), floats->end()));
    }
  }

  void read_rows(int first, int count, float* out) override { read(0, first, count, out); }
  void read_rows_stored(int first, int count, void* out) override {
    const ExrType type = channels_[0].type;
    in_.read_rows(0, first, count, slices(form_.width, out, size_of(type), type));
  }
  int levels() override { return in_.levels(); }
  LevelSize level_size(int level) override { return {in_.width(level), in_.height(level)}; }
  void read_level(int level, float* out) override { read(level, 0, in_.height(level), out); }

 private:
  // All channels, interleaved.
  std::vector<ExrSlice> slices(int width, void* out, std::size_t sample_bytes, ExrType type) const {
    const std::size_t texel_bytes = sample_bytes * channels_.size();
    std::vector<ExrSlice> slices;
    for (std::size_t c = 0; c < channels_.size(); c++)
      slices.push_back(
          {channels_[c].name, type, static_cast<char*>(out) + sample_bytes * c, texel_bytes, texel_bytes * width});
    return slices;
  }

  void read(int level, int first, int count, float* out) {
    const int width = in_.width(level);
    in_.read_rows(level, first, count, slices(width, out, sizeof(float), ExrType::kFloat));
    for (std::size_t c = 0; c < channels_.size(); c++) {
      if (channels_[c].type != ExrType::kUint) continue;
      const std::size_t samples = channels_.size() * width * count;
      for (std::size_t i = c; i < samples; i += channels_.size()) out[i] *= 0x1p-32f;  // to [0,1]
    }
  }

  ExrReader in_;
  std::vector<ExrChannel> channels_;  // in the order they are shown in
};

class ExrSink final : public ImageSink {
 public:
  ExrSink(const FileRef& file, const ExrForm& form) : out_(file, form) {}
  void write_rows(int count, const void* rows) override { out_.write_rows(0, count, rows); }
  void close() override { out_.close(); }

 private:
  ExrWriter out_;
};

}  // namespace

ExrForm exr_form(const ImageShape& shape, int levels) {
  ExrForm form{shape.width,
               shape.height,
               levels,
               shape.channel_names,
               shape.sample == SampleType::kHalf ? ExrType::kHalf : ExrType::kFloat,
               {}};
  form.short_vectors = true;
  for (const auto& [name, value] : shape.attributes) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      form.attributes.emplace_back(name == "ImageDescription" ? "comments" : name, *text);
    } else {
      const auto& numbers = std::get<std::vector<double>>(value);
      form.attributes.emplace_back(name, std::vector<float>(numbers.begin(), numbers.end()));
    }
  }
  return form;
}

std::unique_ptr<ImageSource> open_exr_image(const FileRef& file) { return std::make_unique<ExrSource>(file); }

std::unique_ptr<ImageSink> create_exr_image(const FileRef& file, const ImageShape& shape) {
  return std::make_unique<ExrSink>(file, exr_form(shape, 1));
}

}  // namespace burnish::detail
