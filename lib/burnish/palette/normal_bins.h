// Octahedral bins of normals, for maps that hold too many to keep them all.
//
// Bins of 2·16 bits, made coarser whenever there are more than 2^20 of them. A bin sums up its normals in integers, so
// that neither their order nor how they were divided among sums shows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "burnish/core/vec3.h"
#include "burnish/palette/key_table.h"
#include "burnish/palette/octahedral.h"

namespace burnish {

class NormalBins {
 public:
  void add(int material, bool counts, Vec3f n) {
    const Vec3d v(n);
    add(std::uint64_t(material) << 40 | std::uint64_t(counts) << 32 | pack_octahedral(v, kBits),
        {std::llround(v.x * kUnit), std::llround(v.y * kUnit), std::llround(v.z * kUnit), 1});
  }
  void add(const NormalBins& other) {
    while (shift_ < other.shift_) coarsen();
    place_.reserve(other.place_.size());
    other.place_.for_each([&](std::uint64_t key, std::uint32_t place) { add(key, other.sums_[place - 1]); });
  }
  // body(material, counts, mean normal, texels), in ascending order of material.
  template <typename Body>
  void for_each_sorted(const Body& body) const {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { sorted.emplace_back(key, place); });
    std::ranges::sort(sorted);
    for (const auto& [key, place] : sorted) {
      const Sum& s = sums_[place - 1];
      const Vec3d v{double(s.x), double(s.y), double(s.z)};
      body(int(key >> 40), (key >> 32 & 1) != 0, length(v) > 0 ? Vec3f(normalized(v)) : Vec3f{0, 0, 1}, s.texels);
    }
  }

 private:
  static constexpr std::size_t kMost = std::size_t(1) << 20;
  static constexpr int kBits = 16;
  static constexpr double kUnit = 1 << 26;
  struct Sum {
    std::int64_t x, y, z;
    std::uint64_t texels;
  };

  void add(std::uint64_t key, const Sum& s) {
    const std::uint64_t low = 0xffffu >> shift_ << shift_;
    std::uint32_t& place = place_[key & (~std::uint64_t(0xffffffffu) | low << 16 | low)];
    if (place == 0) {  // new
      sums_.push_back({});
      place = std::uint32_t(sums_.size());
    }
    Sum& t = sums_[place - 1];
    t.x += s.x, t.y += s.y, t.z += s.z, t.texels += s.texels;
    if (sums_.size() > kMost) coarsen();
  }
  void coarsen() {
    NormalBins next;
    next.shift_ = shift_ + 1;
    next.place_.reserve(place_.size());
    place_.for_each([&](std::uint64_t key, std::uint32_t place) { next.add(key, sums_[place - 1]); });
    *this = std::move(next);
  }

  int shift_ = 0;
  KeyTable place_;  // position in sums_ plus one
  std::vector<Sum> sums_;
};

}  // namespace burnish
