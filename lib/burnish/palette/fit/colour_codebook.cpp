#include "burnish/palette/fit/colour_codebook.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

#include "burnish/core/parallel.h"

namespace burnish {
namespace {

struct Sum {
  std::array<double, 4> weighted{}, squares{};  // Σ w·p and Σ w·p² of each component
  double weight = 0;

  void add(const WeightedColour& p) {
    for (int a = 0; a < 4; a++) {
      weighted[a] += double(p.weight) * p.colour[a];
      squares[a] += double(p.weight) * p.colour[a] * p.colour[a];
    }
    weight += p.weight;
  }
  void add(const Sum& s) {
    for (int a = 0; a < 4; a++) weighted[a] += s.weighted[a], squares[a] += s.squares[a];
    weight += s.weight;
  }
  // Σ w·|p − mean|², along one axis and in all.
  double variance(int axis) const {
    return weight > 0 ? std::max(0.0, squares[axis] - weighted[axis] * weighted[axis] / weight) : 0;
  }
  double error() const { return variance(0) + variance(1) + variance(2) + variance(3); }
  Colour mean() const {
    Colour c;
    for (int a = 0; a < 4; a++) c[a] = float(weighted[a] / weight);
    return c;
  }
};

struct Box {
  int begin, end;
  Sum sum;
  double error;
  friend bool operator<(const Box& a, const Box& b) {
    return a.error != b.error ? a.error < b.error : a.begin > b.begin;
  }
};

Box box_of(const std::vector<WeightedColour>& points, int begin, int end) {
  Box b{begin, end, {}, 0};
  for (int i = begin; i < end; i++) b.sum.add(points[i]);
  if (end - begin > 1) b.error = b.sum.error();
  return b;
}

// Where to cut a box whose colours differ: reorders its points so that [begin, cut) and [cut, end) are the
// parts, between two levels of the axis of largest variance.
int cut(std::vector<WeightedColour>& points, const Box& box) {
  int axis = 0;
  for (int a = 1; a < 4; a++)
    if (box.sum.variance(a) > box.sum.variance(axis)) axis = a;
  const auto level = [&](const WeightedColour& p) { return int(p.colour[axis]); };
  std::array<Sum, 256> levels;
  for (int i = box.begin; i < box.end; i++) levels[level(points[i])].add(points[i]);
  std::array<Sum, 256> high;  // of the levels above
  for (int l = 254; l >= 0; l--) high[l] = high[l + 1], high[l].add(levels[l + 1]);
  double least = std::numeric_limits<double>::infinity();
  int last_low = 0;
  Sum low;
  for (int l = 0; l < 255; l++) {
    low.add(levels[l]);
    if (levels[l].weight == 0 || high[l].weight == 0) continue;
    if (const double error = low.error() + high[l].error(); error < least) least = error, last_low = l;
  }
  const auto middle = std::stable_partition(points.begin() + box.begin, points.begin() + box.end,
                                            [&](const WeightedColour& p) { return level(p) <= last_low; });
  return int(middle - points.begin());
}

std::vector<Colour> split(std::vector<WeightedColour>& points, int n) {
  std::priority_queue<Box> boxes;
  boxes.push(box_of(points, 0, int(points.size())));
  while (int(boxes.size()) < n && boxes.top().error > 0) {
    const Box b = boxes.top();
    boxes.pop();
    const int middle = cut(points, b);
    boxes.push(box_of(points, b.begin, middle));
    boxes.push(box_of(points, middle, b.end));
  }
  std::vector<Colour> centres;
  for (; !boxes.empty(); boxes.pop()) centres.push_back(boxes.top().sum.mean());
  return centres;
}

float distance2(const Colour& p, const Colour& q) {
  float d = 0;
  for (int a = 0; a < 4; a++) d += (p[a] - q[a]) * (p[a] - q[a]);
  return d;
}

// A k-d tree over colours.
class ColourTree {
 public:
  explicit ColourTree(const std::vector<Colour>& centres) : centres_(centres), order_(centres.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    build(0, int(order_.size()));
  }
  // The centre nearest to p; the smaller index in a tie.
  int nearest(const Colour& p) const {
    int found = -1;
    float best = 4 * 256 * 256;
    search(0, p, best, found);
    return found;
  }

 private:
  static constexpr int kLeaf = 8;
  struct Node {
    int begin, end, right;  // right: node of the upper half, the lower one follows; 0 in a leaf
    Colour low, high;
  };

  int build(int begin, int end) {
    const int at = int(nodes_.size());
    Node node{begin, end, 0, centres_[order_[begin]], centres_[order_[begin]]};
    int axis = 0;
    for (int i = begin; i < end; i++)
      for (int a = 0; a < 4; a++) {
        node.low[a] = std::min(node.low[a], centres_[order_[i]][a]);
        node.high[a] = std::max(node.high[a], centres_[order_[i]][a]);
      }
    for (int a = 1; a < 4; a++)
      if (node.high[a] - node.low[a] > node.high[axis] - node.low[axis]) axis = a;
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return at;
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int i, int j) { return std::pair(centres_[i][axis], i) < std::pair(centres_[j][axis], j); });
    build(begin, middle);
    nodes_[at].right = build(middle, end);
    return at;
  }

  float distance2_to(int at, const Colour& p) const {
    const Node& n = nodes_[at];
    float d = 0;
    for (int a = 0; a < 4; a++) {
      const float outside = std::max({n.low[a] - p[a], p[a] - n.high[a], 0.f});
      d += outside * outside;
    }
    return d;
  }

  void search(int at, const Colour& p, float& best, int& found) const {
    const Node& node = nodes_[at];
    if (!node.right) {
      for (int i = node.begin; i < node.end; i++) {
        const int c = order_[i];
        const float d = distance2(centres_[c], p);
        if (d < best || (d == best && c < found)) best = d, found = c;
      }
      return;
    }
    const float lower = distance2_to(at + 1, p), upper = distance2_to(node.right, p);
    const int near = lower <= upper ? at + 1 : node.right, far = lower <= upper ? node.right : at + 1;
    if (std::min(lower, upper) <= best) search(near, p, best, found);
    if (std::max(lower, upper) <= best) search(far, p, best, found);
  }

  const std::vector<Colour>& centres_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

// Moves the centres to the means of their points and drops those that have none; the error about the means.
double lloyd(const std::vector<WeightedColour>& points, std::vector<Colour>& centres) {
  const ColourTree tree(centres);
  std::vector<int> of(points.size());
  parallel_for_chunks(points.size(), 4096, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; i++) of[i] = tree.nearest(points[i].colour);
  });
  std::vector<Sum> sums(centres.size());
  for (std::size_t i = 0; i < points.size(); i++) sums[of[i]].add(points[i]);
  centres.clear();
  double error = 0;
  for (const Sum& s : sums)
    if (s.weight > 0) centres.push_back(s.mean()), error += s.error();
  return error;
}

}  // namespace

std::vector<Colour> fit_colour_codebook(const std::vector<WeightedColour>& points, int n) {
  std::vector<WeightedColour> p = points;
  std::vector<Colour> centres = split(p, n);
  constexpr int kMostIterations = 60;
  constexpr double kLeastGain = 1e-4;
  double last = lloyd(p, centres);
  for (int i = 1; i < kMostIterations; i++) {
    const double error = lloyd(p, centres);
    if (!(error < last * (1 - kLeastGain))) break;
    last = error;
  }
  return centres;
}

}  // namespace burnish
