// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/pose_partners.h"

#include "sdk/base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kNone = PosePartners::kNone;
constexpr double kSlack = 0.1;   // of an edge: how far from where it is expected a partner may be
constexpr double kFloor = 0.02;  // of an edge: errors below do not count
constexpr uint32_t kMostCorners = 32;

using Triple = std::array<uint32_t, 3>;

struct Surface {
  Surface(const Eigen::MatrixXd& pose, const CornerTable& t) : table(t) {
    points.reserve(static_cast<size_t>(pose.rows()));
    for (Index v = 0; v < pose.rows(); ++v)
      points.emplace_back(pose.row(v).transpose());
  }

  uint32_t vertices() const { return table.vertex_count(); }

  const Vector3d& operator[](uint32_t v) const { return points[v]; }

  template <class Visit>
  void neighbours(uint32_t v, const Visit& visit) const {
    const uint32_t corners = std::min(table.valence(v), kMostCorners);
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t c = table.corner(v, i);
      visit(table.vertex(CornerTable::next(c)));
      visit(table.vertex(CornerTable::previous(c)));
    }
  }

  Triple triangle(uint32_t t) const {
    return {table.vertex(3 * t), table.vertex(3 * t + 1), table.vertex(3 * t + 2)};
  }

  uint32_t triangles() const { return table.corner_count() / 3; }

  const CornerTable& table;
  std::vector<Vector3d> points;
};

/// Forward, sideways and the normal at an edge, seen from the vertex o.
bool frame(const Surface& s, uint32_t a, uint32_t b, uint32_t o, Vector3d* f) {
  const Vector3d side = s[b] - s[a];
  const Vector3d normal = side.cross(s[o] - s[a]);
  const double size = normal.norm(), wide = side.norm();
  if (!(size > 1e-9 * wide * wide))
    return false;
  f[2] = normal / size;
  f[1] = side / wide;
  f[0] = f[1].cross(f[2]);
  return true;
}

/// How far v is from the parallelogram of a, b, o, in the directions of their images x, y, z.
bool turned(const Surface& s, const Triple& gate, uint32_t v, const Triple& images, bool mirrored,
            Vector3d* off) {
  const auto [a, b, o] = gate;
  Vector3d here[3], there[3];
  if (!frame(s, a, b, o, here) || !frame(s, images[0], images[1], images[2], there))
    return false;
  if (mirrored)
    there[2] = -there[2];
  const Vector3d e = s[v] - (s[a] + s[b] - s[o]);
  *off = e.dot(here[0]) * there[0] + e.dot(here[1]) * there[1] + e.dot(here[2]) * there[2];
  return true;
}

/// A correspondence that grows over a surface.
class Growth {
 public:
  explicit Growth(const Surface& surface)
      : surface_(surface), map_(surface.vertices(), kNone), inverse_(surface.vertices(), kNone) {}

  struct Rules {
    bool mirrored = false;
    bool symmetric = false;                        ///< partners are partners of one another
    const std::vector<uint32_t>* taken = nullptr;  ///< sources that have partners already
    const std::vector<uint32_t>* part = nullptr;   ///< not symmetric: of each vertex,
    uint32_t of = 0;                               ///< and that of images
  };

  /// Grows from three vertices at a triangle and their images. False if it does not get far.
  bool grow(const Triple& from, const Triple& to, const Rules& rules) {
    clear();
    rules_ = rules;
    for (size_t i = 0; i < 3; ++i) {
      if (map_[from[i]] == to[i])
        continue;
      if (!free(from[i], to[i]))
        return false;
      put(from[i], to[i]);
    }
    for (size_t i = 0; i < 3; ++i)
      push_gates(from[i]);
    uint32_t tries = 0;
    while (!queue_.empty()) {
      const Step step = queue_.top();
      queue_.pop();
      if (map_[step.v] != kNone)
        continue;
      if (!free(step.v, step.image)) {
        push(step.corner);
        continue;
      }
      ++tries;
      gain_ += step.gain;
      put(step.v, step.image);
      push_gates(step.v);
      if (rules_.symmetric && step.image != step.v)
        push_gates(step.image);
      if (tries >= kTrial && gain_ < kLeastGain * tries)
        return false;
    }
    return gain_ > kWorth + kLeastGain * tries;
  }

  /// Bits saved, about.
  double gain() const { return gain_; }

  /// Sources, with their images.
  const std::vector<uint32_t>& sources() const { return sources_; }

  uint32_t image(uint32_t v) const { return map_[v]; }

 private:
  static constexpr uint32_t kTrial = 24;
  static constexpr double kLeastGain = 3, kWorth = 40;

  struct Step {
    double error;
    double gain;
    uint32_t corner, v, image;

    bool operator<(const Step& b) const {
      return error != b.error ? error > b.error : corner > b.corner;
    }
  };

  void clear() {
    for (const uint32_t v : sources_) {
      inverse_[map_[v]] = kNone;
      map_[v] = kNone;
    }
    sources_.clear();
    queue_ = {};
    gain_ = 0;
  }

  bool free(uint32_t v, uint32_t u) const {
    if (map_[v] != kNone || (*rules_.taken)[v] != kNone)
      return false;
    if (rules_.symmetric)
      return map_[u] == kNone && (*rules_.taken)[u] == kNone && (u != v || rules_.mirrored);
    return inverse_[u] == kNone && (*rules_.part)[u] == rules_.of && u != v;
  }

  void put(uint32_t v, uint32_t u) {
    map_[v] = u;
    inverse_[u] = v;
    sources_.push_back(v);
    if (rules_.symmetric && u != v) {
      map_[u] = v;
      inverse_[v] = u;
      sources_.push_back(u);
    }
  }

  /// Gates that have become known with v, whose vertices beyond are not.
  void push_gates(uint32_t v) {
    const CornerTable& table = surface_.table;
    const uint32_t corners = std::min(table.valence(v), kMostCorners);
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t c = table.corner(v, i), n = CornerTable::next(c), p = CornerTable::previous(c);
      if (map_[table.vertex(n)] == kNone || map_[table.vertex(p)] == kNone)
        continue;
      push(c);
      push(n);
      push(p);
    }
  }

  /// Looks for the image of the vertex beyond the edge that faces a corner.
  void push(uint32_t corner) {
    const CornerTable& table = surface_.table;
    const uint32_t beyond = table.opposite(corner);
    if (beyond == CornerTable::kNone)
      return;
    const uint32_t v = table.vertex(beyond);
    if (map_[v] != kNone || (*rules_.taken)[v] != kNone)
      return;
    const uint32_t a = table.vertex(CornerTable::next(corner)),
                   b = table.vertex(CornerTable::previous(corner)), o = table.vertex(corner);
    const uint32_t x = map_[a], y = map_[b], z = map_[o];
    Vector3d off;
    if (!turned(surface_, {a, b, o}, v, {x, y, z}, rules_.mirrored, &off))
      return;
    const Vector3d expected = surface_[x] + surface_[y] - surface_[z] + off;
    uint32_t best = kNone;
    double least = 0;
    for (const uint32_t w : {x, y}) {
      surface_.neighbours(w, [&](uint32_t u) {
        const double d = (surface_[u] - expected).squaredNorm();
        if ((best == kNone || d < least) && u != best && free(v, u)) {
          best = u;
          least = d;
        }
      });
    }
    if (best == kNone)
      return;
    const double edge =
        0.5 * ((surface_[v] - surface_[a]).norm() + (surface_[v] - surface_[b]).norm());
    const double error = std::sqrt(least), alone = off.norm();
    if (!(error <= kSlack * edge))
      return;
    const double floor = kFloor * edge + 1e-300;
    queue_.push({error / edge, 3 * std::log2((alone + floor) / (error + floor)), corner, v, best});
  }

  const Surface& surface_;
  Rules rules_;
  std::vector<uint32_t> map_, inverse_, sources_;
  std::priority_queue<Step> queue_;
  double gain_ = 0;
};

/// Triangles by the lengths of their sides.
class TriangleIndex {
 public:
  /// `triangles` of the surface.
  TriangleIndex(const Surface& surface, std::vector<uint32_t> triangles)
      : surface_(surface), triangles_(std::move(triangles)) {
    std::ranges::sort(triangles_, [&](uint32_t a, uint32_t b) {
      return std::pair(round_length(a), a) < std::pair(round_length(b), b);
    });
  }

  double round_length(uint32_t t) const {
    const auto s = sides(surface_.triangle(t));
    return s[0] + s[1] + s[2];
  }

  std::array<double, 3> sides(const Triple& t) const {
    return {(surface_[t[1]] - surface_[t[0]]).norm(), (surface_[t[2]] - surface_[t[1]]).norm(),
            (surface_[t[0]] - surface_[t[2]]).norm()};
  }

  /// Calls visit(image) for triangles whose sides are those of `t`, about, going round as it does or,
  /// mirrored, the other way, until it returns true or so many have been looked at.
  template <class Visit>
  bool alike(const Triple& t, bool mirrored, uint32_t most, const Visit& visit) const {
    const auto wanted = sides(t);
    const double round = wanted[0] + wanted[1] + wanted[2], slack = kAlike * round;
    auto low = std::ranges::lower_bound(triangles_, round, {},
                                        [&](uint32_t x) { return round_length(x); });
    auto high = low;
    // Outwards from the nearest.
    for (uint32_t looked = 0; looked < most; ++looked) {
      const double below = low != triangles_.begin() ? round - round_length(*(low - 1)) : HUGE_VAL;
      const double above = high != triangles_.end() ? round_length(*high) - round : HUGE_VAL;
      if (std::min(below, above) > slack)
        return false;
      const uint32_t x = below <= above ? *--low : *high++;
      Triple image = surface_.triangle(x);
      if (mirrored)
        std::swap(image[0], image[1]);
      for (int turn = 0; turn < 3; ++turn) {
        const auto found = sides(image);
        if (image != t && std::abs(found[0] - wanted[0]) <= slack &&
            std::abs(found[1] - wanted[1]) <= slack && std::abs(found[2] - wanted[2]) <= slack &&
            visit(image))
          return true;
        std::ranges::rotate(image, image.begin() + 1);
      }
    }
    return false;
  }

  const std::vector<uint32_t>& triangles() const { return triangles_; }

 private:
  static constexpr double kAlike = 0.02;  // of the sides' sum

  const Surface& surface_;
  std::vector<uint32_t> triangles_;
};

/// The nearest point of a set, by a grid.
class NearestPoint {
 public:
  NearestPoint(const std::vector<Vector3d>& points, double cell) : points_(points), cell_(cell) {
    for (uint32_t v = 0; v < points.size(); ++v)
      cells_[key(points[v])].push_back(v);
  }

  /// Within one cell, or kNone.
  uint32_t find(const Vector3d& x) const {
    uint32_t best = kNone;
    double least = cell_ * cell_;
    for (int i = 0; i < 27; ++i) {
      const auto found =
          cells_.find(key(x + cell_ * Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (found == cells_.end())
        continue;
      for (size_t k = 0; k < std::min<size_t>(found->second.size(), 64); ++k) {
        const uint32_t v = found->second[k];
        const double d = (points_[v] - x).squaredNorm();
        if (d < least || (d == least && v < best)) {
          best = v;
          least = d;
        }
      }
    }
    return best;
  }

 private:
  uint64_t key(const Vector3d& x) const {
    uint64_t k = 0;
    for (int d = 0; d < 3; ++d)
      k = k << 21 |
          (static_cast<uint64_t>(static_cast<int64_t>(std::floor(x[d] / cell_))) & 0x1fffff);
    return k;
  }

  const std::vector<Vector3d>& points_;
  double cell_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
};

class PartnerSearch {
 public:
  PartnerSearch(const Eigen::MatrixXd& pose, const PoseSurface& surface)
      : surface_(pose, surface.table), order_(surface.order), growth_(surface_) {
    found_.partner.assign(surface_.vertices(), kNone);
    found_.flips.assign(surface_.vertices(), 0);
    taken_.assign(surface_.vertices(), kNone);
  }

  PosePartners run() {
    if (surface_.triangles() > 0) {
      find_repeated_parts();
      find_symmetry();
    }
    if (!any_)
      return {};
    drop_unlike();
    return std::move(found_);
  }

 private:
  static constexpr size_t kMostEarlier = 6, kMostAnchors = 3;
  static constexpr uint32_t kMostAlike = 12;

  /// Takes over what has grown.
  void accept(bool mirrored) {
    any_ = true;
    const uint8_t flips = flips_of(mirrored);
    for (const uint32_t v : growth_.sources()) {
      taken_[v] = found_.partner[v] = growth_.image(v);
      found_.flips[v] = flips;
    }
  }

  /// The axes that change sign from images to sources.
  uint8_t flips_of(bool mirrored) const {
    Vector3d here = Vector3d::Zero(), there = here, agree = here;
    const double each = 1.0 / static_cast<double>(growth_.sources().size());
    for (const uint32_t v : growth_.sources()) {
      here += each * surface_[v];
      there += each * surface_[growth_.image(v)];
    }
    for (const uint32_t v : growth_.sources())
      agree += (surface_[v] - here).cwiseProduct(surface_[growth_.image(v)] - there);
    uint32_t flips = 0, count = 0;
    for (int d = 0; d < 3; ++d) {
      if (agree[d] < 0) {
        flips |= 1U << d;
        ++count;
      }
    }
    if ((count & 1) != mirrored) {
      Index least;
      agree.cwiseAbs().minCoeff(&least);
      flips ^= 1U << least;
    }
    return static_cast<uint8_t>(flips);
  }

  struct Part {
    uint32_t root;
    uint32_t vertices = 0;
    std::vector<uint32_t> triangles;
  };

  void find_repeated_parts() {
    const uint32_t n = surface_.vertices();
    DisjointSets sets(n);
    for (uint32_t t = 0; t < surface_.triangles(); ++t) {
      const Triple v = surface_.triangle(t);
      sets.join(v[0], v[1]);
      sets.join(v[1], v[2]);
    }
    std::vector<uint32_t> part_of(n, kNone), number(n, kNone);
    std::vector<Part> parts;
    for (const uint32_t v : order_) {
      const uint32_t root = sets.find(v);
      if (number[root] == kNone) {
        number[root] = static_cast<uint32_t>(parts.size());
        parts.push_back({root, 0, {}});
      }
      part_of[v] = number[root];
      ++parts[part_of[v]].vertices;
    }
    if (parts.size() < 2)
      return;
    for (uint32_t t = 0; t < surface_.triangles(); ++t)
      parts[part_of[surface_.triangle(t)[0]]].triangles.push_back(t);
    // Originals so far, by number of triangles.
    std::multimap<size_t, std::pair<uint32_t, TriangleIndex>> originals;
    for (uint32_t p = 0; p < parts.size(); ++p) {
      Part& part = parts[p];
      if (part.triangles.size() < 2 || part.vertices < 5)
        continue;
      TriangleIndex index(surface_, std::move(part.triangles));
      const size_t size = index.triangles().size();
      if (!is_copy(index, originals, size, part.vertices, part_of))
        originals.emplace(size, std::pair(p, std::move(index)));
    }
  }

  using Originals = std::multimap<size_t, std::pair<uint32_t, TriangleIndex>>;

  bool is_copy(const TriangleIndex& part, const Originals& originals, size_t size,
               uint32_t vertices, const std::vector<uint32_t>& part_of) {
    // Those of the same size first.
    std::vector<Originals::const_iterator> near;
    for (auto i = originals.lower_bound(size - size / 10);
         i != originals.end() && i->first <= size + size / 10; ++i)
      near.push_back(i);
    const auto apart = [&](const auto& i) {
      return i->first > size ? i->first - size : size - i->first;
    };
    std::ranges::stable_sort(near, {}, apart);
    for (size_t k = 0; k < std::min(near.size(), kMostEarlier); ++k) {
      const auto& [number, index] = near[k]->second;
      for (const bool mirrored : {false, true}) {
        const Growth::Rules rules{mirrored, false, &taken_, &part_of, number};
        const auto grows = [&](const Triple& from) {
          return index.alike(from, mirrored, kMostAlike, [&](const Triple& to) {
            return growth_.grow(from, to, rules) &&
                   10 * growth_.sources().size() >= size_t{9} * vertices;
          });
        };
        // The largest triangles are the rarest.
        const auto& triangles = part.triangles();
        for (size_t a = 0; a < std::min(triangles.size(), kMostAnchors); ++a) {
          if (grows(surface_.triangle(triangles[triangles.size() - 1 - a]))) {
            accept(mirrored);
            return true;
          }
        }
      }
    }
    return false;
  }

  /// A surface against its mirror image: from what lies opposite a middle plane, then from triangles
  /// that are each other's mirror image.
  void find_symmetry() {
    std::vector<uint32_t> all(surface_.triangles());
    std::iota(all.begin(), all.end(), 0U);
    const TriangleIndex index(surface_, std::move(all));
    const std::vector<uint32_t>& triangles = index.triangles();
    Vector3d low = surface_[0], high = low;
    for (const Vector3d& x : surface_.points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const double middle = index.round_length(triangles[triangles.size() / 2]) / 3;
    if (!(middle > 0))
      return;
    const NearestPoint nearest(surface_.points, 0.5 * middle);
    const size_t stride = std::max<size_t>(1, triangles.size() / kSamples);
    const Growth::Rules rules{true, true, &taken_, nullptr, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double twice = low[axis] + high[axis];
      for (size_t t = stride / 2; t < triangles.size(); t += stride) {
        const Triple from = surface_.triangle(static_cast<uint32_t>(t));
        if (taken(from))
          continue;
        Triple to;
        for (size_t i = 0; i < 3; ++i) {
          Vector3d x = surface_[from[i]];
          x[axis] = twice - x[axis];
          to[i] = nearest.find(x);
        }
        if (std::ranges::count(to, kNone) > 0 || to[0] == to[1] || to[1] == to[2] ||
            to[0] == to[2] || taken(to))
          continue;
        if (growth_.grow(from, to, rules))
          accept(true);
      }
    }
    for (size_t t = stride / 2; t < triangles.size(); t += stride) {
      const Triple from = surface_.triangle(static_cast<uint32_t>(t));
      if (!taken(from) && index.alike(from, true, kMostAlike, [&](const Triple& to) {
            return growth_.grow(from, to, rules);
          }))
        accept(true);
    }
  }

  /// Drops partners around which they tell no more than parallelograms alone.
  void drop_unlike() {
    const CornerTable& table = surface_.table;
    const uint32_t n = surface_.vertices();
    std::vector<double> gain(n, 0), weight(n, 0);
    for (uint32_t c = 0; c < table.corner_count(); ++c) {
      const uint32_t across = table.opposite(c);
      if (across == CornerTable::kNone)
        continue;
      const uint32_t v = table.vertex(across);
      const Triple gate{table.vertex(CornerTable::next(c)), table.vertex(CornerTable::previous(c)),
                        table.vertex(c)};
      Triple images;
      for (size_t i = 0; i < 3; ++i)
        images[i] = found_.partner[gate[i]];
      const uint32_t u = found_.partner[v];
      if (u == kNone || std::ranges::count(images, kNone) > 0)
        continue;
      const bool mirrored = std::popcount(found_.flips[v]) & 1;
      Vector3d off;
      if (!turned(surface_, gate, v, images, mirrored, &off))
        continue;
      const double edge = 0.5 * ((surface_[u] - surface_[images[0]]).norm() +
                                 (surface_[u] - surface_[images[1]]).norm());
      const double floor = kFloor * edge + 1e-300, alone = off.norm(),
                   error = (surface_[images[0]] + surface_[images[1]] - surface_[images[2]] + off -
                            surface_[u])
                               .norm();
      gain[v] += std::log2((alone + floor) / (error + floor));
      weight[v] += 1;
    }
    for (int pass = 0; pass < kPasses; ++pass) {
      std::vector<double> g = gain, w = weight;
      for (uint32_t v = 0; v < n; ++v) {
        surface_.neighbours(v, [&](uint32_t u) {
          g[v] += 0.5 * gain[u];
          w[v] += 0.5 * weight[u];
        });
      }
      gain = std::move(g);
      weight = std::move(w);
    }
    for (uint32_t v = 0; v < n; ++v) {
      if (gain[v] < kWorthNaming * weight[v])
        found_.partner[v] = kNone;
    }
  }

  static constexpr int kPasses = 1;
  static constexpr double kWorthNaming = 0.7;

  bool taken(const Triple& t) const {
    return std::ranges::any_of(t, [&](uint32_t v) { return taken_[v] != kNone; });
  }

  static constexpr size_t kSamples = 200;

  Surface surface_;
  const Vector<uint32_t>& order_;
  Growth growth_;
  PosePartners found_;
  std::vector<uint32_t> taken_;  ///< by source, its image
  bool any_ = false;
};

}  // namespace

PosePartners find_partners(const Eigen::MatrixXd& pose, const PoseSurface& surface) {
  return PartnerSearch(pose, surface).run();
}

}  // namespace anicodec
