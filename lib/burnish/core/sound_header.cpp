#include "burnish/core/sound_header.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>

#include "burnish/core/error.h"
#include "burnish/core/physical_memory.h"
#include "burnish/core/texel_limit.h"

namespace burnish {
namespace {

// A file's bytes in order, and how many there are.
class HeaderBytes {
 public:
  explicit HeaderBytes(const FileRef& file) : file_(file), in_(file.path, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    size_ = in_.tellg();
    in_.seekg(0);
  }

  explicit operator bool() const { return bool(in_); }
  std::int64_t size() const { return size_; }
  std::int64_t left() { return size_ - in_.tellg(); }
  void skip(std::int64_t count) { in_.seekg(count, std::ios::cur); }

  std::string take(std::size_t count) {
    std::string bytes(count, '\0');
    in_.read(bytes.data(), std::streamsize(count));
    return bytes;
  }
  std::string take_text() {
    std::string text;
    std::getline(in_, text, '\0');
    return text;
  }
  std::uint32_t little_endian() {
    const std::string b = take(4);
    return std::uint32_t(word(b, 3) << 24 | word(b, 2) << 16 | word(b, 1) << 8 | word(b, 0));
  }
  std::uint32_t big_endian() {
    const std::string b = take(4);
    return std::uint32_t(word(b, 0) << 24 | word(b, 1) << 16 | word(b, 2) << 8 | word(b, 3));
  }

  // Written out, behind blanks and comments; 0 where there is none.
  std::uint32_t number() {
    while (std::isspace(in_.peek()) || in_.peek() == '#')
      in_.ignore(in_.peek() == '#' ? std::numeric_limits<std::streamsize>::max() : 1, '\n');
    std::uint32_t number = 0;
    return in_ >> number ? number : 0;
  }

  // Of what is called so, where it has that many bytes.
  void require_left(std::int64_t count, const std::string& what) {
    if (count > left())
      fail("expected " + std::to_string(count) + " bytes of " + what + ", got " + std::to_string(left()));
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw file_error(ErrorKind::kMalformed, file_.name, message);
  }
  const std::string& name() const { return file_.name; }

 private:
  static std::uint32_t word(const std::string& bytes, int i) { return std::uint8_t(bytes[i]); }

  const FileRef& file_;
  std::ifstream in_;
  std::int64_t size_ = 0;
};

std::string size_text(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// OpenEXR reads types that it knows by what they are, and goes on from there.
bool has_size_of_its_type(std::string_view type, const std::string& value) {
  struct Fixed {
    std::string_view type;
    std::size_t size;
  };
  static constexpr Fixed kFixed[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};
  if (const auto* found = std::ranges::find(kFixed, type, &Fixed::type); found != std::end(kFixed))
    return value.size() == found->size;
  if (type == "floatvector") return value.size() % 4 == 0;
  if (type != "chlist") return true;
  // Names of channels, each ended by a NUL and followed by 16 bytes; an empty one ends them.
  std::size_t at = 0;
  while (at < value.size() && value[at] != '\0') {
    const std::size_t end = value.find('\0', at);
    if (end == std::string::npos) return false;
    at = end + 1 + 16;
  }
  return at + 1 == value.size();
}

// Whether deflate could pack so many texels into the file, of a byte at least; few are too few to matter, as those of a
// tile larger than its image.
bool may_hold(const HeaderBytes& in, std::int64_t texels) {
  constexpr std::int64_t kMostExpansion = 1032, kFew = 1 << 16;
  return texels <= kFew || texels / kMostExpansion <= in.size();
}

std::int64_t number_at(std::string_view value, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | std::uint8_t(value[at + i]);
  return std::int32_t(number);
}

void require_sound_window(HeaderBytes& in, std::string_view box) {
  if (const std::int64_t width = number_at(box, 8) - number_at(box, 0) + 1; !may_hold(in, width))
    in.fail("is too short for rows of " + std::to_string(width) + " texels");
}

void require_sound_tile(HeaderBytes& in, std::string_view description) {
  const std::int64_t width = number_at(description, 0), height = number_at(description, 4);
  if (!may_hold(in, width * height)) in.fail("is too short for tiles of " + size_text(width, height) + " texels");
}

// Magic, version, then attributes: name and type, each ended by a NUL, a size and as many bytes. An empty name ends a
// header, and where there are several an empty header ends them.
void require_sound_exr(HeaderBytes& in) {
  constexpr std::uint32_t kSeveralParts = 0x1000;  // of the version
  in.skip(4);
  const bool several = in.little_endian() & kSeveralParts;
  for (bool is_first = true;;) {
    const std::string name = in.take_text();
    if (!in) return;
    if (name.empty() && (is_first || !several)) return;
    is_first = name.empty();
    if (is_first) continue;
    const std::string type = in.take_text();
    const std::int64_t size = in.little_endian();
    if (!in) return;
    in.require_left(size, "the attribute '" + excerpt(name) + "'");
    const std::string value = in.take(std::size_t(size));
    if (!has_size_of_its_type(type, value))
      in.fail("expected the attribute '" + excerpt(name) + "' of the size of its type, got " + std::to_string(size) +
              " bytes");
    if (name == "dataWindow" && type == "box2i") require_sound_window(in, value);
    if (name == "tiles" && type == "tiledesc") require_sound_tile(in, value);
  }
}

// Behind the signature chunks: a size, a name, as many bytes, a checksum.
void require_sound_png(HeaderBytes& in) {
  constexpr std::int64_t kChecksum = 4;
  in.skip(8);
  while (in.left() > 0) {
    const std::int64_t size = in.big_endian();
    const std::string name = in.take(4);
    if (!in) return;
    if (name != "IDAT") in.require_left(size, "the chunk " + excerpt(name));
    in.skip(size + kChecksum);
  }
}

// From byte 14 on: the size of what follows, then width and height, of 16 bits where that size is 12.
void require_sound_bmp(HeaderBytes& in) {
  constexpr std::int64_t kMostTexels = 128;  // in a byte
  in.skip(14);
  const bool is_old = in.little_endian() == 12;
  const std::uint32_t first = in.little_endian(), second = in.little_endian();
  if (!in) return;
  const std::int64_t width = is_old ? first & 0xffff : std::int32_t(first),
                     height = is_old ? first >> 16 : std::abs(std::int64_t(std::int32_t(second)));
  if (width * height > in.size() * kMostTexels) in.fail("is too short for " + size_text(width, height) + " texels");
  if (width > 0) require_within_texel_limit(in.name(), std::uint32_t(width), std::uint32_t(height));
}

// Segments: 0xff, what it is, its length of 16 bits, which counts itself. Frames say their height and width behind a
// byte.
void require_sound_jpeg(HeaderBytes& in) {
  constexpr std::int64_t kMostTexels = 8 * 32 * 32;  // in a byte
  in.skip(2);
  for (std::uint32_t head = in.big_endian(); in && head >> 24 == 0xff; head = in.big_endian()) {
    const std::uint32_t kind = head >> 16 & 0xff;
    if (kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc) {
      in.skip(1);
      const std::uint32_t sides = in.big_endian(), height = sides >> 16, width = sides & 0xffff;
      if (in && std::int64_t(width) * height / kMostTexels <= in.size())
        require_within_texel_limit(in.name(), width, height);
      return;
    }
    in.skip(std::int64_t(head & 0xffff) - 2);
  }
}

// Taken whole as it is opened, however few texels it speaks of.
void require_sound_pnm(HeaderBytes& in) {
  in.skip(2);
  const std::uint32_t width = in.number(), height = in.number();
  if (std::uint64_t(width) * height / 8 <= std::uint64_t(in.size()))
    require_within_texel_limit(in.name(), width, height);
  require_memory_for(in.name(), std::uint64_t(in.size()));
}

}  // namespace

void require_sound_header(const FileRef& file) {
  HeaderBytes in(file);
  const std::string magic = in.take(4);
  if (!in) return;
  in.skip(-4);
  if (magic == "v/1\x01") require_sound_exr(in);
  else if (magic == "\x89PNG") require_sound_png(in);
  else if (magic.starts_with("BM")) require_sound_bmp(in);
  else if (magic.starts_with("\xff\xd8\xff")) require_sound_jpeg(in);
  else if (magic[0] == 'P' && std::isalnum(std::uint8_t(magic[1]))) require_sound_pnm(in);
}

}  // namespace burnish
