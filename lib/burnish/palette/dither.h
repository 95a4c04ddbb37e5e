// Dithering with a palette of normals: error diffusion from row to row, or from dot to dot in the order of a blue-noise
// tile.
//
// What is passed on is the part of the error tangential to the texel's own normal, e − (e·n)n: the radial part cannot
// be paid back by unit vectors and would make the dither drift.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/core/vec3.h"
#include "burnish/palette/nearest_entry.h"

namespace burnish {

enum class Dither { kNone, kDiffusion, kBlueNoise };

// The entries of one material: where they begin in the palette, and how to find the nearest of them.
struct EntryRange {
  int first = 0;
  NearestEntry nearest;
};

// Error diffusion with the weights of Sierra's "Filter Lite" (½ ahead, ¼ below, ¼ below and behind): of the usual
// filters the more compact ones leave the least error in the mean of a few texels. Rows from the top, by turns from the
// left and the right.
class ErrorDiffusion {
 public:
  // `amount` in [0,1] scales the error that is passed on. `ranges` are chosen by the texels' region numbers.
  ErrorDiffusion(std::span<const Vec3f> entries, std::span<const EntryRange* const> ranges, int width, double amount);

  // The next row. `region` numbers what borders keep apart (material and mask): error passes between texels of equal
  // number only. `region_below` is null in the last row.
  void row(const Vec3f* normals, const std::uint16_t* region, const std::uint16_t* region_below, std::uint16_t* out);

 private:
  std::span<const Vec3f> entries_;
  std::span<const EntryRange* const> ranges_;
  int width_;
  float amount_;
  bool leftward_ = false;
  std::vector<Vec3f> here_, below_;  // error that has arrived
};

// Dot diffusion (Knuth, "Digital halftones by dot diffusion", ACM TOG 1987) with a void-and-cluster tile for its class
// matrix: texels are taken in the order of their rank in the tile and pass their error to the neighbours, within two
// texels, that come later, by 1/distance⁴. No direction is preferred and no worms appear, and unlike with thresholds
// the error of a texel is made good nearby even where the normals change from texel to texel. A band is dithered by
// itself, so that bands can run in parallel.
constexpr int kDotBandRows = 128;

// `rows` is at most kDotBandRows, all of it but at the bottom of the map; the other arguments are those of
// ErrorDiffusion.
void diffuse_dots(std::span<const Vec3f> entries, std::span<const EntryRange* const> ranges, int width, int rows,
                  const Vec3f* normals, const std::uint16_t* region, double amount, std::uint16_t* out);

}  // namespace burnish
