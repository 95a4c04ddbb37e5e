// A function sampled into a texture, and looked up in it bilinearly.
//
// Columns run over the first argument, rows over the second, row 0 being its low end. With n texels over [lo, hi]:
//   edge    texel i holds f at lo + i/(n−1) · (hi−lo): both ends are exact
//   centre  texel i holds f at lo + (i+½)/n · (hi−lo)
// and a lookup goes to the place between the texels' arguments; beyond the outermost ones it clamps.
//
// Layouts that save a shader the bias by ½ (Isidoro & Brennan), with centre sampling over [−1,1], for the address ½x:
//   offset half  shifted by half its size in both directions, for repeat addressing; at ±1 that mixes the two ends
//   cube z       rows reversed: the +Z face of a cube map, looked up with (x, y, 1)
#pragma once

#include "burnish/brdf/tables/lookup_function.h"
#include "burnish/core/image.h"

namespace burnish {

enum class TableSampling { kEdge, kCentre };
enum class TableLayout { kPlain, kOffsetHalf, kCubeZ };
const char* name(TableSampling sampling);
const char* name(TableLayout layout);

// Two columns or rows of texels that a place lies between, and how far it is from the first to the second.
struct TexelPair {
  int first, second;
  float share;
};

struct LookupTable {
  std::vector<Range> domain;
  TableSampling sampling = TableSampling::kEdge;
  TableLayout layout = TableLayout::kPlain;
  Image texels;  // true values

  // Bilinear, one value a channel, single precision. Arguments beyond the domain are taken for its ends (offset half:
  // for what lies there when it repeats). NaN gives the low end.
  void look_up(float x, float y, float* out) const { look_up(columns_at(x), rows_at(y), out); }
  // The same in parts, for many places of one row or column.
  TexelPair columns_at(float x) const;
  TexelPair rows_at(float y) const;
  void look_up(const TexelPair& columns, const TexelPair& rows, float* out) const;
};

inline constexpr int kMostTableSide = 1 << 15;
inline constexpr std::size_t kMostTableTexels = std::size_t(1) << 26;

// kUsage for a layout other than plain with edge sampling or another domain than [−1,1], and for sizes that are not [1,
// 32768] (edge sampling needs 2), not even where the layout asks for it, or that hold more than 2²⁶ texels; height is 1
// where there is one argument.
void require_table_shape(const LookupFunction& function, int width, int height, TableSampling sampling,
                         TableLayout layout);

// kUsage as require_valid and require_table_shape. In parallel.
LookupTable bake_table(const LookupFunction& function, int width, int height, TableSampling sampling,
                       TableLayout layout);

}  // namespace burnish
