#include "cli/options.h"

#include <cmath>

#include "burnish/core/error.h"

namespace burnish::cli {

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

// The options of both kinds of image that are written.
void add_output(CLI::App& app, std::string& path, std::string& format, std::string& output_type,
                const std::string& types) {
  app.add_option("-o,--output", path, "File to write; '-' is standard output")->required()->type_name("FILE");
  app.add_option("-d,--format", format, "Samples: uint8, uint16, half or float; default by the file's type")
      ->check(CLI::IsMember({"uint8", "uint16", "half", "float"}))
      ->type_name("F");
  app.add_option("--output-type", output_type, "Type of what goes to standard output")
      ->check(CLI::IsMember({"png", "exr", "tiff"}))
      ->type_name(types);
}

// An output as messages call it.
const std::string& shown(const std::string& path) { return path == "-" ? kStandardOutput : path; }

FileType type_of_output(const std::string& path, const std::string& output_type) {
  if (path != "-") {
    const FileType type = file_type_of(path);
    if (!output_type.empty() && file_type_of("x." + output_type) != type)
      throw file_error(ErrorKind::kUsage, path, "--output-type " + output_type + " is for standard output");
    return type;
  }
  if (output_type.empty()) throw file_error(ErrorKind::kUsage, kStandardOutput, "needs --output-type png, exr or tiff");
  return file_type_of("x." + output_type);
}

FileType require_indexed(FileType type, const std::string& path, const IndexedOutput& output) {
  using enum FileType;
  if (type != kExr && type != kPng && type != kKtx2 && type != kDds)
    throw file_error(ErrorKind::kUnsupported, shown(path),
                     std::string("an indexed normal map is written as EXR, PNG, KTX2 or DDS, not ") + name(type));
  if (type == kDds && output.palette_path.empty())
    throw file_error(ErrorKind::kUsage, path,
                     "a DDS holds no palette: --palette-output FILE, an .exr or .png, writes it beside");
  return type;
}

}  // namespace

void ImageOutput::add_to(CLI::App& app) { add_output(app, path, format, output_type, "png|exr|tiff"); }

FileType ImageOutput::type() const { return type_of_output(path, output_type); }

void IndexedOutput::add_to(CLI::App& app) {
  add_output(app, path, format, output_type, "png|exr");
  app.add_option("--palette-output", palette_path,
                 "Write the palette alone: an N x 1 image, .exr or .png. A .dds needs it, for it holds no palette")
      ->type_name("FILE");
}

FileType IndexedOutput::type() const { return require_indexed(type_of_output(path, output_type), path, *this); }

FileType IndexedOutput::type_of(const std::string& map_path) const {
  return require_indexed(file_type_of(map_path), map_path, *this);
}

FileType IndexedOutput::palette_type() const {
  const FileType type = file_type_of(palette_path);
  if (type == FileType::kExr || type == FileType::kPng) return type;
  throw file_error(ErrorKind::kUnsupported, palette_path,
                   std::string("a palette is written as EXR or PNG, not ") + name(type));
}

void IndexedOutput::require_format(FileType type, std::size_t normals) const {
  const std::string stored = type == FileType::kExr ? "uint32" : normals <= 256 ? "uint8" : "uint16";
  if (!format.empty() && format != stored)
    throw file_error(ErrorKind::kUnsupported, shown(path),
                     std::string(name(type)) + " holds indices into " + std::to_string(normals) + " normals as " +
                         stored + ", not " + format);
}

SampleType ImageOutput::sample() const {
  SampleType sample = default_sample_type(type());
  for (SampleType s : {SampleType::kUint8, SampleType::kUint16, SampleType::kHalf, SampleType::kFloat})
    if (format == name(s)) sample = s;
  require_can_hold(type(), sample, shown(path));
  return sample;
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
