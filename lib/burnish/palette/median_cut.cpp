#include "burnish/palette/median_cut.h"

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

float component(Vec3f v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

std::vector<Vec3f> fit_median_cut(const std::vector<WeightedNormal>& points, int n) {
  std::vector<WeightedNormal> p = points;
  const auto box = [&](int begin, int end) {
    double texels = 0;
    for (int i = begin; i < end; i++) texels += p[i].weight;
    return Box{begin, end, texels};
  };
  std::priority_queue<Box> boxes;
  std::vector<Box> single;
  boxes.push(box(0, int(p.size())));
  while (!boxes.empty() && int(boxes.size() + single.size()) < n) {
    const Box b = boxes.top();
    boxes.pop();
    if (b.end - b.begin < 2) {
      single.push_back(b);
      continue;
    }
    int axis = 0;
    float longest = -1;
    for (int a = 0; a < 3; a++) {
      const auto [lo, hi] = std::minmax_element(
          p.begin() + b.begin, p.begin() + b.end,
          [&](const auto& s, const auto& t) { return component(s.normal, a) < component(t.normal, a); });
      if (const float side = component(hi->normal, a) - component(lo->normal, a); side > longest)
        longest = side, axis = a;
    }
    std::stable_sort(p.begin() + b.begin, p.begin() + b.end, [&](const auto& s, const auto& t) {
      return component(s.normal, axis) < component(t.normal, axis);
    });
    double below = 0;
    int cut = b.begin;
    while (cut < b.end - 1 && (cut == b.begin || below < b.texels / 2)) below += p[cut++].weight;
    boxes.push(box(b.begin, cut));
    boxes.push(box(cut, b.end));
  }
  for (; !boxes.empty(); boxes.pop()) single.push_back(boxes.top());
  std::vector<Vec3f> entries;
  for (const Box& b : single) {
    Vec3d sum;
    for (int i = b.begin; i < b.end; i++) sum += Vec3d(p[i].normal) * double(p[i].weight);
    entries.push_back(length(sum) > 1e-9 ? Vec3f(normalized(sum)) : p[b.begin].normal);
  }
  return entries;
}

}  // namespace burnish
