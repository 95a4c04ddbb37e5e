#include "burnish/brdf/tables/table_file.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "burnish/brdf/tables/table_error.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/number_text.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::vector<double>;

const std::string kFunction = "burnish:function", kDomain = "burnish:domain", kSampling = "burnish:sampling",
                  kLayout = "burnish:layout", kParameters = "burnish:parameters", kScale = "burnish:scale";

Error malformed(const ImageReader& reader, const std::string& what) {
  return file_error(ErrorKind::kMalformed, reader.name(), what);
}

std::string text_of(const ImageReader& reader, const std::string& attribute) {
  if (const std::optional<std::string> text = reader.text(attribute)) return *text;
  throw malformed(reader, "expected a lookup table, got an image without " + attribute);
}

Numbers numbers_of(const ImageReader& reader, const std::string& attribute, const std::string& expected) {
  if (const std::optional<Numbers> numbers = reader.numbers(attribute)) return *numbers;
  throw malformed(reader, "expected " + attribute + " of " + expected + ", got none");
}

// The value whose name the file gives.
template <typename T>
T named(const ImageReader& reader, const std::string& attribute, std::initializer_list<T> values) {
  const std::string text = text_of(reader, attribute);
  std::vector<std::string> names;
  for (const T value : values) {
    if (text == name(value)) return value;
    names.push_back(name(value));
  }
  throw malformed(reader,
                  "expected " + attribute + " " + joined(names, ", ", " or ") + ", got '" + excerpt(text) + "'");
}

std::vector<Range> domain_of(const ImageReader& reader) {
  const Numbers ends = numbers_of(reader, kDomain, "the lower and upper end of each argument");
  std::vector<Range> domain;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) domain.push_back({ends[i], ends[i + 1]});
  if (ends.empty() || ends.size() % 2)
    throw malformed(reader,
                    "expected " + kDomain + " of two numbers an argument, got " + counted(ends.size(), "number"));
  return domain;
}

Json parameters_of(const LookupFunction& f) {
  switch (f.kind) {
    case LookupKind::kBanksR:
      return {{"approximate", f.approximate}};
    case LookupKind::kStrand:
      return {{"exponent", f.exponent}};
    case LookupKind::kLightFactor:
      return {{"light", {f.light.x, f.light.y, f.light.z}}, {"ambient", f.ambient}, {"transition", f.transition}};
    default:
      return Json::object();
  }
}

// Throws Json::exception unless `given` has what its function has.
void take_parameters(const Json& given, LookupFunction& f) {
  if (f.kind == LookupKind::kBanksR) f.approximate = given.at("approximate").get<bool>();
  if (f.kind == LookupKind::kStrand) f.exponent = given.at("exponent").get<double>();
  if (f.kind == LookupKind::kLightFactor) {
    const Json& light = given.at("light");
    f.light = {light.at(0).get<double>(), light.at(1).get<double>(), light.at(2).get<double>()};
    f.ambient = given.at("ambient").get<double>();
    f.transition = given.at("transition").get<double>();
  }
}

void take_parameters(const ImageReader& reader, LookupFunction& f) {
  const std::string text = text_of(reader, kParameters);
  try {
    const Json given = Json::parse(text);
    take_parameters(given, f);
    if (given == parameters_of(f)) return;  // nothing more
  } catch (const Json::exception&) {
  }
  throw malformed(reader, "expected " + kParameters + " such as " + parameters_json(f) + " for " + name(f.kind) +
                              ", got '" + excerpt(text) + "'");
}

// One factor a channel; 1 for samples that are the values themselves.
Numbers scale_of(const ImageReader& reader) {
  if (!reader.integer()) return Numbers(reader.channels(), 1);
  const std::string expected = "one number a channel";
  Numbers scale = numbers_of(reader, kScale, expected);
  if (int(scale.size()) != reader.channels() ||
      !std::ranges::all_of(scale, [](double s) { return s > 0 && std::isfinite(s); }))
    throw malformed(reader, "expected " + kScale + " of " + expected + ", each above 0");
  return scale;
}

}  // namespace

std::string parameters_json(const LookupFunction& function) { return parameters_of(function).dump(); }

void write_table(const FileRef& file, FileType type, SampleType sample, const TableFile& t) {
  const LookupTable& table = t.table;
  require_can_hold(sample, table);
  Numbers domain;
  for (const Range r : table.domain) domain.insert(domain.end(), {r.least, r.most});
  Attributes attributes{{kFunction, name(t.function.kind)},
                        {kDomain, domain},
                        {kSampling, name(table.sampling)},
                        {kLayout, name(table.layout)},
                        {kParameters, JsonText{parameters_json(t.function)}}};
  const float scale = is_integer(sample) ? float(table_scale(table)) : 1;
  if (scale != 1 && (type == FileType::kTga || type == FileType::kBmp))
    throw file_error(ErrorKind::kUnsupported, file.name,
                     std::string("the table is stored divided by its largest value, ") + number_text(scale) +
                         ", which " + name(type) + " cannot record: use PNG, TIFF or EXR");
  if (is_integer(sample)) attributes.emplace_back(kScale, Numbers(table.texels.channels, scale));
  ImageWriter writer(file, type, sample, table.texels.width, table.texels.height, table.texels.channels, attributes);
  std::vector<float> row(std::size_t(table.texels.width) * table.texels.channels);
  for (int y = 0; y < table.texels.height; y++) {
    std::transform(table.texels.row(y), table.texels.row(y) + row.size(), row.begin(),
                   [&](float v) { return v / scale; });
    writer.write_rows(1, row.data());
  }
  writer.close();
}

TableFile read_table(const FileRef& file) {
  ImageReader reader(file);
  TableFile t;
  LookupFunction& f = t.function;
  using enum LookupKind;
  f.kind = named(reader, kFunction, {kBanksR, kBlinnPhongF, kWardS, kWardE, kStrand, kLightFactor});
  f.domain = domain_of(reader);
  take_parameters(reader, f);
  const auto sampling = named(reader, kSampling, {TableSampling::kEdge, TableSampling::kCentre});
  const auto layout = named(reader, kLayout, {TableLayout::kPlain, TableLayout::kOffsetHalf, TableLayout::kCubeZ});
  try {
    require_valid(f);
    require_table_shape(f, reader.width(), reader.height(), sampling, layout);
  } catch (const Error& error) {
    throw malformed(reader, error.what());
  }
  if (reader.channels() != f.channels())
    throw malformed(reader, "expected " + counted(f.channels(), "channel") + " of a table of " + name(f.kind) +
                                ", got " + std::to_string(reader.channels()));
  const Numbers scale = scale_of(reader);
  t.table = {f.domain, sampling, layout, Image(reader.width(), reader.height(), reader.channels())};
  std::vector<float>& values = t.table.texels.data;
  reader.read_rows(0, reader.height(), values.data());
  for (std::size_t i = 0; i < values.size(); i++) values[i] *= float(scale[i % scale.size()]);
  if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v); }))
    throw malformed(reader, "expected finite values, got NaN or infinity");
  return t;
}

}  // namespace burnish
