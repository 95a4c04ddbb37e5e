// Groups of options that tools compose, so that no flag is declared twice.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

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

// --y, --encoding and --channels of a normal map that is read; the last only with_channels.
void add_normal_coding(CLI::App& app, NormalCoding& coding, bool with_channels);

// -o, -d and --output-type of an image that is written.
struct ImageOutput {
  std::string path, output_type;
  std::string format;

  void add_to(CLI::App& app);
  // By --output-type for standard output, otherwise by the extension. Throws as file_type_of.
  FileType type() const;
  // By -d, otherwise the default of the type. Throws where the type cannot hold it.
  SampleType sample() const;
};

// -o, -d and --output-type of an indexed normal map, --palette-output of the palette beside it.
struct IndexedOutput {
  std::string path, output_type;
  std::string format;        // checked against what the map is stored as
  std::string palette_path;  // empty: none is written

  void add_to(CLI::App& app);
  FileType type() const;
  // Of a further map that is written, such as one level: EXR, PNG, KTX2 or DDS; kUnsupported for any other name, kUsage
  // for a DDS without --palette-output.
  FileType type_of(const std::string& map_path) const;
  // EXR or PNG; kUnsupported for any other name. Only where there is a palette_path.
  FileType palette_type() const;
  // What indices are stored as follows from the palette's size and the file's type; -d may only say so. kUnsupported
  // otherwise.
  void require_format(FileType type, std::size_t normals) const;
};

// A length such as 2, 2m, 10cm or 5mm; metres and plain numbers count alike. Throws CLI::ValidationError.
double parse_length(const std::string& flag, const std::string& text);

}  // namespace burnish::cli
