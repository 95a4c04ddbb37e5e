// What reading and writing indexed EXR files have in common: OpenEXR's own API, since what OpenImageIO does to unsigned
// integer channels and to the attributes of mip chains would change them.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>

#include <cstdint>
#include <string>
#include <vector>

#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/error.h"
#include "burnish/palette/indexed_map.h"

namespace burnish::detail {

constexpr const char* kIndexChannel = "index";

// As many threads for OpenEXR as the program may use.
void use_exr_threads();

// The palette in the attributes of a file.
void insert_palette(Imf::Header& header, const Palette& palette);
// kMalformed where there is none.
Palette extract_palette(const Imf::Header& header, const FileRef& file);

// 32-bit indices, which the file holds, of rows from that one of the image on.
Imf::FrameBuffer frame_buffer(std::vector<std::uint32_t>& data, int width, int first_row);

// Runs what calls the library on a file that is read.
template <typename Body>
auto reading_exr(const FileRef& file, const Body& body) {
  try {
    return body();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw file_error(ErrorKind::kMalformed, file.name, codec_message(error.what(), file));
  }
}

// A CheckedFile as the library takes it; its own stream passes over a full disk when it closes.
class ExrStream final : public Imf::OStream {
 public:
  explicit ExrStream(const FileRef& file) : OStream(file.name.c_str()), ref_(file), file_(file.path) { check(); }
  void write(const char bytes[], int n) override {
    file_.write(bytes, std::size_t(n));
    check();
  }
  std::uint64_t tellp() override { return std::uint64_t(file_.position()); }
  void seekp(std::uint64_t position) override { file_.seek(std::int64_t(position)); }
  // Runs what writes to it through the library.
  template <typename Body>
  void guard(const Body& body) {
    try {
      body();
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      close();  // says why, if it was the disk
      throw file_error(ErrorKind::kIo, ref_.name, "cannot be written: " + codec_message(error.what(), ref_));
    }
  }
  // After what writes to it is gone: sees to it that all has reached the disk.
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (file_.first_error()) throw file_.error(ref_.name);
  }
  FileRef ref_;
  CheckedFile file_;
};

}  // namespace burnish::detail
