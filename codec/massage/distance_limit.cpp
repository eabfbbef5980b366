// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/distance_limit.h"

#include "codec/surface/mesh_quality.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Vector3d;

constexpr int kMostPasses = 12;  // a part of 1 / 4096 of the move is left, or none

/// Calls with the barycentric weights of a triangle's samples: its corners, mid-points and centre.
template <class Visit>
void for_samples(const Visit& visit) {
  for (int k = 0; k < 3; ++k) {
    Vector3d corner = Vector3d::Zero(), middle = Vector3d::Constant(0.5);
    corner[k] = 1;
    middle[k] = 0;
    visit(corner);
    visit(middle);
  }
  visit(Vector3d(Vector3d::Constant(1.0 / 3)));
}

Vector3d point(const Positions& positions, const SurfaceTopology::Triangle& t, const Vector3d& w) {
  return w[0] * row(positions, t[0]) + w[1] * row(positions, t[1]) + w[2] * row(positions, t[2]);
}

}  // namespace

uint32_t limit_distance(const Surface& original, double limit, Positions* v) {
  const SurfaceTopology& topology = original.topology();
  const double square = limit * limit;
  std::vector<bool> drawn(topology.vertex_count, false);
  std::vector<uint32_t> same(topology.triangles.size());
  std::iota(same.begin(), same.end(), 0U);
  std::vector<uint32_t> turned = turned_in_place(*v, original);
  const auto at_rest = [&](const SurfaceTopology::Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t i) {
      const auto r = static_cast<Eigen::Index>(i);
      return v->row(r) == original.positions().row(r);
    });
  };
  for (int pass = 0;; ++pass) {
    std::vector<bool> back(topology.vertex_count, false);
    bool any = false;
    // Triangles at rest stay where they are, even if rounding alone leads beyond the limit.
    auto mark = [&](uint32_t triangle) {
      const SurfaceTopology::Triangle& corners = topology.triangles[triangle];
      if (at_rest(corners))
        return;
      for (uint32_t i : corners) {
        back[i] = drawn[i] = true;
        any = true;
      }
    };
    auto mark_far = [&] {
      const Surface after(topology, *v);
      std::optional<Surface> indexed;  // only where walking does not settle it
      for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
        for_samples([&](const Vector3d& w) {
          const Vector3d moved = point(*v, topology.triangles[t], w);
          if (original.walk(moved, t).square_distance > square &&
              original.closest(moved).square_distance > square)
            mark(t);
          const Vector3d old = point(original.positions(), topology.triangles[t], w);
          if (!(after.walk(old, t).square_distance > square))
            return;
          if (!indexed) {
            indexed.emplace(topology, *v);
            indexed->build_index();
          }
          const SurfacePoint closest = indexed->closest(old);
          if (closest.square_distance > square) {
            mark(t);
            mark(closest.triangle);
          }
        });
      }
    };
    for (uint32_t t : turned)
      mark(t);
    if (limit < std::numeric_limits<double>::infinity())
      mark_far();
    if (!any)
      break;
    std::vector<uint32_t> moved;
    for (uint32_t i = 0; i < topology.vertex_count; ++i) {
      if (!back[i])
        continue;
      moved.push_back(i);
      const Vector3d start = row(original.positions(), i);
      const Vector3d half = float_position(start + 0.5 * (row(*v, i) - start));
      v->row(static_cast<Eigen::Index>(i)) = (pass < kMostPasses ? half : start).transpose();
    }
    turned = turned_around(topology, *v, moved, original, same);
  }
  return static_cast<uint32_t>(std::count(drawn.begin(), drawn.end(), true));
}

}  // namespace anicodec
