// One reader a file type, for measured_brdf.cpp; `bytes` are the whole file. What the files hold and which errors are
// thrown stands in measured_brdf.h.
#pragma once

#include <bit>
#include <cstring>
#include <memory>
#include <string>

#include "burnish/brdf/brdf.h"
#include "burnish/brdf/measured/half_difference_table.h"

namespace burnish {

std::shared_ptr<const Brdf> parse_merl(const std::string& bytes, const std::string& name);
// Interpolated into cells, which takes time that follows their number.
std::shared_ptr<const Brdf> parse_cornell(const std::string& bytes, const std::string& name,
                                          const HalfDifferenceCells& cells = {});
std::shared_ptr<const Brdf> parse_mbsdf(const std::string& bytes, const std::string& name);

// The files are little-endian, and so is the machine.
template <typename T>
T value_at(const std::string& bytes, std::size_t at) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace burnish
