#include "burnish/brdf/tables/table_error.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "burnish/core/error.h"
#include "burnish/core/number_text.h"
#include "burnish/core/parallel.h"
#include "burnish/core/samples.h"

namespace burnish {
namespace {

constexpr std::size_t kMostTried = std::size_t(1) << 22;

struct Axis {
  Range range;
  std::size_t steps = 0;  // from end to end; 0: no such argument
  double outermost = 0;   // share of the domain beyond the outermost texels

  double at(std::size_t i) const { return range.least + double(i) / double(steps) * (range.most - range.least); }
  bool wraps(std::size_t i) const {
    const double share = double(i) / double(steps);
    return share < outermost || share > 1 - outermost;
  }
};

Axis axis(Range range, int texels, std::size_t steps, const LookupTable& t) {
  const bool edge = t.sampling == TableSampling::kEdge;
  return {range, steps * std::size_t(edge ? texels - 1 : texels),
          t.layout == TableLayout::kOffsetHalf ? 0.5 / texels : 0};
}

// One row of the places where errors are asked, and what is found there.
struct Places {
  Axis x, y;
  bool two;

  Places(const LookupFunction& f, const LookupTable& table)
      : x(axis(f.domain[0], table.texels.width, f.arguments() > 1 ? 8 : 64, table)), two(f.arguments() > 1) {
    if (two) y = axis(f.domain[1], table.texels.height, 8, table);
  }
  std::size_t rows() const { return y.steps + 1; }

  TableErrors row(const LookupFunction& f, const LookupTable& table, std::size_t j) const {
    TableErrors row;  // rms: the sum of squares
    for (std::size_t i = 0; i <= x.steps; i++) {
      double exact[4];
      float found[4];
      const double b = two ? y.at(j) : 0;
      f.evaluate(x.at(i), b, exact);
      table.look_up(float(x.at(i)), float(b), found);
      for (int c = 0; c < f.channels(); c++) {
        const double error = std::abs(found[c] - exact[c]);
        row.max_abs = std::max(row.max_abs, error);
        row.rms += error * error;
        if (x.wraps(i) || (two && y.wraps(j))) row.wrap = std::max(row.wrap, error);
      }
    }
    return row;
  }
};

// Whether no error is larger. What it asks first is spread over the domain, so that a table that fails does so soon.
bool errs_at_most(double limit, const LookupFunction& f, const LookupTable& table) {
  const Places places(f, table);
  std::atomic<bool> exceeded = false;
  const std::size_t rows = places.rows(), strides = std::min<std::size_t>(rows, 61);
  for (std::size_t first = 0; first < strides && !exceeded; first++)
    parallel_for((rows - first + strides - 1) / strides, [&](std::size_t k) {
      if (!exceeded && places.row(f, table, first + k * strides).max_abs > limit) exceeded = true;
    });
  return !exceeded;
}

}  // namespace

TableErrors table_errors(const LookupFunction& f, const LookupTable& table) {
  const Places places(f, table);
  std::vector<TableErrors> rows(places.rows());
  parallel_for(rows.size(), [&](std::size_t j) { rows[j] = places.row(f, table, j); });
  TableErrors all;
  for (const TableErrors& row : rows) {
    all.max_abs = std::max(all.max_abs, row.max_abs), all.wrap = std::max(all.wrap, row.wrap);
    all.rms += row.rms;
  }
  all.rms = std::sqrt(all.rms / (double(rows.size()) * double(places.x.steps + 1) * f.channels()));
  return all;
}

double table_scale(const LookupTable& table) {
  const float most = *std::ranges::max_element(table.texels.data);
  return most > 0 ? most : 1;
}

void require_can_hold(SampleType sample, const LookupTable& table) {
  constexpr float kMostHalf = 65504;
  const float most = sample == SampleType::kHalf ? kMostHalf : std::numeric_limits<float>::max();
  const auto beyond = std::ranges::find_if(table.texels.data, [&](float v) { return !(std::abs(v) <= most); });
  if (beyond != table.texels.data.end())
    throw Error(ErrorKind::kUnsupported, "format: expected values within " + number_text(most) + ", which " +
                                             name(is_integer(sample) ? SampleType::kFloat : sample) + " holds, got " +
                                             number_text(*beyond));
}

LookupTable as_stored(const LookupTable& table, SampleType sample) {
  require_can_hold(sample, table);
  LookupTable stored = table;
  const float factor = is_integer(sample) ? float(table_scale(table)) : 1;
  for (float& v : stored.texels.data) v /= factor;
  round_to_samples(sample, stored.texels.data);
  for (float& v : stored.texels.data) v *= factor;
  return stored;
}

LookupTable smallest_table(const LookupFunction& f, TableSampling sampling, TableLayout layout, SampleType sample,
                           double max_error) {
  if (!(max_error > 0))
    throw Error(ErrorKind::kUsage, "max-error: expected a number above 0, got " + number_text(max_error));
  const int least = sampling == TableSampling::kEdge || layout == TableLayout::kOffsetHalf ? 1 : 0;  // of the exponent
  for (int texels = least; (std::size_t(1) << texels) <= kMostTried; texels++) {
    std::vector<std::pair<int, int>> sizes;  // exponents, the squarest first
    for (int w = least; w <= texels; w++) {
      const int h = texels - w;
      if ((std::size_t(1) << w) > kMostTableSide || (std::size_t(1) << h) > kMostTableSide) continue;
      if (f.arguments() > 1 ? h >= least : h == 0) sizes.push_back({w, h});
    }
    std::ranges::stable_sort(sizes, [](auto a, auto b) {
      const int ra = std::abs(a.first - a.second), rb = std::abs(b.first - b.second);
      return ra != rb ? ra < rb : a.first > b.first;
    });
    for (auto [w, h] : sizes) {
      LookupTable table = bake_table(f, 1 << w, 1 << h, sampling, layout);
      if (errs_at_most(max_error, f, as_stored(table, sample))) return table;
    }
  }
  throw Error(ErrorKind::kUsage, "max-error: no table of up to 2^22 texels errs by at most " + number_text(max_error) +
                                     "; try another domain" +
                                     (sample == SampleType::kFloat ? "" : ", or more exact samples (-d float)"));
}

}  // namespace burnish
