// Each texel's stored normal as one number of 53 bits, so that equal texels are recognised without decoding them.
//
// uint8, uint16 and half samples are packed as they stand, 16 bits a component. Float samples are decoded and packed as
// octahedral coordinates of 24 bits each, 1e-7 apart: as fine as float itself. The five bits above say which of these
// it is and, of samples as they stand, how they are decoded: a key means the same normal whatever map it is of, and
// maps of any samples and codings can be counted together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "burnish/normal/coding.h"

namespace burnish {

class TexelKeys {
 public:
  TexelKeys(const FileRef& file, const NormalCoding& coding);

  int width() const { return reader_.width(); }
  int height() const { return reader_.height(); }
  const std::string& name() const { return reader_.name(); }

  static constexpr int kBits = 53;

  // Keys of rows [first, first + count), each below 2^kBits. A map of moderate size is kept in memory as it is stored,
  // a larger one is read again. kMalformed for NaN or infinity.
  void read_rows(int first, int count, std::uint64_t* keys);

  // The unit vector of a key; `invalid` where it was too short to have a direction.
  static Vec3f decode(std::uint64_t key, bool& invalid);
  // Whether read_rows could give it: for numbers from elsewhere.
  static bool is_key(std::uint64_t number);

 private:
  void pack(const std::byte* samples, std::size_t texels, std::uint64_t* keys, int first_row) const;

  enum class Packing { kBytes, kWords, kHalves, kOctahedral };

  NormalReader reader_;
  Packing packing_;
  std::uint64_t tag_;  // packing and coding, above the 48 bits of the vector
  std::size_t row_bytes_;
  std::unique_ptr<std::byte[]> whole_;  // room for all rows as stored; none where they are too many
  int loaded_rows_ = 0;                 // of them, those that have been read
};

}  // namespace burnish
