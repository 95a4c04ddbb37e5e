#include "burnish/ptm/files/grey_jpeg.h"

#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h wants it
#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace burnish {
namespace {

constexpr int kMostScans = 64;
constexpr std::size_t kMostTexelsInByte = 512;

// libjpeg leaves by a jump where something is wrong. What it has allocated goes with its struct; nothing of ours is
// made between.
struct Failure : jpeg_error_mgr {
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX] = {};
};

[[noreturn]] void leave(j_common_ptr jpeg) {
  auto* failure = static_cast<Failure*>(jpeg->err);
  failure->format_message(jpeg, failure->message);
  std::longjmp(failure->back, 1);
}

// Warnings are of damage that libjpeg paints over.
void leave_on_warning(j_common_ptr jpeg, int level) {
  if (level < 0) leave(jpeg);
}

// Each scan of a progressive stream costs a walk over the whole image.
void leave_on_many_scans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  std::snprintf(static_cast<Failure*>(jpeg->err)->message, JMSG_LENGTH_MAX, "too many scans");
  std::longjmp(static_cast<Failure*>(jpeg->err)->back, 1);
}

jpeg_error_mgr* prepare(Failure& failure) {
  jpeg_std_error(&failure);
  failure.error_exit = leave;
  failure.emit_message = leave_on_warning;
  return &failure;
}

std::string size_text(unsigned width, unsigned height) { return std::to_string(width) + "x" + std::to_string(height); }

// Owns the struct for the C++ around it.
struct Decoder {
  Failure failure;
  jpeg_progress_mgr progress{};
  jpeg_decompress_struct jpeg{};

  ~Decoder() { jpeg_destroy_decompress(&jpeg); }

  // False after a failure.
  bool begin(std::string_view stream) {
    jpeg.err = prepare(failure);
    if (setjmp(failure.back)) return false;
    jpeg_create_decompress(&jpeg);
    progress.progress_monitor = leave_on_many_scans;
    jpeg.progress = &progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(stream.data()),
                 static_cast<unsigned long>(stream.size()));
    jpeg_read_header(&jpeg, TRUE);
    jpeg.dct_method = JDCT_ISLOW;
    return true;
  }
  bool start() {
    if (setjmp(failure.back)) return false;
    jpeg_start_decompress(&jpeg);
    return true;
  }
  bool read(std::uint8_t* row) {
    if (setjmp(failure.back)) return false;
    jpeg_read_scanlines(&jpeg, &row, 1);
    return true;
  }
  bool finish() {
    if (setjmp(failure.back)) return false;
    jpeg_finish_decompress(&jpeg);
    return true;
  }
};

struct Encoder {
  Failure failure;
  jpeg_compress_struct jpeg{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  ~Encoder() {
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
  }

  bool begin(int width, int height, const std::array<unsigned, 64>& table) {
    jpeg.err = prepare(failure);
    if (setjmp(failure.back)) return false;
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = 1;
    jpeg.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_add_quant_table(&jpeg, 0, table.data(), 100, TRUE);
    jpeg.dct_method = JDCT_ISLOW;
    jpeg.optimize_coding = TRUE;
    jpeg_start_compress(&jpeg, TRUE);
    return true;
  }
  bool write(std::uint8_t* row) {
    if (setjmp(failure.back)) return false;
    jpeg_write_scanlines(&jpeg, &row, 1);
    return true;
  }
  bool finish() {
    if (setjmp(failure.back)) return false;
    jpeg_finish_compress(&jpeg);
    return true;
  }
};

void require(bool ok, const Decoder& decoder) {
  if (!ok)
    throw std::runtime_error(std::string("expected a whole JPEG, got a damaged one: ") + decoder.failure.message);
}
void require(bool ok, const Encoder& encoder) {
  if (!ok) throw std::runtime_error(encoder.failure.message);
}

}  // namespace

bool may_hold_texels(std::size_t stream_bytes, std::size_t texels) {
  return texels / kMostTexelsInByte <= stream_bytes;
}

void decode_grey_jpeg(std::string_view stream, int width, int height,
                      const std::function<void(int, const std::uint8_t*)>& row) {
  Decoder decoder;
  require(decoder.begin(stream), decoder);
  const jpeg_decompress_struct& jpeg = decoder.jpeg;
  if (jpeg.num_components != 1)
    throw std::runtime_error("expected a grey JPEG, got " + std::to_string(jpeg.num_components) + " channels");
  if (jpeg.image_width != JDIMENSION(width) || jpeg.image_height != JDIMENSION(height))
    throw std::runtime_error("expected a JPEG of " + size_text(width, height) + " texels, got " +
                             size_text(jpeg.image_width, jpeg.image_height));
  if (jpeg.arith_code) throw std::runtime_error("expected Huffman's codes in a JPEG, got arithmetic ones");
  require(decoder.start(), decoder);
  std::vector<std::uint8_t> bytes(width);
  for (int y = 0; y < height; y++) {
    require(decoder.read(bytes.data()), decoder);
    row(y, bytes.data());
  }
  require(decoder.finish(), decoder);
}

std::string encode_grey_jpeg(int width, int height, int step, const std::function<void(int, std::uint8_t*)>& row) {
  std::array<unsigned, 64> table;
  table.fill(unsigned(step));
  Encoder encoder;
  require(encoder.begin(width, height, table), encoder);
  std::vector<std::uint8_t> bytes(width);
  for (int y = 0; y < height; y++) {
    row(y, bytes.data());
    require(encoder.write(bytes.data()), encoder);
  }
  require(encoder.finish(), encoder);
  return {reinterpret_cast<const char*>(encoder.bytes), encoder.size};
}

}  // namespace burnish
