// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/bench/joined_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec::bench {
namespace {

using Quad = std::array<uint32_t, 4>;
using Eigen::Vector3d;

constexpr double kSkewest = 0.9;  // radians off a right angle, at the worst corner

/// How far the worst corner is from a right angle, and how far the quad is bent over its diagonal.
double skew(const MeshSequence& sequence, const Quad& quad) {
  std::array<Vector3d, 4> x;
  for (size_t i = 0; i < 4; ++i) {
    const float* p = sequence.frame(0).data() + size_t{3} * quad[i];
    x[i] = Vector3d(p[0], p[1], p[2]);
  }
  double worst = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Vector3d a = x[(i + 1) % 4] - x[i], b = x[(i + 3) % 4] - x[i];
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    worst = std::max(worst, std::abs(angle - std::numbers::pi / 2));
  }
  const Vector3d m = (x[1] - x[0]).cross(x[2] - x[0]), n = (x[2] - x[0]).cross(x[3] - x[0]);
  return worst + std::atan2(m.cross(n).norm(), m.dot(n));
}

/// Which triangles are joined.
class Pairing {
 public:
  explicit Pairing(size_t count) : neighbours_(count), quads_(count), partner_(count, kNobody) {}

  /// The best pair that is left: joined if both are free.
  void offer(size_t p, size_t q, const Quad& quad) {
    neighbours_[p].emplace_back(q, quad);
    neighbours_[q].emplace_back(p, quad);
    if (partner_[p] == kNobody && partner_[q] == kNobody)
      join(p, q, quad);
  }

  /// Joins triangles that are left over by changing the pairs on a short way between two of them.
  void augment() {
    for (size_t p = 0; p < partner_.size(); ++p) {
      for (int steps = 1; partner_[p] == kNobody && steps <= kMostSteps; ++steps) {
        std::vector<bool> passed(partner_.size(), false);
        reach(p, steps, passed);
      }
    }
  }

  size_t partner(size_t p) const { return partner_[p]; }

  const std::vector<std::optional<Quad>>& quads() const { return quads_; }

 private:
  static constexpr size_t kNobody = SIZE_MAX;
  static constexpr int kMostSteps = 12;

  void join(size_t p, size_t q, const Quad& quad) {
    partner_[p] = q;
    partner_[q] = p;
    quads_[p] = quads_[q] = quad;
  }

  /// Finds somebody for p, whose partner has gone.
  bool reach(size_t p, int steps, std::vector<bool>& passed) {
    passed[p] = true;
    for (const auto& [q, quad] : neighbours_[p]) {
      if (partner_[q] == kNobody && !passed[q]) {
        join(p, q, quad);
        return true;
      }
    }
    for (const auto& [q, quad] : neighbours_[p]) {
      const size_t next = partner_[q];
      if (steps < 2 || passed[q] || next == kNobody || passed[next])
        continue;
      passed[q] = true;
      if (reach(next, steps - 1, passed)) {
        join(p, q, quad);
        return true;
      }
    }
    return false;
  }

  std::vector<std::vector<std::pair<size_t, Quad>>> neighbours_;  ///< the best first
  std::vector<std::optional<Quad>> quads_;
  std::vector<size_t> partner_;
};

}  // namespace

Polygons join_triangles(const MeshSequence& sequence) {
  const Polygons& polygons = sequence.polygons;
  // Triangles at each directed edge, with the corner that faces it.
  std::map<std::pair<uint32_t, uint32_t>, std::pair<size_t, uint32_t>> at_edge;
  for (size_t p = 0; p < polygons.size(); ++p) {
    const auto t = polygons[p];
    for (size_t i = 0; t.size() == 3 && i < 3; ++i)
      at_edge[{t[i], t[(i + 1) % 3]}] = {p, t[(i + 2) % 3]};
  }
  std::vector<std::tuple<double, size_t, size_t, Quad>> pairs;
  for (const auto& [edge, left] : at_edge) {
    const auto other = at_edge.find({edge.second, edge.first});
    if (other == at_edge.end() || edge.first > edge.second)
      continue;
    const Quad quad{left.second, edge.first, other->second.second, edge.second};
    const double cost = skew(sequence, quad);
    if (cost < kSkewest)
      pairs.emplace_back(cost, left.first, other->second.first, quad);
  }
  std::ranges::sort(pairs);
  Pairing pairing(polygons.size());
  for (const auto& [cost, p, q, quad] : pairs)
    pairing.offer(p, q, quad);
  pairing.augment();
  const std::vector<std::optional<Quad>>& joined = pairing.quads();
  Polygons result;
  for (size_t p = 0; p < polygons.size(); ++p) {
    if (!joined[p])
      result.add(polygons[p]);
    else if (pairing.partner(p) > p)
      result.add(*joined[p]);
  }
  return result;
}

}  // namespace anicodec::bench
