// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/pose_partners.h"

#include "codec/segment/alike_triangles.h"
#include "codec/segment/partner_growth.h"
#include "codec/segment/partner_surface.h"
#include "codec/surface/closest_point.h"
#include "sdk/base/disjoint_sets.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kNone = PosePartners::kNone;

/// The nearest vertex within a distance.
class NearestVertex {
 public:
  NearestVertex(const std::vector<Vector3d>& points, double distance)
      : query_({}, coordinates(points)), distance_(distance) {}

  /// kNone if there is none.
  uint32_t find(const Vector3d& x) const {
    const ClosestPoint found = query_(x);
    return found.square_distance < distance_ * distance_ ? found.element : kNone;
  }

 private:
  static std::vector<float> coordinates(const std::vector<Vector3d>& points) {
    std::vector<float> all;
    all.reserve(3 * points.size());
    for (const Vector3d& x : points)
      all.insert(all.end(), {float(x[0]), float(x[1]), float(x[2])});
    return all;
  }

  ClosestPointQuery query_;
  double distance_;
};

class PartnerSearch {
 public:
  PartnerSearch(const Eigen::MatrixXd& pose, const CornerTable& table)
      : surface_(pose, table), growth_(surface_) {
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
    for (uint32_t v = 0; v < n; ++v) {
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
    std::multimap<size_t, std::pair<uint32_t, AlikeTriangles>> originals;
    for (uint32_t p = 0; p < parts.size(); ++p) {
      Part& part = parts[p];
      if (part.triangles.size() < 2 || part.vertices < 5)
        continue;
      AlikeTriangles index(surface_, std::move(part.triangles));
      const size_t size = index.triangles().size();
      if (!is_copy(index, originals, size, part.vertices, part_of))
        originals.emplace(size, std::pair(p, std::move(index)));
    }
  }

  using Originals = std::multimap<size_t, std::pair<uint32_t, AlikeTriangles>>;

  bool is_copy(const AlikeTriangles& part, const Originals& originals, size_t size,
               uint32_t vertices, const std::vector<uint32_t>& part_of) {
    // Pieces of the same size come first.
    std::vector<Originals::const_iterator> near;
    for (auto i = originals.lower_bound(size - size / 10);
         i != originals.end() && i->first <= size + size / 10; ++i)
      near.push_back(i);
    const auto apart = [&](const auto& i) {
      return i->first > size ? i->first - size : size - i->first;
    };
    std::ranges::stable_sort(near, {}, apart);
    for (size_t k = 0; k < std::min(near.size(), kMostEarlier); ++k) {
      const uint32_t number = near[k]->second.first;
      const auto& index = near[k]->second.second;
      for (const bool mirrored : {false, true}) {
        const PartnerGrowth::Rules rules{mirrored, false, &taken_, &part_of, number};
        const auto grows = [&](const Triple& from) {
          return index.visit_alike(from, mirrored, kMostAlike, [&](const Triple& to) {
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
    const AlikeTriangles index(surface_, std::move(all));
    const std::vector<uint32_t>& triangles = index.triangles();
    Vector3d low = surface_[0], high = low;
    for (const Vector3d& x : surface_.points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const double middle = index.round_length(triangles[triangles.size() / 2]) / 3;
    if (!(middle > 0))
      return;
    const NearestVertex nearest(surface_.points, 0.5 * middle);
    const size_t stride = std::max<size_t>(1, triangles.size() / kSamples);
    const PartnerGrowth::Rules rules{true, true, &taken_, nullptr, 0};
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
      if (!taken(from) && index.visit_alike(from, true, kMostAlike, [&](const Triple& to) {
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
      const Triple gate{table.vertex(next_corner(c)), table.vertex(previous_corner(c)),
                        table.vertex(c)};
      Triple images;
      for (size_t i = 0; i < 3; ++i)
        images[i] = found_.partner[gate[i]];
      const uint32_t u = found_.partner[v];
      if (u == kNone || std::ranges::count(images, kNone) > 0)
        continue;
      const bool mirrored = std::popcount(found_.flips[v]) & 1;
      Vector3d off;
      if (!turned_offset(surface_, gate, v, images, mirrored, &off))
        continue;
      const double edge = 0.5 * ((surface_[u] - surface_[images[0]]).norm() +
                                 (surface_[u] - surface_[images[1]]).norm());
      const Vector3d expected =
          surface_[images[0]] + surface_[images[1]] - surface_[images[2]] + off;
      gain[v] += partner_gain(off.norm(), (expected - surface_[u]).norm(), edge);
      weight[v] += 1;
    }
    for (uint32_t v = 0; v < n; ++v) {
      double around = gain[v], weights = weight[v];
      surface_.neighbours(v, [&](uint32_t u) {
        around += 0.5 * gain[u];
        weights += 0.5 * weight[u];
      });
      if (around < kWorthNaming * weights)
        found_.partner[v] = kNone;
    }
  }

  static constexpr double kWorthNaming = 0.7;

  bool taken(const Triple& t) const {
    return std::ranges::any_of(t, [&](uint32_t v) { return taken_[v] != kNone; });
  }

  static constexpr size_t kSamples = 200;

  PartnerSurface surface_;
  PartnerGrowth growth_;
  PosePartners found_;
  std::vector<uint32_t> taken_;  ///< by source, its image
  bool any_ = false;
};

}  // namespace

PosePartners find_partners(const Eigen::MatrixXd& pose, const CornerTable& table) {
  return PartnerSearch(pose, table).run();
}

}  // namespace anicodec
