// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/diameter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace anicodec {
namespace {

using Point = std::array<double, 3>;

double square_distance(const Point& a, const Point& b) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// Branch and bound over pairs of boxes of a kd-tree.
class DiameterSearch {
 public:
  explicit DiameterSearch(std::span<const float> points) {
    for (size_t i = 0; i + 2 < points.size(); i += 3)
      points_.push_back({double{points[i]}, double{points[i + 1]}, double{points[i + 2]}});
    build(0, static_cast<uint32_t>(points_.size()));
  }

  double run() {
    // Walking to the farthest point a few times gives a bound that leaves little to search.
    Point from = points_[0];
    for (int i = 0; i < 4; ++i) {
      Point to = from;
      for (const Point& p : points_) {
        if (square_distance(from, p) > square_distance(from, to))
          to = p;
      }
      best_ = std::max(best_, square_distance(from, to));
      from = to;
    }
    visit(0, 0);
    return std::sqrt(best_);
  }

 private:
  static constexpr uint32_t kLeaf = 16;

  struct Node {
    Point low, high;
    uint32_t begin, end;
    uint32_t left = 0, right = 0;  ///< 0: a leaf

    double extent() const { return square_distance(low, high); }
  };

  uint32_t build(uint32_t begin, uint32_t end) {
    Node node{points_[begin], points_[begin], begin, end};
    for (uint32_t i = begin; i < end; ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        node.low[axis] = std::min(node.low[axis], points_[i][axis]);
        node.high[axis] = std::max(node.high[axis], points_[i][axis]);
      }
    }
    auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back(node);
    if (end - begin > kLeaf) {
      size_t axis = 0;
      for (size_t a = 1; a < 3; ++a) {
        if (node.high[a] - node.low[a] > node.high[axis] - node.low[axis])
          axis = a;
      }
      uint32_t middle = begin + (end - begin) / 2;
      std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                       [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
      uint32_t left = build(begin, middle);
      uint32_t right = build(middle, end);
      nodes_[index].left = left;
      nodes_[index].right = right;
    }
    return index;
  }

  /// No point of a is farther from one of b than this.
  double bound(const Node& a, const Node& b) const {
    double sum = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      double most = std::max(a.high[axis] - b.low[axis], b.high[axis] - a.low[axis]);
      sum += most * most;
    }
    return sum;
  }

  void visit(uint32_t first, uint32_t second) {
    const Node &a = nodes_[first], &b = nodes_[second];
    if (bound(a, b) <= best_)
      return;
    if (first == second && a.left != 0) {
      visit(a.left, a.right);
      visit(a.left, a.left);
      visit(a.right, a.right);
    } else if (a.left != 0 && (b.left == 0 || a.extent() >= b.extent())) {
      visit_both(a.left, a.right, second);
    } else if (b.left != 0) {
      visit_both(b.left, b.right, first);
    } else {
      for (uint32_t i = a.begin; i < a.end; ++i) {
        for (uint32_t j = b.begin; j < b.end; ++j)
          best_ = std::max(best_, square_distance(points_[i], points_[j]));
      }
    }
  }

  void visit_both(uint32_t left, uint32_t right, uint32_t other) {
    if (bound(nodes_[left], nodes_[other]) < bound(nodes_[right], nodes_[other]))
      std::swap(left, right);
    visit(left, other);
    visit(right, other);
  }

  std::vector<Point> points_;
  std::vector<Node> nodes_;
  double best_ = 0;
};

}  // namespace

double diameter(std::span<const float> points) {
  return points.size() < 6 ? 0 : DiameterSearch(points).run();
}

}  // namespace anicodec
