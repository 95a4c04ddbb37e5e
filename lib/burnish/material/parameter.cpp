#include "burnish/material/parameter.h"

#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"

namespace burnish {

void Parameter::require(const std::function<bool(float)>& holds, const std::string& wanted) const {
  const auto message = [&](float got) { return "expected " + wanted + ", got " + number_text(got); };
  if (values.empty() && !holds(number)) throw Error(ErrorKind::kUsage, name + ": " + message(number));
  for (std::size_t i = 0; i < values.size(); i++)
    if (!holds(values[i]))
      throw file_error(
          ErrorKind::kMalformed, name,
          message(values[i]) + " at column " + std::to_string(i % width) + ", row " + std::to_string(i / width));
}

Parameter read_parameter(const std::string& name, const ParameterSource& source, SharedSize& size) {
  if (source.map.empty()) return {name, source.number, {}, 0};
  ImageReader reader(source.map);
  size.take(reader.width(), reader.height(), source.map.name);
  const auto first = [&](const char* attribute, float otherwise) {
    const auto numbers = reader.numbers(attribute);
    return numbers && !numbers->empty() ? float(numbers->front()) : otherwise;
  };
  const float scale = first("burnish:scale", 1), bias = first("burnish:bias", 0);
  Parameter parameter{source.map.name, 0, {}, reader.width()};
  parameter.values.reserve(std::size_t(reader.width()) * reader.height());
  std::vector<float> row(std::size_t(reader.width()) * reader.channels());
  for (int y = 0; y < reader.height(); y++) {
    reader.read_rows(y, 1, row.data());
    for (int x = 0; x < reader.width(); x++)
      parameter.values.push_back(row[std::size_t(x) * reader.channels()] * scale + bias);
  }
  return parameter;
}

}  // namespace burnish
