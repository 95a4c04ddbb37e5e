#include "burnish/brdf/tables/table_c_header.h"

#include <algorithm>
#include <cctype>

#include "burnish/brdf/tables/table_error.h"
#include "burnish/core/checked_file.h"
#include "burnish/core/number_text.h"
#include "burnish/core/samples.h"

namespace burnish {
namespace {

constexpr std::size_t kLineWidth = 120;

// "burnish_ward_e"
std::string array_name(LookupKind kind) {
  std::string text = std::string("burnish_") + name(kind);
  std::ranges::replace(text, '-', '_');
  return text;
}

const char* c_type(SampleType sample) {
  return sample == SampleType::kFloat ? "float" : sample == SampleType::kUint8 ? "uint8_t" : "uint16_t";
}

// "0.5f", "1.0f", "1e-05f": without point or exponent an f makes no literal.
std::string float_literal(float value) {
  const std::string digits = number_text(value);
  return digits + (digits.find_first_of(".e") == std::string::npos ? ".0f" : "f");
}

std::vector<std::string> literals(SampleType sample, std::vector<float> values, float scale) {
  std::vector<std::string> texts(values.size());
  if (sample == SampleType::kFloat) {
    std::ranges::transform(values, texts.begin(), float_literal);
  } else if (sample == SampleType::kHalf) {
    std::ranges::transform(half_bits(values), texts.begin(), [](int bits) { return std::to_string(bits); });
  } else {
    const float most = sample == SampleType::kUint8 ? 255 : 65535;
    std::ranges::transform(values, texts.begin(),
                           [&](float v) { return std::to_string(integer_sample(v / scale, most)); });
  }
  return texts;
}

std::string samples_text(SampleType sample, float scale) {
  const std::string text = name(sample);
  if (sample == SampleType::kFloat) return text;
  if (sample == SampleType::kHalf) return text + ", its bits";
  return text + ", value = sample / " + (sample == SampleType::kUint8 ? "255" : "65535") + " * " + number_text(scale);
}

std::string comment(SampleType sample, const TableFile& t, float scale) {
  std::string domain;
  for (const Range r : t.table.domain)
    domain += (domain.empty() ? "" : ",") + number_text(r.least) + ":" + number_text(r.most);
  const std::pair<const char*, std::string> lines[]{
      {"function", name(t.function.kind)},         {"domain", domain},
      {"sampling", name(t.table.sampling)},        {"layout", name(t.table.layout)},
      {"parameters", parameters_json(t.function)}, {"samples", samples_text(sample, scale)}};
  std::string text = "/* Lookup table; columns run over the first argument, rows over the second.";
  for (const auto& [key, value] : lines) text += std::string("\n   ") + key + ": " + value;
  return text + " */\n";
}

// All before the numbers.
std::string heading(SampleType sample, const TableFile& t, float scale) {
  const Image& texels = t.table.texels;
  const std::string array = array_name(t.function.kind), width = std::to_string(texels.width),
                    height = std::to_string(texels.height), channels = std::to_string(texels.channels);
  std::string guard = array + "_H";
  std::ranges::transform(guard, guard.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return comment(sample, t, scale) + "#ifndef " + guard + "\n#define " + guard + "\n\n#include <stdint.h>\n\nenum { " +
         array + "_width = " + width + ", " + array + "_height = " + height + ", " + array + "_channels = " + channels +
         " };\n\nstatic const " + c_type(sample) + " " + array + "[" + height + " * " + width + " * " + channels +
         "] = {\n";
}

}  // namespace

void write_table_header(const FileRef& file, SampleType sample, const TableFile& t) {
  const Image& texels = t.table.texels;
  require_can_hold(sample, t.table);
  const float scale = float(table_scale(t.table));
  CheckedFile out(file.path);
  const auto write = [&](const std::string& text) {
    if (out.write(text.data(), text.size()) != text.size()) throw out.error(file.name);
  };
  write(heading(sample, t, scale));
  for (int y = 0; y < texels.height; y++) {
    std::string text, line;
    for (const std::string& literal : literals(sample, {texels.row(y), texels.row(y + 1)}, scale)) {
      if (line.size() + literal.size() + 2 > kLineWidth) text += line + "\n", line.clear();
      line += (line.empty() ? "" : " ") + literal + ",";
    }
    write(text + line + "\n");
  }
  write("};\n\n#endif\n");
  out.close();
  if (out.first_error()) throw out.error(file.name);
}

}  // namespace burnish
