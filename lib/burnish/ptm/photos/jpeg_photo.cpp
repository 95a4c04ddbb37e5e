// Photographs in JPEG, a band of rows at a time by libjpeg itself: OpenImageIO cannot be asked whether a file is
// progressive, and goes on where one is cut short.
#include <array>
#include <cstdio>
#include <fstream>
// jpeglib.h wants the above.
#include <jerror.h>
#include <jpeglib.h>

#include "burnish/core/codec_message.h"
#include "burnish/core/error.h"
#include "burnish/core/texel_limit.h"
#include "burnish/ptm/photos/photo.h"

namespace burnish::detail {
namespace {

struct Closer {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

// libjpeg reports by a call that must not return; an exception passes through its C frames on this platform, and its
// memory is released by the destructor of JpegPhoto.
struct JpegFailure {
  std::string message;
};
std::string message_of(j_common_ptr of) {
  char text[JMSG_LENGTH_MAX];
  of->err->format_message(of, text);
  return text;
}
[[noreturn]] void on_error(j_common_ptr of) { throw JpegFailure{message_of(of)}; }
// A level below 0 is a warning: data were damaged, and something was made up for them. But for padding before the end,
// which some cameras write.
void on_message(j_common_ptr of, int level) {
  const bool padding = of->err->msg_code == JWRN_EXTRANEOUS_DATA && of->err->msg_parm.i[1] == JPEG_EOI;
  if (level < 0 && !padding) throw JpegFailure{message_of(of)};
}

class JpegPhoto : public Photo {
 public:
  explicit JpegPhoto(const FileRef& file) : file_(file), in_(std::fopen(file.path.c_str(), "rb")) {
    if (!in_) throw file_error(ErrorKind::kIo, file.name, "cannot be read");
    std::setvbuf(in_.get(), nullptr, _IOFBF, kFileBuffer);  // libjpeg asks for 4 KiB at a time
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = on_error;
    errors_.emit_message = on_message;
    jpeg_create_decompress(&jpeg_);
    try {
      guarded([&] {
        jpeg_stdio_src(&jpeg_, in_.get());
        jpeg_read_header(&jpeg_, TRUE);
      });
      if (jpeg_.num_components != 1 && jpeg_.num_components != 3)
        throw file_error(
            ErrorKind::kUnsupported, file.name,
            "expected red, green and blue, or grey, got " + std::to_string(jpeg_.num_components) + " components");
      require_within_texel_limit(file.name, jpeg_.image_width, jpeg_.image_height);
    } catch (...) {
      jpeg_destroy_decompress(&jpeg_);
      throw;
    }
    jpeg_.out_color_space = JCS_RGB;
    form_.width = int(jpeg_.image_width), form_.height = int(jpeg_.image_height);
    form_.whole = jpeg_has_multiple_scans(&jpeg_);
  }
  ~JpegPhoto() override { jpeg_destroy_decompress(&jpeg_); }

  void read(int rows, std::uint8_t* rgb) override {
    guarded([&] {
      if (!started_) jpeg_start_decompress(&jpeg_);
      started_ = true;
      for (int r = 0; r < rows;) {
        std::array<JSAMPROW, 16> lines;
        const int count = std::min(rows - r, int(lines.size()));
        for (int i = 0; i < count; i++) lines[i] = rgb + std::size_t(r + i) * form_.width * 3;
        r += int(jpeg_read_scanlines(&jpeg_, lines.data(), JDIMENSION(count)));
      }
      if (jpeg_.output_scanline == jpeg_.output_height) jpeg_finish_decompress(&jpeg_);
    });
  }
  void read(int, float*) override { throw Error(ErrorKind::kInternal, "JPEG has samples of 8 bits"); }

 private:
  template <typename Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const JpegFailure& failure) {
      throw file_error(ErrorKind::kMalformed, file_.name, codec_message(failure.message, file_));
    }
  }

  static constexpr std::size_t kFileBuffer = 1 << 17;
  FileRef file_;
  std::unique_ptr<std::FILE, Closer> in_;
  jpeg_error_mgr errors_{};
  jpeg_decompress_struct jpeg_{};
  bool started_ = false;
};

}  // namespace

bool is_jpeg(const FileRef& file) {
  std::array<char, 3> head{};
  std::ifstream(file.path, std::ios::binary).read(head.data(), head.size());
  return head == std::array{'\xff', '\xd8', '\xff'};
}

std::unique_ptr<Photo> open_jpeg_photo(const FileRef& file) { return std::make_unique<JpegPhoto>(file); }

}  // namespace burnish::detail
