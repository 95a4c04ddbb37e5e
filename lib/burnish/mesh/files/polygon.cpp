#include "burnish/mesh/files/polygon.h"

namespace burnish {
namespace {

// Newell's normal: the mean of the outline's turn.
Vec3d mean_normal(std::span<const Vec3d> p) {
  Vec3d sum;
  for (std::size_t i = 0; i < p.size(); i++) sum += cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
  return sum;
}

// In the time of corners times reflex corners: cutting an ear off changes only its neighbours, and a triangle that
// holds any corner holds a reflex one.
class EarClipping {
 public:
  explicit EarClipping(std::span<const Vec3d> outline)
      : p_(outline), up_(mean_normal(outline)), corners_(outline.size()) {
    const auto count = std::uint32_t(outline.size());
    for (std::uint32_t i = 0; i < count; i++) corners_[i] = {(i + count - 1) % count, (i + 1) % count, false, false};
    for (std::uint32_t i = 0; i < count; i++) update_reflex(i);
    for (std::uint32_t i = 0; i < count; i++) corners_[i].ear = is_ear(i);
  }

  std::vector<Corners> run() {
    std::vector<Corners> out;
    out.reserve(corners_.size() - 2);
    std::uint32_t first = 0;
    for (std::size_t left = corners_.size(); left > 3; left--) {
      // The ear behind the first corner first, so that a convex outline becomes a fan.
      std::uint32_t ear = corners_[first].next;
      while (!corners_[ear].ear && ear != first) ear = corners_[ear].next;
      if (!corners_[ear].ear) ear = corners_[first].next;
      if (ear == first) first = corners_[first].next;
      out.push_back(cut(ear));
    }
    out.push_back({first, corners_[first].next, corners_[first].previous});
    return out;
  }

 private:
  struct Corner {
    std::uint32_t previous, next;
    bool reflex, ear;
  };

  // Twice the area of a, b, c as seen from above.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return dot(cross(p_[b] - p_[a], p_[c] - p_[a]), up_);
  }

  void update_reflex(std::uint32_t i) {
    const bool was = corners_[i].reflex;
    corners_[i].reflex = !(turn(corners_[i].previous, i, corners_[i].next) > 0);
    if (corners_[i].reflex && !was) reflex_.push_back(i);
  }

  // Corners in the same place as one of the triangle's do not lie in it: outlines may come back to a corner.
  bool is_ear(std::uint32_t b) const {
    if (corners_[b].reflex) return false;
    const std::uint32_t a = corners_[b].previous, c = corners_[b].next;
    for (std::uint32_t d : reflex_)
      if (corners_[d].reflex && p_[d] != p_[a] && p_[d] != p_[b] && p_[d] != p_[c] && turn(a, b, d) >= 0 &&
          turn(b, c, d) >= 0 && turn(c, a, d) >= 0)
        return false;
    return true;
  }

  Corners cut(std::uint32_t ear) {
    const std::uint32_t previous = corners_[ear].previous, next = corners_[ear].next;
    corners_[previous].next = next, corners_[next].previous = previous;
    corners_[ear].reflex = false;
    for (std::uint32_t i : {previous, next}) update_reflex(i);
    for (std::uint32_t i : {previous, next}) corners_[i].ear = is_ear(i);
    return {previous, ear, next};
  }

  std::span<const Vec3d> p_;
  Vec3d up_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> reflex_;  // those that are or were
};

}  // namespace

std::vector<Corners> triangulate(std::span<const Vec3d> outline) {
  if (outline.size() == 3) return {{0, 1, 2}};
  return EarClipping(outline).run();
}

}  // namespace burnish
