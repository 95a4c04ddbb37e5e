// The data of a PLY file, a row for each element, from text or from bytes. Both kinds of rows have the same functions:
//   begin(element, i, count)  where i of count elements begins
//   number(type)              the next value, finite
//   integer(type)             the next value of an integer type
//   skip(count, type)         passes over values
//   end()                     where the element ends
//   end_of_file()             after the last
//   refuse(expected, got)     kMalformed, with the line or the element
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "burnish/core/error.h"
#include "burnish/mesh/files/ply_header.h"

namespace burnish {

// An element a line.
class PlyTextRows {
 public:
  explicit PlyTextRows(TextLines& lines) : lines_(lines) {}

  void begin(const std::string& element, std::uint64_t i, std::uint64_t count) {
    if (!lines_.next_line())
      refuse(element + " " + std::to_string(i + 1) + " of " + std::to_string(count), "the end of the file");
  }
  double number(PlyType type) { return is_integer(type) ? double(integer(type)) : lines_.number(); }
  std::int64_t integer(PlyType type) {
    static constexpr std::int64_t kMost[] = {0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0xffffffff};
    const std::int64_t value = lines_.integer<std::int64_t>("an integer"), most = kMost[int(type)];
    const bool is_signed = int(type) % 2 == 0;
    if (value > most || value < (is_signed ? -most - 1 : 0)) refuse("an integer of its type", std::to_string(value));
    return value;
  }
  void skip(std::uint64_t count, PlyType) {
    for (std::uint64_t i = 0; i < count; i++)
      if (lines_.word().empty()) lines_.refuse_word("a value", {});
  }
  void end() { lines_.require_line_end(); }
  void end_of_file() {
    if (lines_.next_line()) lines_.refuse_word("the end of the file", lines_.word());
  }
  [[noreturn]] void refuse(const std::string& expected, const std::string& got) const { lines_.refuse(expected, got); }

 private:
  TextLines& lines_;
};

template <std::endian kOrder>
class PlyBinaryRows {
 public:
  PlyBinaryRows(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void begin(const std::string& element, std::uint64_t i, std::uint64_t) { element_ = &element, row_ = i; }
  double number(PlyType type) {
    if (is_integer(type)) return double(integer(type));
    const double value = type == PlyType::kFloat ? take<float>() : take<double>();
    if (!in_range(value)) {
      char text[32];
      refuse(kInRange, std::string(text, std::to_chars(text, text + sizeof text, value).ptr));
    }
    return value;
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      default:
        return take<std::uint32_t>();
    }
  }
  void skip(std::uint64_t count, PlyType type) {
    static constexpr std::uint64_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::uint64_t size = kBytes[int(type)];
    if (count > bytes_.size() / size) refuse_end();
    bytes_.remove_prefix(count * size);
  }
  void end() {}
  void end_of_file() {
    if (!bytes_.empty())
      throw file_error(
          ErrorKind::kMalformed, name_,
          "expected the file to end with its last element, got further bytes (" + std::to_string(bytes_.size()) + ")");
  }
  [[noreturn]] void refuse(const std::string& expected, const std::string& got) const {
    throw file_error(ErrorKind::kMalformed, name_,
                     *element_ + " " + std::to_string(row_ + 1) + ": expected " + expected + ", got " + got);
  }

 private:
  template <typename T>
  T take() {
    if (bytes_.size() < sizeof(T)) refuse_end();
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data(), sizeof(T));
    if constexpr (kOrder != std::endian::native) std::ranges::reverse(raw);
    bytes_.remove_prefix(sizeof(T));
    return std::bit_cast<T>(raw);
  }
  [[noreturn]] void refuse_end() const { refuse("more values", "the end of the file"); }

  std::string_view bytes_;
  const std::string& name_;
  const std::string* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace burnish
