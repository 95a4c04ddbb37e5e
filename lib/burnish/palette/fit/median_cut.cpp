#include "burnish/palette/fit/median_cut.h"

#include <algorithm>
#include <queue>

namespace burnish {
namespace {

struct Box {
  int begin, end;
  double texels;
  friend bool operator<(const Box& a, const Box& b) {
    return a.texels != b.texels ? a.texels < b.texels : a.begin > b.begin;
  }
};

// Puts the points into the order of the boxes.
std::vector<Box> cut(std::vector<WeightedColour>& p, int n) {
  const auto box = [&](int begin, int end) {
    double texels = 0;
    for (int i = begin; i < end; i++) texels += p[i].weight;
    return Box{begin, end, texels};
  };
  std::priority_queue<Box> boxes;
  std::vector<Box> done;
  boxes.push(box(0, int(p.size())));
  while (!boxes.empty() && int(boxes.size() + done.size()) < n) {
    const Box b = boxes.top();
    boxes.pop();
    if (b.end - b.begin < 2) {
      done.push_back(b);
      continue;
    }
    const auto along = [](int axis) {
      return [axis](const WeightedColour& s, const WeightedColour& t) { return s.colour[axis] < t.colour[axis]; };
    };
    int axis = 0;
    float longest = -1;
    for (int a = 0; a < 4; a++) {
      const auto [lo, hi] = std::minmax_element(p.begin() + b.begin, p.begin() + b.end, along(a));
      if (const float side = hi->colour[a] - lo->colour[a]; side > longest) longest = side, axis = a;
    }
    std::stable_sort(p.begin() + b.begin, p.begin() + b.end, along(axis));
    double below = 0;
    int middle = b.begin;
    while (middle < b.end - 1 && (middle == b.begin || below < b.texels / 2)) below += p[middle++].weight;
    boxes.push(box(b.begin, middle));
    boxes.push(box(middle, b.end));
  }
  for (; !boxes.empty(); boxes.pop()) done.push_back(boxes.top());
  return done;
}

std::array<double, 4> sum_of(const std::vector<WeightedColour>& points, const Box& box) {
  std::array<double, 4> sum{};
  for (int i = box.begin; i < box.end; i++)
    for (int a = 0; a < 4; a++) sum[a] += double(points[i].colour[a]) * double(points[i].weight);
  return sum;
}

}  // namespace

std::vector<Vec3f> fit_median_cut(const std::vector<WeightedNormal>& points, int n) {
  std::vector<WeightedColour> p;
  for (const WeightedNormal& v : points) p.push_back({{v.normal.x, v.normal.y, v.normal.z, 0}, v.weight});
  std::vector<Vec3f> entries;
  for (const Box& b : cut(p, n)) {
    const auto s = sum_of(p, b);
    const Vec3d sum{s[0], s[1], s[2]};
    const Colour& first = p[b.begin].colour;
    entries.push_back(length(sum) > 1e-9 ? Vec3f(normalized(sum)) : Vec3f{first[0], first[1], first[2]});
  }
  return entries;
}

std::vector<Colour> fit_median_cut(const std::vector<WeightedColour>& points, int n) {
  std::vector<WeightedColour> p = points;
  std::vector<Colour> entries;
  for (const Box& b : cut(p, n)) {
    const auto s = sum_of(p, b);
    entries.push_back({float(s[0] / b.texels), float(s[1] / b.texels), float(s[2] / b.texels), float(s[3] / b.texels)});
  }
  return entries;
}

}  // namespace burnish
