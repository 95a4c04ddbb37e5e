#include "burnish/mesh/atlas/chart_packing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>

namespace burnish {
namespace {

constexpr int kMostCells = 512;  // along the square's side; a cell is as many texels as that takes
constexpr int kTurns = 8;
constexpr int kSearchSteps = 9;
constexpr double kUsual = 0.8;  // of the scale that would fill the square

Vec2d turned(Vec2d p, int eighths) {
  const double h = std::sqrt(0.5);
  if (eighths % 2) p = {(p.x - p.y) * h, (p.x + p.y) * h};
  for (int i = 0; i < eighths / 2; i++) p = {-p.y, p.x};
  return p;
}

struct Box {
  Vec2d least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2d most{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Vec2d p) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  Vec2d size() const { return most - least; }
};

// A row of cells, 64 to a word.
using Row = std::array<std::uint64_t, kMostCells / 64>;

// Each cell becomes the one `by` further right, or further left where that is negative.
Row moved(const Row& row, int by) {
  Row out{};
  const int words = std::abs(by) / 64, bits = std::abs(by) % 64, n = int(row.size());
  for (int i = 0; i + words < n; i++) {
    const int near = i + words, far = near + 1;
    if (by >= 0) out[i] = row[near] >> bits | (bits && far < n ? row[far] << (64 - bits) : 0);
    else out[n - 1 - i] = row[n - 1 - near] << bits | (bits && far < n ? row[n - 1 - far] >> (64 - bits) : 0);
  }
  return out;
}

void add(Row& row, const Row& other) {
  for (std::size_t i = 0; i < row.size(); i++) row[i] |= other[i];
}

// The cells from which, `length` cells to the right, any is set.
Row set_within(Row row, int length) {
  for (int done = 1; done < length;) {
    const int step = std::min(done, length - done);
    add(row, moved(row, step));
    done += step;
  }
  return row;
}

Row filled(int from, int to) {  // both included
  Row row{};
  for (int x = from; x <= to; x++) row[x / 64] |= std::uint64_t(1) << x % 64;
  return row;
}

// The cells that a turned and scaled chart touches, with `margin` cells all round.
struct Stamp {
  struct Run {
    int y, x, length;
  };
  Vec2d origin;  // of the cells, in the turned and scaled chart
  int width = 0;
  std::vector<Row> rows;
  std::vector<Run> runs;  // of the rows; the longest first, as they are likeliest in the way
};

// None where it is larger than `side` cells.
std::optional<Stamp> stamp_of(const FlatChart& chart, int eighths, double scale, int margin, int side) {
  Stamp stamp;
  std::vector<Vec2d> points;
  Box turned_box, box;
  for (const Vec2d& p : chart.points) points.push_back(turned(p, eighths) * scale), turned_box.add(points.back());
  const double inset = margin + 1e-6;  // rounding must not lead out of the margin
  stamp.origin = turned_box.least - Vec2d{inset, inset};
  for (Vec2d& p : points) p = p - stamp.origin, box.add(p);
  if (std::max(box.most.x, box.most.y) + 1 + margin > side) return {};
  stamp.width = int(box.most.x) + 1 + margin;
  stamp.rows.resize(int(box.most.y) + 1 + margin);
  for (const Corners& corners : chart.corners) {
    Box part;
    for (const std::uint32_t i : corners) part.add(points[i]);
    for (int y = int(part.least.y); y <= int(part.most.y); y++) {
      double least = part.most.x, most = part.least.x;  // of the triangle between y and y + 1
      for (int c = 0; c < 3; c++) {
        Vec2d a = points[corners[c]], b = points[corners[(c + 1) % 3]];
        if (a.y > b.y) std::swap(a, b);
        if (b.y < y || a.y > y + 1) continue;
        const auto x_at = [&](double at) { return a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y); };
        for (const double x : {a.y < y ? x_at(y) : a.x, b.y > y + 1 ? x_at(y + 1) : b.x})
          least = std::min(least, x), most = std::max(most, x);
      }
      const Row row = filled(int(least) - margin, int(most) + margin);
      for (int r = y - margin; r <= y + margin; r++) add(stamp.rows[r], row);
    }
  }
  for (int y = 0; y < int(stamp.rows.size()); y++) {
    const auto is_set = [&](int x) { return x < stamp.width && stamp.rows[y][x / 64] >> x % 64 & 1; };
    for (int x = 0; x < stamp.width; x++) {
      const int from = x;
      while (is_set(x)) x++;
      if (x > from) stamp.runs.push_back({y, from, x - from});
    }
  }
  std::ranges::stable_sort(stamp.runs, std::greater{}, &Stamp::Run::length);
  return stamp;
}

struct Place {
  int x, y, eighths;
  Vec2d origin;
};
struct Packing {
  double scale = 0;  // cells for one unit of the charts
  std::vector<Place> places;
};

// The lowest place of a stamp, then the one furthest left, that rises to at most `ceiling`.
std::optional<std::pair<int, int>> lowest_place(const std::vector<Row>& taken, const Stamp& stamp, int ceiling) {
  const int side = int(taken.size());
  const Row beyond = filled(side - stamp.width + 1, kMostCells - 1);
  const auto all = [](const Row& row) {
    return std::ranges::all_of(row, [](std::uint64_t w) { return w == ~std::uint64_t(0); });
  };
  for (int y = 0; y + int(stamp.rows.size()) <= ceiling; y++) {
    Row blocked = beyond;
    for (const auto& [r, x, length] : stamp.runs) {
      if (taken[y + r] == Row{}) continue;
      add(blocked, moved(set_within(taken[y + r], length), x));
      if (all(blocked)) break;
    }
    for (int w = 0; w < int(blocked.size()); w++)
      if (~blocked[w]) return std::pair(w * 64 + std::countr_one(blocked[w]), y);
  }
  return {};
}

std::optional<Packing> packed(const std::vector<FlatChart>& charts, const std::vector<std::size_t>& order, int side,
                              int gutter, double scale) {
  Packing packing{scale, std::vector<Place>(charts.size())};
  std::vector<Row> taken(side);
  for (const std::size_t i : order) {
    Place& place = packing.places[i];
    int ceiling = side;
    bool found = false;
    for (int eighths = 0; eighths < kTurns; eighths++) {
      const auto wide = stamp_of(charts[i], eighths, scale, gutter, side);
      const auto at = wide ? lowest_place(taken, *wide, ceiling) : std::nullopt;
      if (!at) continue;
      found = true;
      ceiling = at->second + int(wide->rows.size()) - 1;
      place = {at->first, at->second, eighths, wide->origin};
    }
    if (!found) return {};
    const Stamp stamp = *stamp_of(charts[i], place.eighths, scale, 0, side);
    for (std::size_t r = 0; r < stamp.rows.size(); r++)
      add(taken[place.y + gutter + r], moved(stamp.rows[r], -(place.x + gutter)));
  }
  return packing;
}

// Turns a chart so that its bounding box is the smallest: some border lies along it.
void straighten(FlatChart& chart) {
  double least = std::numeric_limits<double>::infinity();
  Vec2d best{1, 0};
  const auto along = [](Vec2d d, Vec2d p) { return Vec2d{p.x * d.x + p.y * d.y, cross(d, p)}; };
  for (const auto& [a, b] : chart.borders) {
    const Vec2d edge = chart.points[b] - chart.points[a];
    const double size = std::sqrt(edge.x * edge.x + edge.y * edge.y);
    if (!(size > 0)) continue;
    Box box;
    for (const Vec2d& p : chart.points) box.add(along(edge * (1 / size), p));
    if (const double area = box.size().x * box.size().y; area < least) least = area, best = edge * (1 / size);
  }
  for (Vec2d& p : chart.points) p = along(best, p);
}

double area(const FlatChart& chart) {
  double sum = 0;
  for (const auto& [a, b, c] : chart.corners)
    sum += cross(chart.points[b] - chart.points[a], chart.points[c] - chart.points[a]) / 2;
  return sum;
}

}  // namespace

bool pack(std::vector<FlatChart>& charts, int size, const Progress& progress) {
  double total = 0;
  std::vector<double> largest(charts.size());
  for (std::size_t i = 0; i < charts.size(); i++) {
    straighten(charts[i]);
    total += area(charts[i]);
    Box box;
    for (const Vec2d& p : charts[i].points) box.add(p);
    largest[i] = std::max(box.size().x, box.size().y);
  }
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return largest[i]; });

  const int texels = (size + kMostCells - 1) / kMostCells;  // of a cell
  const int side = size / texels, gutter = (kGutter + texels - 1) / texels;
  // Scales as parts of that at which the charts' area would be the square's. The first asks only whether there is room
  // for so many charts at all.
  const double whole = total > 0 ? side / std::sqrt(total) : 1;
  double low = 1e-6, high = 1;
  std::optional<Packing> best = packed(charts, order, side, gutter, low * whole);
  if (!best) return false;
  for (int i = 0; i < kSearchSteps; i++) {
    const double part = i == 0 ? kUsual : (low + high) / 2;
    if (auto packing = packed(charts, order, side, gutter, part * whole)) best = std::move(packing), low = part;
    else high = part;
    report_progress(progress, double(i + 1) / kSearchSteps);
  }
  for (std::size_t i = 0; i < charts.size(); i++) {
    const auto& [x, y, eighths, origin] = best->places[i];
    for (Vec2d& p : charts[i].points)
      p = (turned(p, eighths) * best->scale - origin + Vec2d{double(x), double(y)}) * (double(texels) / size);
  }
  return true;
}

}  // namespace burnish
