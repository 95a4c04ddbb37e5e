#include "burnish/core/checked_output.h"

#include <OpenImageIO/filesystem.h>

#include "burnish/core/attribute_codec.h"
#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/codecs.h"
#include "burnish/core/error.h"

namespace burnish::detail {

// A CheckedFile as OpenImageIO's codecs take it.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedProxy(const std::string& path) : IOProxy(path, Write), file(path) {}

  const char* proxytype() const override { return "file"; }
  bool opened() const override { return file.is_open(); }
  void close() override { file.close(); }
  std::size_t write(const void* bytes, std::size_t size) override {
    file.seek(m_pos);
    const std::size_t n = file.write(bytes, size);
    m_pos = file.position();
    return n;
  }
  std::size_t read(void* bytes, std::size_t size) override {
    file.seek(m_pos);
    const std::size_t n = file.read(bytes, size);
    m_pos = file.position();
    return n;
  }
  std::size_t size() const override { return file.size(); }

  CheckedFile file;
};

CheckedOutput::CheckedOutput(const FileRef& file, FileType type)
    : file_(file), type_(type), image_(OIIO::ImageOutput::create(codec_of(type))) {
  if (!image_) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + std::string(name(type)));
  to_ = std::make_unique<CheckedProxy>(file.path);
  require(true);
}

CheckedOutput::~CheckedOutput() = default;

OIIO::ImageSpec CheckedOutput::spec(SampleType sample, int width, int height, int channels,
                                    const Attributes& attributes) const {
  OIIO::ImageSpec spec(width, height, channels, to_oiio(sample));
  if (channels == 1) spec.channelnames = {"Y"};
  if (type_ == FileType::kPng) spec.attribute("png:compressionLevel", 6);
  if (type_ == FileType::kTiff || type_ == FileType::kExr) spec.attribute("compression", "zip");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("DateTime", "");  // or the codec puts the clock into the file
  put_attributes(spec, type_, attributes);
  return spec;
}

void CheckedOutput::open(OIIO::ImageSpec spec, OIIO::ImageOutput::OpenMode mode) {
  OIIO::Filesystem::IOProxy* to = to_.get();
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &to);
  require(image_->open(file_.path, spec, mode));
}

void CheckedOutput::require(bool ok) {
  if (ok && !to_->file.first_error()) return;
  throw to_->file.error(file_.name, image_ ? codec_message(image_->geterror(), file_) : "");
}

void CheckedOutput::close() {
  require(image_->close());
  image_.reset();  // some files are complete only now
  to_->file.close();
  require(true);
}

}  // namespace burnish::detail
