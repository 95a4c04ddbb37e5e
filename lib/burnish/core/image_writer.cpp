#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "burnish/core/attribute_codec.h"
#include "burnish/core/checked_file.h"
#include "burnish/core/codec_message.h"
#include "burnish/core/codecs.h"
#include "burnish/core/error.h"
#include "burnish/core/image_io.h"
#include "burnish/core/samples.h"

namespace burnish {

using detail::to_oiio;

namespace {

// A CheckedFile as OpenImageIO's codecs take it. Most of them look at no result of their own writes: without it a full
// disk passes unseen.
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

}  // namespace

struct ImageWriter::Impl {
  FileRef file;
  std::unique_ptr<CheckedProxy> to;  // outlives what writes to it
  std::unique_ptr<OIIO::ImageOutput> out;
  OIIO::ImageSpec spec;
  SampleType sample;
  int next = 0;
  std::vector<std::byte> converted;

  [[noreturn]] void fail() { throw to->file.error(file.name, out ? codec_message(out->geterror(), file) : ""); }

  void write(int count, const void* rows, OIIO::TypeDesc type) {
    if (!out->write_scanlines(next, next + count, 0, type, rows) || to->file.first_error()) fail();
    next += count;
  }
};

ImageWriter::ImageWriter(const FileRef& file, FileType type, SampleType sample, int width, int height, int channels,
                         const Attributes& attributes)
    : impl_(std::make_unique<Impl>()) {
  require_can_hold(type, sample, file.name);
  impl_->file = file;
  impl_->sample = sample;
  impl_->out = OIIO::ImageOutput::create(detail::codec_of(type));
  if (!impl_->out) throw file_error(ErrorKind::kUnsupported, file.name, "no codec for " + std::string(name(type)));
  OIIO::ImageSpec& spec = impl_->spec;
  spec = OIIO::ImageSpec(width, height, channels, to_oiio(sample));
  if (channels == 1) spec.channelnames = {"Y"};
  if (type == FileType::kPng) spec.attribute("png:compressionLevel", 6);
  if (type == FileType::kTiff) spec.attribute("compression", "zip");
  if (type == FileType::kExr) spec.attribute("compression", "zip");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("DateTime", "");  // or the codec puts the clock into the file
  detail::put_attributes(spec, type, attributes);
  impl_->to = std::make_unique<CheckedProxy>(file.path);
  if (impl_->to->file.first_error()) impl_->fail();
  OIIO::Filesystem::IOProxy* to = impl_->to.get();
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &to);
  if (!impl_->out->open(file.path, spec)) impl_->fail();
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write_rows(int count, const float* rows) {
  const std::size_t samples = std::size_t(count) * impl_->spec.width * impl_->spec.nchannels;
  if (!is_integer(impl_->sample)) {
    impl_->write(count, rows, OIIO::TypeDesc::FLOAT);
    return;
  }
  impl_->converted.resize(samples * to_oiio(impl_->sample).size());
  const auto round = [&](auto* to, float max) {
    for (std::size_t i = 0; i < samples; i++)
      to[i] = static_cast<std::remove_reference_t<decltype(*to)>>(integer_sample(rows[i], max));
  };
  if (impl_->sample == SampleType::kUint8) round(reinterpret_cast<std::uint8_t*>(impl_->converted.data()), 255.f);
  else round(reinterpret_cast<std::uint16_t*>(impl_->converted.data()), 65535.f);
  write_rows_stored(count, impl_->converted.data());
}

void ImageWriter::write_rows_stored(int count, const void* rows) { impl_->write(count, rows, impl_->spec.format); }

void ImageWriter::close() {
  if (!impl_->out->close()) impl_->fail();
  impl_->out.reset();  // some files are complete only now
  impl_->to->file.close();
  if (impl_->to->file.first_error()) impl_->fail();
}

}  // namespace burnish
