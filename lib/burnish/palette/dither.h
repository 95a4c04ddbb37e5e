// Dithering with a palette of normals, by error diffusion or against a blue-noise tile.
//
// What is passed on is the part of the error tangential to the texel's own normal, e − (e·n)n: the radial part cannot be paid
// back by unit vectors and would make the dither drift.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/core/vec3.h"
#include "burnish/palette/nearest_entry.h"

namespace burnish {

// The entries of one material: where they begin in the palette, and how to find the nearest of them.
struct EntryRange {
  int first = 0;
  NearestEntry nearest;
};

// Error diffusion with Floyd–Steinberg weights; rows from the top, by turns from the left and from the right.
class ErrorDiffusion {
 public:
  // `amount` in [0,1] scales the error that is passed on. `ranges` are chosen by the texels' region numbers.
  ErrorDiffusion(std::span<const Vec3f> entries, std::span<const EntryRange* const> ranges, int width, double amount);

  // The next row. `region` numbers what borders keep apart (material and mask): error passes between texels of equal number
  // only. `region_below` is null in the last row.
  void row(const Vec3f* normals, const std::uint16_t* region, const std::uint16_t* region_below, std::uint16_t* out);

 private:
  std::span<const Vec3f> entries_;
  std::span<const EntryRange* const> ranges_;
  int width_;
  float amount_;
  bool leftward_ = false;
  std::vector<Vec3f> here_, below_;  // error that has arrived
};

// The entries that stand for a normal where it is dithered in order: kOrderedSteps of them, whose mean comes close to it (Knoll's
// pattern dithering), sorted. A texel takes the one at its rank in the tile.
constexpr int kOrderedSteps = 16;
std::array<std::uint16_t, kOrderedSteps> ordered_entries(std::span<const Vec3f> entries, const EntryRange& range, Vec3f normal,
                                                         double amount);
// Which of them the texel at (x, y) takes.
int ordered_step(int x, int y);

}  // namespace burnish
