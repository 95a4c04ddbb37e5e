// A k-d tree over the centres of a codebook in the making.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "burnish/core/parallel.h"
#include "burnish/core/vec3.h"

namespace burnish {

class CentreTree {
 public:
  // Over all centres, which must outlive the tree or be given anew to refit().
  explicit CentreTree(std::span<const Vec3f> centres) : CentreTree(centres, all_of(centres.size())) {}
  // Over some, by index.
  CentreTree(std::span<const Vec3f> centres, std::vector<int> members) : centres_(centres), order_(std::move(members)) {
    if (order_.empty()) return;
    std::size_t leaves = 1;
    while (order_.size() > leaves * kLeaf) leaves *= 2;
    nodes_.resize(2 * leaves - 1);
    build(0, 0, int(order_.size()));
  }

  // After the centres have moved a little: the tree keeps its shape, its boxes are measured anew.
  void refit(std::span<const Vec3f> centres) {
    centres_ = centres;
    for (std::size_t at = nodes_.size(); at-- > 0;) {
      if (is_leaf(at)) {
        measure(nodes_[at]);
      } else {
        const Node &l = nodes_[2 * at + 1], &r = nodes_[2 * at + 2];
        nodes_[at].low = least(l.low, r.low);
        nodes_[at].high = most(l.high, r.high);
      }
    }
  }

  // body(index, squared distance) for every member nearer to v than √reach2. Where it returns false the search ends,
  // and so does this, with false.
  template <typename Body>
  bool for_each_within(Vec3f v, float reach2, const Body& body) const {
    return order_.empty() || visit(0, v, reach2, body);
  }

  // The member nearest to v among those nearer than √best2, other than `except`; −1 if there is none. Ties go to the
  // smaller index.
  int nearest(Vec3f v, float& best2, int except = -1) const {
    int found = -1;
    if (!order_.empty()) search(0, v, best2, found, except);
    return found;
  }

 private:
  static std::vector<int> all_of(std::size_t n) {
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  static constexpr int kLeaf = 8;
  struct Node {
    Vec3f low, high;
    int begin, end;
  };

  static Vec3f least(Vec3f a, Vec3f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
  static Vec3f most(Vec3f a, Vec3f b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
  void measure(Node& node) const {
    node.low = {2, 2, 2}, node.high = {-2, -2, -2};
    for (int i = node.begin; i < node.end; i++)
      node.low = least(node.low, centres_[order_[i]]), node.high = most(node.high, centres_[order_[i]]);
  }

  void build(std::size_t at, int begin, int end) {
    Node& node = nodes_[at];
    node.begin = begin, node.end = end;
    measure(node);
    if (is_leaf(at)) return;
    const Vec3f side = node.high - node.low;
    const auto key = [&](int i) {
      const Vec3f c = centres_[i];
      return side.x >= side.y && side.x >= side.z ? c.x : side.y >= side.z ? c.y : c.z;
    };
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
      const float ka = key(a), kb = key(b);
      return ka != kb ? ka < kb : a < b;
    });
    constexpr int kTask = 2048;
    if (end - begin > kTask)
      parallel_invoke([&] { build(2 * at + 1, begin, middle); }, [&] { build(2 * at + 2, middle, end); });
    else build(2 * at + 1, begin, middle), build(2 * at + 2, middle, end);
  }

  bool is_leaf(std::size_t at) const { return 2 * at + 2 >= nodes_.size(); }
  float distance2(std::size_t at, Vec3f v) const {
    const Node& n = nodes_[at];
    const float x = std::max({n.low.x - v.x, v.x - n.high.x, 0.f}), y = std::max({n.low.y - v.y, v.y - n.high.y, 0.f}),
                z = std::max({n.low.z - v.z, v.z - n.high.z, 0.f});
    return x * x + y * y + z * z;
  }

  template <typename Body>
  bool visit(std::size_t at, Vec3f v, float reach2, const Body& body) const {
    if (!(distance2(at, v) < reach2)) return true;
    if (!is_leaf(at)) return visit(2 * at + 1, v, reach2, body) && visit(2 * at + 2, v, reach2, body);
    for (int i = nodes_[at].begin; i < nodes_[at].end; i++) {
      const Vec3f d = centres_[order_[i]] - v;
      if (const float d2 = dot(d, d); d2 < reach2 && !body(order_[i], d2)) return false;
    }
    return true;
  }

  void search(std::size_t at, Vec3f v, float& best2, int& found, int except) const {
    if (!is_leaf(at)) {
      const float left = distance2(2 * at + 1, v), right = distance2(2 * at + 2, v);
      const std::size_t near = left <= right ? 2 * at + 1 : 2 * at + 2, far = left <= right ? 2 * at + 2 : 2 * at + 1;
      if (std::min(left, right) <= best2) search(near, v, best2, found, except);
      if (std::max(left, right) <= best2) search(far, v, best2, found, except);
      return;
    }
    for (int i = nodes_[at].begin; i < nodes_[at].end; i++) {
      const int c = order_[i];
      const Vec3f d = centres_[c] - v;
      const float d2 = dot(d, d);
      if (c != except && (d2 < best2 || (d2 == best2 && c < found))) best2 = d2, found = c;
    }
  }

  std::span<const Vec3f> centres_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace burnish
