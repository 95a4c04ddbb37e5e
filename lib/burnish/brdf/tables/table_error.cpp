#include "burnish/brdf/tables/table_error.h"

#include <algorithm>
#include <atomic>
#include <bit>
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
constexpr std::size_t kManyTexels = std::size_t(1) << 20;

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

// What is found in one row of places.
struct RowErrors {
  double inside = 0, wrap = 0;  // the largest, where the ends do not mix and where they do
  double squares = 0;           // their sum
};

// The places where errors are asked.
class Places {
 public:
  Places(const LookupFunction& f, const LookupTable& table) : f_(f), table_(table), two_(f.arguments() > 1) {
    const std::size_t steps = !two_ ? 64 : table.texels.texels() <= kManyTexels ? 8 : 4;
    const Axis x = axis(f.domain[0], table.texels.width, steps, table);
    if (two_) y_ = axis(f.domain[1], table.texels.height, steps, table);
    for (std::size_t i = 0; i <= x.steps; i++)
      columns_.push_back({x.at(i), table.columns_at(float(x.at(i))), x.wraps(i)});
  }
  std::size_t rows() const { return y_.steps + 1; }
  double count() const { return double(rows()) * double(columns_.size()) * f_.channels(); }

  RowErrors row(std::size_t j) const {
    const double y = two_ ? y_.at(j) : 0;
    const bool wraps = two_ && y_.wraps(j);
    const TexelPair rows = table_.rows_at(float(y));
    const int channels = f_.channels();
    RowErrors errors;
    for (const Column& column : columns_) {
      double exact[4], most = 0;
      float found[4];
      f_.evaluate(column.x, y, exact);
      table_.look_up(column.texels, rows, found);
      for (int c = 0; c < channels; c++) {
        const double error = std::abs(found[c] - exact[c]);
        most = std::max(most, error);
        errors.squares += error * error;
      }
      double& kind = wraps || column.wraps ? errors.wrap : errors.inside;
      kind = std::max(kind, most);
    }
    return errors;
  }

 private:
  struct Column {
    double x;
    TexelPair texels;
    bool wraps;
  };
  const LookupFunction& f_;
  const LookupTable& table_;
  const bool two_;
  Axis y_;
  std::vector<Column> columns_;
};

// Whether no error is larger, but for where the ends mix. What it asks first is spread over the domain, so that a
// table that fails does so soon.
bool errs_at_most(double limit, const LookupFunction& f, const LookupTable& table) {
  const Places places(f, table);
  std::atomic<bool> exceeded = false;
  const std::size_t rows = places.rows(), strides = std::min<std::size_t>(rows, 61);
  for (std::size_t first = 0; first < strides && !exceeded; first++)
    parallel_for((rows - first + strides - 1) / strides, [&](std::size_t k) {
      if (!exceeded && places.row(first + k * strides).inside > limit) exceeded = true;
    });
  return !exceeded;
}

}  // namespace

TableErrors table_errors(const LookupFunction& f, const LookupTable& table, const Progress& progress) {
  const Places places(f, table);
  std::vector<RowErrors> rows(places.rows());
  const std::size_t band = rows.size() / 64 + 1;
  for (std::size_t first = 0; first < rows.size(); first += band) {
    const std::size_t count = std::min(band, rows.size() - first);
    parallel_for(count, [&](std::size_t j) { rows[first + j] = places.row(first + j); });
    report_progress(progress, double(first + count) / double(rows.size()));
  }
  TableErrors all;
  double squares = 0;
  for (const RowErrors& row : rows) {
    all.max_abs = std::max({all.max_abs, row.inside, row.wrap}), all.wrap = std::max(all.wrap, row.wrap);
    squares += row.squares;
  }
  all.rms = std::sqrt(squares / places.count());
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
                           double max_error, const Progress& progress) {
  if (!(max_error > 0))
    throw Error(ErrorKind::kUsage, "max-error: expected a number above 0, got " + number_text(max_error));
  const int least = sampling == TableSampling::kEdge || layout == TableLayout::kOffsetHalf ? 1 : 0;  // of the exponent
  const int most = std::bit_width(kMostTried) - 1;
  for (int texels = least; texels <= most; texels++) {
    report_progress(progress, double(texels - least) / (most - least + 1));
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
