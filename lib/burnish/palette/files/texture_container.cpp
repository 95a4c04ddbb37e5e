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

ContainerReader::ContainerReader(const FileRef& file) : in_(file.path, std::ios::binary), name_(file.name) {
  in_.seekg(0, std::ios::end);
  const std::streamoff size = in_.tellg();
  if (!in_ || size < 0) throw file_error(ErrorKind::kIo, name_, "cannot be read");
  size_ = std::uint64_t(size);
}

void ContainerReader::require(std::uint64_t offset, std::uint64_t count, const std::string& what) const {
  if (offset > size_ || count > size_ - offset)
    throw file_error(ErrorKind::kMalformed, name_,
                     "is too short for " + what + ": expected " + std::to_string(count) + " bytes at " +
                         std::to_string(offset) + ", got a file of " + std::to_string(size_));
}

std::string ContainerReader::read(std::uint64_t offset, std::uint64_t count, const std::string& what) {
  require(offset, count, what);
  std::string bytes(std::size_t(count), '\0');
  in_.seekg(std::streamoff(offset));
  if (!in_.read(bytes.data(), std::streamsize(count))) throw file_error(ErrorKind::kIo, name_, "cannot be read");
  return bytes;
}

ContainerSource::ContainerSource(ContainerReader in, int base_width, int base_height,
                                 std::vector<std::uint64_t> offsets, int bytes_per_index)
    : in_(std::move(in)), offsets_(std::move(offsets)), bytes_(bytes_per_index) {
  width = base_width, height = base_height, levels = int(offsets_.size());
  for (int l = 0; l < levels; l++) {
    const int w = level_size(width, l), h = level_size(height, l);
    in_.require(offsets_[l], std::uint64_t(w) * h * bytes_, std::to_string(w) + "x" + std::to_string(h) + " texels");
  }
}

void ContainerSource::read_rows(int level, int first, int count, std::uint16_t* out) {
  const std::uint64_t row = std::uint64_t(level_size(width, level)) * bytes_;
  const std::string bytes = in_.read(offsets_[level] + row * first, row * count, "its texels");
  for (std::size_t i = 0; i < bytes.size() / bytes_; i++) out[i] = std::uint16_t(number_at(bytes, i * bytes_, bytes_));
}

ContainerTarget::ContainerTarget(const FileRef& file, const std::string& head, int width,
                                 std::vector<std::uint64_t> offsets, int bytes_per_index)
    : file_(file.path), name_(file.name), width_(width), next_(std::move(offsets)), bytes_(bytes_per_index) {
  file_.write(head.data(), head.size());
  check();
}

void ContainerTarget::write_rows(int level, int count, const std::uint16_t* rows) {
  const std::size_t texels = std::size_t(level_size(width_, level)) * count;
  std::string bytes(texels * bytes_, '\0');
  for (std::size_t i = 0; i < texels; i++)
    for (int b = 0; b < bytes_; b++) bytes[i * bytes_ + b] = char(rows[i] >> 8 * b);
  file_.seek(std::int64_t(next_[level]));
  file_.write(bytes.data(), bytes.size());
  check();
  next_[level] += bytes.size();
}

void ContainerTarget::close() {
  file_.close();
  check();
}

void ContainerTarget::check() const {
  if (file_.first_error()) throw file_.error(name_);
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
