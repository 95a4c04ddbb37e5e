#include "burnish/core/parameter.h"

#include <cmath>
#include <utility>

#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/core/texel_check.h"
#include "burnish/core/whole_image.h"

namespace burnish {

void Parameter::require(const std::function<bool(float)>& holds, const std::string& wanted) const {
  if (!values.empty()) return require_samples(name, values, width, 1, 0, 1, holds, wanted);
  if (!holds(number)) throw Error(ErrorKind::kUsage, name + ": expected " + wanted + ", got " + number_text(number));
}

Parameter read_parameter(const std::string& name, const ParameterSource& source, SharedSize& size) {
  if (source.map.empty()) {
    const float number = float(source.number);
    const bool lost = std::isfinite(source.number) && (!std::isfinite(number) || (number == 0 && source.number != 0));
    if (lost)
      throw Error(ErrorKind::kUsage,
                  name + ": expected a number within single precision, got " + number_text(source.number));
    return {name, number, {}, 0};
  }
  ImageReader reader(source.map);
  size.take(reader.width(), reader.height(), source.map.name);
  const auto number = [&](const char* attribute, float otherwise) {
    const auto numbers = reader.numbers(attribute);
    return numbers && !numbers->empty() ? float(numbers->front()) : otherwise;
  };
  const float scale = number("burnish:scale", 1), bias = number("burnish:bias", 0);
  const std::size_t width = std::size_t(reader.width()), channels = std::size_t(reader.channels());
  std::vector<float> band;
  std::vector<float> values =
      read_whole<float>(source.map.name, reader.height(), width, [&](int first, int count, float* out) {
        band.resize(width * channels * std::size_t(count));
        reader.read_rows(first, count, band.data());
        for (std::size_t i = 0; i < width * std::size_t(count); i++) out[i] = band[i * channels] * scale + bias;
      });
  return {source.map.name, 0, std::move(values), reader.width()};
}

}  // namespace burnish
