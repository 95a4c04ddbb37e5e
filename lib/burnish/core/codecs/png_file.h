// PNG files, by libpng: rows in and out, palettes and texts as they are in the file.
//
// Nothing is converted: no gamma, no background, no colour profile. Errors: kMalformed for what is damaged, kIo for
// what cannot be read or written.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/core/file_ref.h"

namespace burnish::detail {

using PngColour = std::array<std::uint8_t, 3>;

// The chunks tEXt, zTXt and iTXt.
struct PngText {
  std::string key, text;
  bool compressed = false;  // written as iTXt; else as tEXt
};

struct PngForm {
  int width = 0, height = 0;
  int channels = 1;                // 1 to 4: grey, grey and alpha, RGB, RGBA
  int bits = 8;                    // of a sample in rows, 8 or 16
  std::vector<PngColour> palette;  // not empty where samples are indices into it
  std::vector<PngText> texts;      // of a file that is read, those before its texels
};

enum class PngSamples {
  kColours,  // palettes become RGB, colours said to be transparent an alpha channel, 1, 2 and 4 bits the 8 of [0,255]
  kStored,   // indices, and the numbers of 1, 2 and 4 bits as they are
};

class PngReader {
 public:
  PngReader(const FileRef& file, PngSamples samples);
  ~PngReader();

  const PngForm& form() const;
  // Rows [first, first + count), channels interleaved, 16 bits in the machine's order. In any order; ascending is fast.
  // An interlaced file is held whole from the first row on.
  void read_rows(int first, int count, void* out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class PngWriter {
 public:
  PngWriter(const FileRef& file, const PngForm& form);
  ~PngWriter();

  // The next rows, as PngReader gives them.
  void write_rows(int count, const void* rows);
  // Must be called, after the last row: reports what only closing can reveal.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace burnish::detail
