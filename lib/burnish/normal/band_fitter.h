// The planes of a band of a displacement map, and their normals as samples (plane_fit.h, coding.h).
//
// Whole neighbourhoods are convolved; those that are not, at borders that end the map and beside masked texels, are
// solved one by one. Each row on its own: no result depends on where a band ends.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "burnish/normal/height_bands.h"
#include "burnish/normal/plane_fit.h"

namespace burnish {

struct NormalBand {
  int first = 0, rows = 0;
  std::unique_ptr<std::byte[]> samples;  // as encode_normals makes them
  double tilt_sum = 0, steepest = 0;     // of angles; tangent of half the largest
  std::size_t taking_part = 0, degenerate = 0;
};

class BandFitter {
 public:
  // Of a map of that size and name. The neighbourhood and the target are kept by reference.
  BandFitter(const Neighborhood& neighborhood, const HeightMapOptions& options, int width, int height,
             const NormalMapTarget& target, const std::string& name);

  // May be called from many threads. kMalformed for slopes beyond floating point.
  NormalBand fit(const HeightBand& band) const;

 private:
  struct Block;
  static constexpr int kMostRadius = 4;

  void derivative_u(const float* in, int count, float* out) const;
  void smooth_u(const float* across, int count, float* out) const;
  void derivative_v(const float* rows, int stride, int count, float* out) const;
  void solve_incomplete(const HeightBand& band, int y, Block& block, NormalBand& out) const;
  void solve(const HeightBand& band, int x, int y, Block& block, NormalBand& out) const;

  std::string name_;
  const Neighborhood& n_;
  bool fit_u_, fit_v_;
  int width_, height_;
  const NormalMapTarget& target_;
  double scale_u_, scale_v_;
};

}  // namespace burnish
