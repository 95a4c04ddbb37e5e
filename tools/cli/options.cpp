#include "cli/options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/wording.h"

namespace burnish::cli {
namespace {

// Numbers of the option's own type, as CLI11 reads them.
template <typename T>
CLI::Validator range_check(T least, T most, const std::string& wanted, const std::string& shown) {
  return CLI::Validator(
      [=](const std::string& given) {
        T value{};
        if (CLI::detail::lexical_cast(given, value) && value >= least && value <= most) return std::string();
        return "expected " + wanted + ", got '" + given + "'";
      },
      shown);
}

template <typename T>
CLI::Validator integers(T least, T most) {
  const std::string from = std::to_string(least), to = std::to_string(most);
  if (most == std::numeric_limits<T>::max())
    return range_check(least, most, "an integer of at least " + from, from + "..");
  return range_check(least, most, "an integer from " + from + " to " + to, from + ".." + to);
}

}  // namespace

CLI::Validator in_range(int least, int most) { return integers(least, most); }
CLI::Validator in_range(std::int64_t least, std::int64_t most) { return integers(least, most); }

CLI::Validator in_range(double least, double most) {
  const std::string from = number_text(least), to = number_text(most);
  return range_check(least, most, "a number from " + from + " to " + to, from + ".." + to);
}

void add_normal_coding(CLI::App& app, NormalCoding& coding, bool with_channels) {
  add_choice<GreenAxis>(app, "--y", coding.green, {{"up", GreenAxis::kUp}, {"down", GreenAxis::kDown}},
                        "Green of the normal map: up (OpenGL, default) or down (DirectX)")
      ->group("Normal map");
  add_choice<NormalEncoding>(app, "--encoding", coding.encoding,
                             {{"biased", NormalEncoding::kBiased}, {"signed", NormalEncoding::kSigned}},
                             "How vectors are stored; default biased in integers, signed in half and float")
      ->group("Normal map");
  if (with_channels)
    app.add_option("--channels", coding.channels,
                   "Channels that hold the normal, by letter: xy (z is rebuilt), ag, rgb …; default the first three")
        ->type_name("LETTERS")
        ->group("Normal map");
}

namespace {

const WrittenAs kIndexedMap{"an indexed normal map", {FileType::kExr, FileType::kPng, FileType::kKtx2, FileType::kDds}};
const WrittenAs kPalette{"a palette", {FileType::kExr, FileType::kPng}};

// Types that standard output can be, by their words.
const Words<FileType> kStreams{{"png", FileType::kPng}, {"exr", FileType::kExr}, {"tiff", FileType::kTiff}};

bool has(const WrittenAs& as, FileType type) { return std::ranges::find(as.types, type) != as.types.end(); }

std::vector<std::string> streams_of(const WrittenAs& as) {
  std::vector<std::string> words;
  for (const auto& [word, type] : kStreams)
    if (has(as, type)) words.push_back(word);
  return words;
}

// The options of both kinds of image that are written.
void add_output(CLI::App& app, std::string& path, std::string& format, std::string& output_type, const WrittenAs& as) {
  app.add_option("-o,--output", path, "File to write, " + as.list() + " by its extension; '-' is standard output")
      ->required()
      ->type_name("FILE");
  add_choice<std::string>(app, "-d,--format", format,
                          {{"uint8", "uint8"}, {"uint16", "uint16"}, {"half", "half"}, {"float", "float"}},
                          "Samples; default by the file's type");
  const std::string words = joined(streams_of(as), "|");
  app.add_option_function<std::string>(
         "--output-type",
         [&output_type, words](const std::string& given) {
           if (std::ranges::find(kStreams, given, &std::pair<std::string, FileType>::first) == kStreams.end())
             throw CLI::ValidationError("--output-type", "expected " + words + ", got '" + given + "'");
           output_type = given;
         },
         "Type of what goes to standard output" +
             std::string(has(as, FileType::kKtx2) ? "; KTX2 and DDS go to files only" : ""))
      ->type_name(words);
}

// An output as messages call it.
const std::string& shown(const std::string& path) { return path == "-" ? kStandardOutput : path; }

Error not_written(const WrittenAs& as, const std::string& path, const std::string& got, const std::string& option) {
  return file_error(ErrorKind::kUnsupported, shown(path),
                    as.what + " is written as " + as.list() + ", not " + got + " (" + option + ")");
}

FileType require(const WrittenAs& as, FileType type, const std::string& path, const std::string& option) {
  const bool indexed_only = type == FileType::kKtx2 || type == FileType::kDds;
  if (!has(as, type))
    throw not_written(as, path, name(type) + std::string(indexed_only ? ", which is for indexed normal maps only" : ""),
                      option);
  return type;
}

FileType type_of_output(const std::string& path, const std::string& output_type, const WrittenAs& as) {
  const auto stream = std::ranges::find(kStreams, output_type, &std::pair<std::string, FileType>::first);
  if (path == "-" && output_type.empty())
    throw file_error(ErrorKind::kUsage, kStandardOutput, "needs --output-type " + joined(streams_of(as), ", ", " or "));
  if (path == "-") return require(as, stream->second, path, "--output-type");
  const FileType type = as.type_of(path, "--output");
  if (!output_type.empty() && stream->second != type)
    throw file_error(ErrorKind::kUsage, path, "--output-type " + output_type + " is for standard output");
  return type;
}

FileType require_palette_beside(FileType type, const std::string& path, const IndexedOutput& output) {
  if (type == FileType::kDds && output.palette_path.empty())
    throw file_error(ErrorKind::kUsage, path,
                     "a DDS holds no palette: --palette-output FILE, an .exr or .png, writes it beside");
  return type;
}

}  // namespace

FileType WrittenAs::type_of(const std::string& path, const std::string& option) const {
  if (const std::optional<FileType> type = find_file_type(path)) return require(*this, *type, path, option);
  const std::string extension = std::filesystem::path(path).extension().string();
  throw not_written(*this, path, extension.empty() ? "a file without extension" : "'" + extension + "'", option);
}

std::string WrittenAs::list() const {
  std::vector<std::string> names;
  for (FileType type : types) names.push_back(name(type));
  if (!also.empty()) names.push_back(also);
  return joined(names, ", ", " or ");
}

void ImageOutput::add_to(CLI::App& app) { add_output(app, path, format, output_type, as); }

FileType ImageOutput::type() const { return type_of_output(path, output_type, as); }

void IndexedOutput::add_to(CLI::App& app) {
  add_output(app, path, format, output_type, kIndexedMap);
  app.add_option("--palette-output", palette_path,
                 "Write the palette alone: an N x 1 image, .exr or .png. A .dds needs it, for it holds no palette")
      ->type_name("FILE");
}

FileType IndexedOutput::type() const {
  return require_palette_beside(type_of_output(path, output_type, kIndexedMap), path, *this);
}

FileType IndexedOutput::type_of(const std::string& map_path, const std::string& option) const {
  return require_palette_beside(kIndexedMap.type_of(map_path, option), map_path, *this);
}

FileType IndexedOutput::palette_type() const { return kPalette.type_of(palette_path, "--palette-output"); }

void IndexedOutput::require_format(FileType type, std::size_t normals, const std::string& file) const {
  const std::string stored = type == FileType::kExr ? "uint32" : normals <= 256 ? "uint8" : "uint16";
  if (!format.empty() && format != stored)
    throw file_error(ErrorKind::kUnsupported, shown(file),
                     std::string(name(type)) + " holds indices into " + std::to_string(normals) + " normals as " +
                         stored + ", not " + format);
}

SampleType ImageOutput::sample() const {
  const SampleType sample = sample_or(default_sample_type(type()));
  require_can_hold(type(), sample, shown(path));
  return sample;
}

SampleType ImageOutput::sample_or(SampleType otherwise) const {
  for (SampleType s : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat})
    if (format == name(s)) return s;
  return otherwise;
}

std::pair<int, int> parse_texels(const std::string& flag, const std::string& text) {
  const auto side = [&](const std::string& part) {
    const std::optional<int> n = number_in<int>(part);
    if (!n || *n < 1) throw CLI::ValidationError(flag, "expected texels such as 1024 or 1024x512, got '" + text + "'");
    return *n;
  };
  const std::size_t x = text.find('x');
  const int width = side(text.substr(0, x));
  return {width, x == std::string::npos ? 0 : side(text.substr(x + 1))};
}

double parse_length(const std::string& flag, const std::string& text) {
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  const std::string unit = std::isnan(value) ? "?" : text.substr(used);
  const double scale = unit.empty() || unit == "m" ? 1.0 : unit == "cm" ? 0.01 : unit == "mm" ? 0.001 : NAN;
  if (!std::isfinite(value * scale))
    throw CLI::ValidationError(flag, "expected a length such as 2, 2m, 10cm or 5mm, got '" + text + "'");
  return value * scale;
}

}  // namespace burnish::cli
