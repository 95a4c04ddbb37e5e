#include "burnish/mesh/polygon.h"

#include <numeric>

namespace burnish {
namespace {

// Newell's normal: the mean of the outline's turn.
Vec3d mean_normal(std::span<const Vec3d> p) {
  Vec3d sum;
  for (std::size_t i = 0; i < p.size(); i++) sum += cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
  return sum;
}

class EarClipping {
 public:
  explicit EarClipping(std::span<const Vec3d> outline) : p_(outline), up_(mean_normal(outline)), left_(outline.size()) {
    std::iota(left_.begin(), left_.end(), 0u);
  }

  std::vector<Corners> run() {
    std::vector<Corners> out;
    while (left_.size() > 3) {
      // The ear behind the first corner first, so that a convex outline becomes a fan.
      std::size_t ear = 1;
      for (std::size_t i = 0; i < left_.size(); i++)
        if (is_ear((i + 1) % left_.size())) {
          ear = (i + 1) % left_.size();
          break;
        }
      out.push_back({at(ear + left_.size() - 1), at(ear), at(ear + 1)});
      left_.erase(left_.begin() + std::ptrdiff_t(ear));
    }
    out.push_back({left_[0], left_[1], left_[2]});
    return out;
  }

 private:
  std::uint32_t at(std::size_t i) const { return left_[i % left_.size()]; }

  // Twice the area of a, b, c as seen from above.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return dot(cross(p_[b] - p_[a], p_[c] - p_[a]), up_);
  }

  bool is_ear(std::size_t i) const {
    const std::uint32_t a = at(i + left_.size() - 1), b = at(i), c = at(i + 1);
    if (!(turn(a, b, c) > 0)) return false;
    for (std::uint32_t d : left_)
      if (d != a && d != b && d != c && turn(a, b, d) >= 0 && turn(b, c, d) >= 0 && turn(c, a, d) >= 0) return false;
    return true;
  }

  std::span<const Vec3d> p_;
  Vec3d up_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

std::vector<Corners> triangulate(std::span<const Vec3d> outline) {
  if (outline.size() == 3) return {{0, 1, 2}};
  return EarClipping(outline).run();
}

}  // namespace burnish
