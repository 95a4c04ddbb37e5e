#include "burnish/palette/files/texture_container.h"

#include <algorithm>
#include <limits>

#include "burnish/core/mip.h"

namespace burnish::detail {
namespace {

void append(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; i++) out += char(value >> 8 * i & 255);
}

std::uint64_t number_at(std::string_view bytes, std::size_t offset, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; i++) value |= std::uint64_t(std::uint8_t(bytes[offset + i])) << 8 * i;
  return value;
}

}  // namespace

void append_u32(std::string& out, std::uint32_t value) { append(out, value, 4); }
void append_u64(std::string& out, std::uint64_t value) { append(out, value, 8); }
std::uint32_t u32_at(std::string_view bytes, std::size_t offset) { return std::uint32_t(number_at(bytes, offset, 4)); }
std::uint64_t u64_at(std::string_view bytes, std::size_t offset) { return number_at(bytes, offset, 8); }

void ContainerWriter::write(std::string_view bytes) {
  file_.write(bytes.data(), bytes.size());
  check();
}

void ContainerWriter::write_texels(const IndexImage& level, int bytes_per_index) {
  std::string row(std::size_t(level.width) * bytes_per_index, '\0');
  for (int y = 0; y < level.height; y++) {
    const std::uint16_t* in = level.row(y);
    if (bytes_per_index == 1)
      std::transform(in, in + level.width, row.begin(), [](std::uint16_t i) { return char(i); });
    else
      for (int x = 0; x < level.width; x++) row[2 * x] = char(in[x]), row[2 * x + 1] = char(in[x] >> 8);
    write(row);
  }
}

void ContainerWriter::close() {
  file_.close();
  check();
}

void ContainerWriter::check() const {
  if (file_.first_error()) throw file_.error(name_);
}

ContainerReader::ContainerReader(const FileRef& file) : in_(file.path, std::ios::binary), name_(file.name) {
  in_.seekg(0, std::ios::end);
  const std::streamoff size = in_.tellg();
  if (!in_ || size < 0) throw file_error(ErrorKind::kIo, name_, "cannot be read");
  size_ = std::uint64_t(size);
}

void ContainerReader::seek(std::uint64_t offset, std::uint64_t count, const std::string& what) {
  if (offset > size_ || count > size_ - offset)
    throw file_error(ErrorKind::kMalformed, name_,
                     "is too short for " + what + ": expected " + std::to_string(count) + " bytes at " +
                         std::to_string(offset) + ", got a file of " + std::to_string(size_));
  in_.seekg(std::streamoff(offset));
}

void ContainerReader::fill(char* to, std::size_t count) {
  if (!in_.read(to, std::streamsize(count))) throw file_error(ErrorKind::kIo, name_, "cannot be read");
}

std::string ContainerReader::read(std::uint64_t offset, std::uint64_t count, const std::string& what) {
  seek(offset, count, what);
  std::string bytes(std::size_t(count), '\0');
  fill(bytes.data(), bytes.size());
  return bytes;
}

IndexImage ContainerReader::read_texels(std::uint64_t offset, int width, int height, int bytes_per_index) {
  const std::uint64_t row_bytes = std::uint64_t(width) * bytes_per_index;
  seek(offset, row_bytes * height, std::to_string(width) + "x" + std::to_string(height) + " texels");
  IndexImage level(width, height);
  std::string row(std::size_t(row_bytes), '\0');
  for (int y = 0; y < height; y++) {
    fill(row.data(), row.size());
    for (int x = 0; x < width; x++)
      level.row(y)[x] = std::uint16_t(number_at(row, std::size_t(x) * bytes_per_index, bytes_per_index));
  }
  return level;
}

Error unsupported(const FileRef& file, const std::string& expected, const std::string& got) {
  return file_error(ErrorKind::kUnsupported, file.name, "expected " + expected + ", got " + got);
}

void require_sane_levels(const FileRef& file, std::uint32_t width, std::uint32_t height, std::uint32_t levels) {
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
  if (width < 1 || height < 1 || width > kMost || height > kMost)
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected texels, got " + std::to_string(width) + "x" + std::to_string(height));
  if (const int most = level_count(int(width), int(height)); levels > std::uint32_t(most))
    throw file_error(ErrorKind::kMalformed, file.name,
                     "expected at most " + std::to_string(most) + " levels of " + std::to_string(width) + "x" +
                         std::to_string(height) + " texels, got " + std::to_string(levels));
}

}  // namespace burnish::detail
