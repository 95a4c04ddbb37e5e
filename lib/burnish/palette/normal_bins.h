// Octahedral bins of normals, for maps that hold too many to keep them all.
//
// Bins of 2·16 bits, made coarser whenever there are more than 2^20 of them. A bin sums up its normals in integers, so
// that neither their order nor how they were divided among sums shows. kUnsupported for more than 2^35 texels in one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/vec3.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/octahedral.h"

namespace burnish {

class NormalBins {
 public:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  static constexpr int kBits = 16;
  static constexpr double kUnit = 1 << 26;  // what a sum has of a component of 1
  // Of one bin, so that no sum overflows.
  static constexpr std::uint64_t kMostTexels = std::uint64_t(1) << 35;

  struct Sum {
    std::int64_t x = 0, y = 0, z = 0;
    std::uint64_t texels = 0;
  };
  struct Bin {
    std::uint64_t key;  // material << 40 | counts << 32 | octahedral coordinates without their lowest shift() bits
    Sum sum;

    int material() const { return int(key >> 40); }
    bool counts() const { return (key >> 32 & 1) != 0; }
    Vec3f mean() const {
      const Vec3d v{double(sum.x), double(sum.y), double(sum.z)};
      return length(v) > 0 ? Vec3f(normalized(v)) : Vec3f{0, 0, 1};
    }
  };

  explicit NormalBins(int shift = 0) : shift_(shift) {}

  void add(int material, bool counts, Vec3f n, std::uint64_t texels = 1) {
    require_room(texels);
    const Vec3d v(n);
    const auto sum = [&](double component) { return std::llround(component * kUnit) * std::int64_t(texels); };
    add({std::uint64_t(material) << 40 | std::uint64_t(counts) << 32 | pack_octahedral(v, kBits),
         {sum(v.x), sum(v.y), sum(v.z), texels}});
  }
  void add(const Bin& bin) {
    std::uint32_t& place = place_[bin.key & kept_bits(shift_)];
    if (place == 0) {  // new
      if (2 * sums_.size() > kMost) sums_.reserve(kMost + 1);  // doubled, it would be twice that
      sums_.push_back({});
      place = std::uint32_t(sums_.size());
    }
    Sum& t = sums_[place - 1];
    const Sum& s = bin.sum;
    require_room(t.texels + s.texels);
    t.x += s.x, t.y += s.y, t.z += s.z, t.texels += s.texels;
    if (sums_.size() > kMost) coarsen();
  }
  void add(const NormalBins& other) {
    while (shift_ < other.shift_) coarsen();
    place_.reserve(other.place_.size());
    other.place_.for_each([&](std::uint64_t key, std::uint32_t place) { add({key, other.sums_[place - 1]}); });
  }

  // How many bits coarser each coordinate is than 16.
  int shift() const { return shift_; }
  // Of keys; and whether a number from elsewhere is one.
  static std::uint64_t kept_bits(int shift) {
    const std::uint64_t low = 0xffffu >> shift << shift;
    return ~std::uint64_t(0xffffffffu) | low << 16 | low;
  }
  static bool is_key(std::uint64_t number, int shift) {
    const std::uint64_t most = (1 << kBits) - 2, u = number >> kBits & 0xffff, v = number & 0xffff;
    return number >> 48 == 0 && (number >> 33 & 0x7f) == 0 && (number & kept_bits(shift)) == number &&
           std::max(u, v) <= most;
  }
  std::vector<Bin> sorted() const {
    std::vector<Bin> out;
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { out.push_back({key, sums_[place - 1]}); });
    std::ranges::sort(out, {}, &Bin::key);
    return out;
  }

 private:
  static void require_room(std::uint64_t texels) {
    if (texels > kMostTexels)
      throw Error(ErrorKind::kUnsupported,
                  "expected at most " + std::to_string(kMostTexels) + " texels of one normal, got more");
  }
  void coarsen() {
    NormalBins next(shift_ + 1);
    next.place_.reserve(place_.size());
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { next.add({key, sums_[place - 1]}); });
    *this = std::move(next);
  }

  int shift_;
  KeyTable place_;  // position in sums_ plus one
  std::vector<Sum> sums_;
};

}  // namespace burnish
