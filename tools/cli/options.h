// Groups of options that tools compose, so that no flag is declared twice.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <utility>

#include "burnish/core/image_io.h"
#include "burnish/normal/coding.h"

namespace burnish::cli {

// Map from the words of an option to its values, for CLI::CheckedTransformer with plain error messages.
template <typename T>
using Words = std::vector<std::pair<std::string, T>>;

// An option that takes one of several words.
template <typename T>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, T& value, const Words<T>& words,
                        const std::string& help) {
  std::string all;
  for (const auto& [word, v] : words) all += (all.empty() ? "" : "|") + word;
  return app
      .add_option_function<std::string>(
          flag,
          [&value, words, flag, all](const std::string& given) {
            for (const auto& [word, v] : words)
              if (word == given) {
                value = v;
                return;
              }
            throw CLI::ValidationError(flag, "expected " + all + ", got '" + given + "'");
          },
          help)
      ->type_name(all);
}

// For check() of an option: a number in a range, both ends included.
CLI::Validator in_range(int least, int most);
CLI::Validator in_range(std::int64_t least, std::int64_t most);
CLI::Validator in_range(double least, double most);

// --y, --encoding and --channels of a normal map that is read; the last only with_channels.
void add_normal_coding(CLI::App& app, NormalCoding& coding, bool with_channels);

// What a kind of output is written as: for its help, and for the refusal of any other type.
struct WrittenAs {
  std::string what;  // "a palette"
  std::vector<FileType> types;
  std::string also{};  // what the tool writes besides, by itself: "C header (.h)"

  // By the extension; kUnsupported, with the option that names the file, where it is none of them.
  FileType type_of(const std::string& path, const std::string& option) const;
  // "PNG, TIFF or EXR"
  std::string list() const;
};

// -o, -d and --output-type of an image that is written.
struct ImageOutput {
  std::string path, output_type;
  std::string format;
  WrittenAs as{"an image", {FileType::kPng, FileType::kTiff, FileType::kExr, FileType::kTga, FileType::kBmp}};

  void add_to(CLI::App& app);
  // By --output-type for standard output, otherwise by the extension. kUnsupported for what `as` has not, kUsage where
  // standard output has no type, or a file another than its name says.
  FileType type() const;
  // By -d, otherwise the default of the type. Throws where the type cannot hold it.
  SampleType sample() const;
  // By -d, otherwise that.
  SampleType sample_or(SampleType otherwise) const;
};

// -o, -d and --output-type of an indexed normal map, --palette-output of the palette beside it.
struct IndexedOutput {
  std::string path, output_type;
  std::string format;        // checked against what the map is stored as
  std::string palette_path;  // empty: none is written

  void add_to(CLI::App& app);
  FileType type() const;
  // Of a further map that an option names, such as one level: EXR, PNG, KTX2 or DDS; kUnsupported for any other name,
  // kUsage for a DDS without --palette-output.
  FileType type_of(const std::string& map_path, const std::string& option) const;
  // EXR or PNG; kUnsupported for any other name. Only where there is a palette_path.
  FileType palette_type() const;
  // What indices are stored as follows from the palette's size and the file's type; -d may only say so. kUnsupported
  // otherwise.
  void require_format(FileType type, std::size_t normals, const std::string& file) const;
};

// Texels such as 1024 or 1024x512, each at least 1; the second is 0 where it is left out. Throws CLI::ValidationError.
std::pair<int, int> parse_texels(const std::string& flag, const std::string& text);

// A length such as 2, 2m, 10cm or 5mm; metres and plain numbers count alike. Throws CLI::ValidationError.
double parse_length(const std::string& flag, const std::string& text);

}  // namespace burnish::cli
