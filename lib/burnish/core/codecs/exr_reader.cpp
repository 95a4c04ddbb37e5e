#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>
#include <ImfVecAttribute.h>
#include <half.h>

#include <algorithm>
#include <cstring>

#include "burnish/core/codec_message.h"
#include "burnish/core/codecs/exr_call.h"
#include "burnish/core/error.h"

namespace burnish::detail {
namespace {

// Runs what calls the library.
template <typename Body>
auto calling_exr(const FileRef& file, const Body& body) {
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

// Vectors, matrices: an attribute whose value is floats one after the other.
template <typename T>
std::optional<ExrValue> floats_of(const Imf::Attribute& attribute) {
  const auto* found = dynamic_cast<const Imf::TypedAttribute<T>*>(&attribute);
  if (!found) return std::nullopt;
  const auto* first = reinterpret_cast<const float*>(&found->value());
  return std::vector<float>(first, first + sizeof(T) / sizeof(float));
}

std::optional<ExrValue> value_of(const Imf::Attribute& attribute) {
  if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) return text->value();
  if (const auto* number = dynamic_cast<const Imf::IntAttribute*>(&attribute)) return number->value();
  if (const auto* numbers = dynamic_cast<const Imf::FloatVectorAttribute*>(&attribute)) return numbers->value();
  for (const auto floats : {floats_of<float>, floats_of<Imath::V2f>, floats_of<Imath::V3f>, floats_of<Imath::M33f>,
                            floats_of<Imath::M44f>, floats_of<Imath::Box2f>, floats_of<Imf::Chromaticities>})
    if (auto value = floats(attribute)) return value;
  return std::nullopt;
}

ExrType type_of(Imf::PixelType type) {
  return type == Imf::UINT ? ExrType::kUint : type == Imf::HALF ? ExrType::kHalf : ExrType::kFloat;
}
std::vector<ExrChannel> channels_of(const Imf::Header& header, const FileRef& file) {
  std::vector<ExrChannel> channels;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw file_error(ErrorKind::kMalformed, file.name,
                       "expected all channels to have a sample a texel, got '" + excerpt(c.name()) + "' with fewer");
    channels.push_back({c.name(), type_of(c.channel().type)});
  }
  return channels;
}

ExrReader::Windows windows_of(const Imf::Header& header) {
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  return {data.min.x, data.min.y, display.max.x - display.min.x + 1, display.max.y - display.min.y + 1,
          data == display};
}

// Of one channel, a level's rows from `first` on.
struct HeldChannel {
  std::string name;
  ExrType type;  // as stored
  std::vector<char> samples;
};

template <typename From>
void widen(const char* from, int count, char* to, std::size_t step) {
  for (int x = 0; x < count; x++, from += sizeof(From), to += step) {
    From sample;
    std::memcpy(&sample, from, sizeof sample);
    const float value = float(sample);
    std::memcpy(to, &value, sizeof value);
  }
}

void copy(std::size_t sample_bytes, const char* from, int count, char* to, std::size_t step) {
  if (sample_bytes == step) return void(std::memcpy(to, from, sample_bytes * count));
  for (int x = 0; x < count; x++, from += sample_bytes, to += step)
    sample_bytes == 2 ? std::memcpy(to, from, 2) : std::memcpy(to, from, 4);
}

}  // namespace

struct ExrReader::Impl {
  FileRef file;
  Imf::MultiPartInputFile in;
  std::vector<ExrChannel> channels;
  ExrAttributes attributes;
  Windows windows;
  int width, height;
  std::optional<Imf::InputPart> lines;  // one of the two
  std::optional<Imf::TiledInputPart> tiles;
  std::vector<HeldChannel> held;  // of a tiled file
  int held_level = -1, held_first = 0, held_end = 0;

  explicit Impl(const FileRef& from)
      : file(from),
        in(file.path.c_str()),
        channels(channels_of(header(), file)),
        windows(windows_of(header())),
        width(header().dataWindow().max.x - windows.x + 1),
        height(header().dataWindow().max.y - windows.y + 1) {
    if (header().hasType() && header().type().starts_with("deep"))
      throw file_error(ErrorKind::kUnsupported, file.name, "expected a flat image, got a volume or deep image");
    for (auto a = header().begin(); a != header().end(); ++a)
      if (auto value = value_of(a.attribute())) attributes.emplace_back(a.name(), std::move(*value));
    const bool tiled = header().hasType() ? header().type() == Imf::TILEDIMAGE : header().hasTileDescription();
    if (tiled) tiles.emplace(in, 0);
    else lines.emplace(in, 0);
  }

  const Imf::Header& header() const { return in.header(0); }
  bool has_levels() const { return tiles && tiles->levelMode() == Imf::MIPMAP_LEVELS; }

  // The buffer that OpenEXR thinks it writes to begins at the texel (0, 0), wherever that is.
  static void insert(Imf::FrameBuffer& buffer, const ExrSlice& slice, ExrType type, int x, int y) {
    char* first = static_cast<char*>(slice.first);
    buffer.insert(
        slice.channel,
        Imf::Slice(to_imf(type), first - std::ptrdiff_t(slice.texel_bytes) * x - std::ptrdiff_t(slice.row_bytes) * y,
                   slice.texel_bytes, slice.row_bytes));
  }

  void read_lines(int first, int count, const std::vector<ExrSlice>& to) {
    const int y = windows.y + first;
    Imf::FrameBuffer buffer;
    for (const ExrSlice& slice : to) insert(buffer, slice, slice.type, windows.x, y);
    lines->setFrameBuffer(buffer);
    lines->readPixels(y, y + count - 1);
  }

  ExrType stored_type(const std::string& name) const {
    const auto found = std::ranges::find(channels, name, &ExrChannel::name);
    if (found == channels.end()) throw file_error(ErrorKind::kInternal, file.name, "has no channel " + name);
    return found->type;
  }
  bool holds(int level, int row, const std::vector<ExrSlice>& wanted) const {
    return level == held_level && row >= held_first && row < held_end &&
           std::ranges::equal(held, wanted, {}, &HeldChannel::name, &ExrSlice::channel);
  }

  // The tiles of a row, from that one on, and of as many below as make some work for threads.
  void hold(int level, int row, const std::vector<ExrSlice>& wanted) {
    constexpr std::size_t kBytes = std::size_t(1) << 22;
    const std::size_t w = tiles->levelWidth(level);
    const int tile = int(tiles->tileYSize()), top = row / tile;
    held_level = -1;  // until it is whole
    held.resize(wanted.size());
    std::size_t texel_bytes = 0;
    for (std::size_t c = 0; c < wanted.size(); c++) {
      held[c].name = wanted[c].channel;
      held[c].type = stored_type(wanted[c].channel);
      texel_bytes += size_of(held[c].type);
    }
    const int at_once = int(std::max<std::size_t>(1, kBytes / (w * texel_bytes * tile)));
    const int bottom = std::min(top + at_once, tiles->numYTiles(level)) - 1;
    held_first = top * tile, held_end = std::min((bottom + 1) * tile, tiles->levelHeight(level));
    Imf::FrameBuffer buffer;
    for (HeldChannel& c : held) {
      const std::size_t bytes = size_of(c.type);
      c.samples.resize(bytes * w * (held_end - held_first));
      insert(buffer, {c.name, c.type, c.samples.data(), bytes, bytes * w}, c.type, windows.x, windows.y + held_first);
    }
    tiles->setFrameBuffer(buffer);
    tiles->readTiles(0, tiles->numXTiles(level) - 1, top, bottom, level, level);
    held_level = level;
  }

  void read_tiles(int level, int first, int count, const std::vector<ExrSlice>& to) {
    const int w = tiles->levelWidth(level);
    for (int y = 0; y < count; y++) {
      if (!holds(level, first + y, to)) hold(level, first + y, to);
      for (std::size_t c = 0; c < to.size(); c++) {
        const ExrType type = held[c].type;
        const char* from = held[c].samples.data() + size_of(type) * w * (first + y - held_first);
        char* row = static_cast<char*>(to[c].first) + to[c].row_bytes * y;
        if (to[c].type == type) copy(size_of(type), from, w, row, to[c].texel_bytes);
        else if (type == ExrType::kHalf) widen<half>(from, w, row, to[c].texel_bytes);
        else widen<std::uint32_t>(from, w, row, to[c].texel_bytes);
      }
    }
  }
};

ExrReader::ExrReader(const FileRef& file) {
  use_exr_threads();
  calling_exr(file, [&] { impl_ = std::make_unique<Impl>(file); });
}
ExrReader::~ExrReader() = default;

const std::vector<ExrChannel>& ExrReader::channels() const { return impl_->channels; }
const ExrAttributes& ExrReader::attributes() const { return impl_->attributes; }
const ExrValue* ExrReader::attribute(const std::string& name) const {
  const auto found = std::ranges::find(impl_->attributes, name, &ExrAttributes::value_type::first);
  return found == impl_->attributes.end() ? nullptr : &found->second;
}
int ExrReader::levels() const { return impl_->has_levels() ? impl_->tiles->numLevels() : 1; }
bool ExrReader::rounds_down() const {
  return !impl_->tiles ||
         (impl_->tiles->levelMode() != Imf::RIPMAP_LEVELS && impl_->tiles->levelRoundingMode() == Imf::ROUND_DOWN);
}
int ExrReader::width(int level) const { return level == 0 ? impl_->width : impl_->tiles->levelWidth(level); }
int ExrReader::height(int level) const { return level == 0 ? impl_->height : impl_->tiles->levelHeight(level); }
const ExrReader::Windows& ExrReader::windows() const { return impl_->windows; }

void ExrReader::read_rows(int level, int first, int count, const std::vector<ExrSlice>& to) {
  calling_exr(impl_->file, [&] {
    if (impl_->tiles) impl_->read_tiles(level, first, count, to);
    else impl_->read_lines(first, count, to);
  });
}

}  // namespace burnish::detail
