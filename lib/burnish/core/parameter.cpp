#include "burnish/core/parameter.h"

#include <cmath>
#include <utility>

#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/whole_image.h"

namespace burnish {

void Parameter::require(const std::function<bool(float)>& holds, const std::string& wanted) const {
  if (!values.empty()) return require_samples(name, values, width, 1, 0, 1, holds, wanted, first_row);
  if (!holds(number)) throw Error(ErrorKind::kUsage, name + ": expected " + wanted + ", got " + number_text(number));
}

struct ParameterReader::Map {
  explicit Map(const FileRef& file) : image(file) {
    const auto number = [&](const char* attribute, float otherwise) {
      const auto numbers = image.numbers(attribute);
      return numbers && !numbers->empty() ? float(numbers->front()) : otherwise;
    };
    scale = number("burnish:scale", 1), bias = number("burnish:bias", 0);
  }

  void read_rows(int first, int count, float* out) {
    const std::size_t channels = std::size_t(image.channels()), texels = std::size_t(image.width()) * count;
    band.resize(texels * channels);
    image.read_rows(first, count, band.data());
    for (std::size_t i = 0; i < texels; i++) out[i] = band[i * channels] * scale + bias;
  }

  ImageReader image;
  float scale, bias;
  std::vector<float> band;
};

ParameterReader::ParameterReader(const std::string& name, const ParameterSource& source, SharedSize& size)
    : name_(name) {
  if (source.map.empty()) {
    number_ = float(source.number);
    const bool lost = std::isfinite(source.number) && (!std::isfinite(number_) || (number_ == 0 && source.number != 0));
    if (lost)
      throw Error(ErrorKind::kUsage,
                  name + ": expected a number within single precision, got " + number_text(source.number));
    return;
  }
  name_ = source.map.name;
  map_ = std::make_unique<Map>(source.map);
  size.take(map_->image.width(), map_->image.height(), name_);
}

ParameterReader::~ParameterReader() = default;
ParameterReader::ParameterReader(ParameterReader&&) noexcept = default;

Parameter ParameterReader::rows(int first, int count) {
  Parameter band{name_, number_, {}, 0, 0};
  if (!map_) return band;
  const int width = map_->image.width();
  band.width = width, band.first_row = first;
  band.values = read_whole<float>(name_, count, std::size_t(width),
                                  [&](int row, int some, float* out) { map_->read_rows(first + row, some, out); });
  return band;
}

Parameter read_parameter(const std::string& name, const ParameterSource& source, SharedSize& size) {
  ParameterReader reader(name, source, size);
  return reader.rows(0, size.height);
}

}  // namespace burnish
