#include "burnish/brdf/tables/lookup_table.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/parallel.h"
#include "burnish/core/wording.h"

namespace burnish {
namespace {

// The texel that holds argument number i, counted from the low end.
int place_of(int i, int n, TableLayout layout, bool row) {
  if (layout == TableLayout::kOffsetHalf) return (i + n / 2) % n;
  return layout == TableLayout::kCubeZ && row ? n - 1 - i : i;
}

TexelPair between(float x, Range r, int n, const LookupTable& t, bool row) {
  const float share_of_domain = (x - float(r.least)) / float(r.most - r.least);
  const bool edge = t.sampling == TableSampling::kEdge, repeats = t.layout == TableLayout::kOffsetHalf;
  float place = edge ? share_of_domain * float(n - 1) : share_of_domain * float(n) - 0.5f;
  if (!repeats) place = std::clamp(place, 0.0f, float(n - 1));
  if (!(place > -float(n))) place = repeats ? -0.5f : 0;  // NaN, and what would not fit an int
  place = std::min(place, 2 * float(n));
  const float whole = std::floor(place);
  int first = int(whole), second = first + 1;
  if (repeats) first = (first + 2 * n) % n, second = (second + 2 * n) % n;
  else second = std::min(second, n - 1);
  return {place_of(first, n, t.layout, row), place_of(second, n, t.layout, row), place - whole};
}

double argument(int i, int n, Range r, TableSampling sampling) {
  const double share = sampling == TableSampling::kEdge ? double(i) / (n - 1) : (i + 0.5) / n;
  return r.least + share * (r.most - r.least);
}

// "-1:1,-1:1"
std::string domain_text(const std::vector<Range>& domain) {
  std::vector<std::string> ranges;
  for (const Range r : domain) ranges.push_back(number_text(r.least) + ":" + number_text(r.most));
  return joined(ranges, ",");
}

void require_side(const char* what, int n, TableSampling sampling, TableLayout layout) {
  const int least = sampling == TableSampling::kEdge ? 2 : 1;
  if (n < least || n > kMostTableSide)
    throw Error(ErrorKind::kUsage, std::string("size: expected a ") + what + " of " + std::to_string(least) + " to " +
                                       std::to_string(kMostTableSide) + ", got " + std::to_string(n));
  if (layout == TableLayout::kOffsetHalf && n % 2)
    throw Error(ErrorKind::kUsage,
                std::string("size: the layout offset-half needs an even ") + what + ", got " + std::to_string(n));
}

}  // namespace

const char* name(TableSampling sampling) { return sampling == TableSampling::kEdge ? "edge" : "centre"; }
const char* name(TableLayout layout) {
  return layout == TableLayout::kPlain ? "plain" : layout == TableLayout::kOffsetHalf ? "offset-half" : "cube-z";
}

TexelPair LookupTable::columns_at(float x) const { return between(x, domain[0], texels.width, *this, false); }
TexelPair LookupTable::rows_at(float y) const {
  return domain.size() > 1 ? between(y, domain[1], texels.height, *this, true) : TexelPair{0, 0, 0};
}

void LookupTable::look_up(const TexelPair& u, const TexelPair& v, float* out) const {
  const float *a = texels.at(u.first, v.first), *b = texels.at(u.second, v.first), *c = texels.at(u.first, v.second),
              *d = texels.at(u.second, v.second);
  for (int i = 0; i < texels.channels; i++) {
    const float low = a[i] + u.share * (b[i] - a[i]), high = c[i] + u.share * (d[i] - c[i]);
    out[i] = low + v.share * (high - low);
  }
}

void require_table_shape(const LookupFunction& f, int width, int height, TableSampling sampling, TableLayout layout) {
  if (sampling == TableSampling::kEdge && layout != TableLayout::kPlain)
    throw Error(ErrorKind::kUsage, std::string("sampling: the layout ") + name(layout) + " needs centre, got edge");
  if (layout != TableLayout::kPlain && !std::ranges::all_of(f.domain, [](Range r) { return r == Range{-1, 1}; }))
    throw Error(ErrorKind::kUsage, std::string("domain: the layout ") + name(layout) + " needs " +
                                       domain_text(std::vector<Range>(f.domain.size(), {-1, 1})) + ", got " +
                                       domain_text(f.domain));
  require_side("width", width, sampling, layout);
  if (f.arguments() > 1) require_side("height", height, sampling, layout);
  else if (height != 1)
    throw Error(ErrorKind::kUsage, std::string("size: ") + name(f.kind) + " has one argument; expected N, got " +
                                       std::to_string(width) + "x" + std::to_string(height));
  if (std::size_t(width) * height > kMostTableTexels)
    throw Error(ErrorKind::kUsage,
                "size: expected at most 2^26 texels, got " + std::to_string(width) + "x" + std::to_string(height));
}

LookupTable bake_table(const LookupFunction& f, int width, int height, TableSampling sampling, TableLayout layout) {
  require_valid(f);
  require_table_shape(f, width, height, sampling, layout);
  LookupTable table{f.domain, sampling, layout, Image(width, height, f.channels())};
  parallel_for(height, [&](std::size_t j) {
    const double y = f.arguments() > 1 ? argument(int(j), height, f.domain[1], sampling) : 0;
    const int row = f.arguments() > 1 ? place_of(int(j), height, layout, true) : 0;
    for (int i = 0; i < width; i++) {
      double values[4];
      f.evaluate(argument(i, width, f.domain[0], sampling), y, values);
      std::copy_n(values, f.channels(), table.texels.at(place_of(i, width, layout, false), row));
    }
  });
  return table;
}

}  // namespace burnish
