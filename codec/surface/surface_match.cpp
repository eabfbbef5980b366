// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_match.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

constexpr double kFarthest = 0.25;      // of the diagonal of the component's box
constexpr double kSmallOpening = 0.05;  // of the diagonal: what looks like a flaw, not like a shape
constexpr double kNear = 0.01;          // of the whole's: always good enough, for tiny components

void check_components(const SurfaceTopology& topology, const Positions& positions,
                      const Surface& other, const char* name, const char* other_name) {
  struct Component {
    Eigen::AlignedBox3d box;
    double sum = 0, count = 0;
    uint32_t first = SurfaceTopology::kNone;
  };

  const std::vector<uint32_t> number = components(topology);
  std::vector<Component> list;
  Eigen::AlignedBox3d all;
  for (uint32_t i = 0; i < topology.vertex_count; ++i) {
    if (topology.star[i].empty())
      continue;
    if (number[i] >= list.size())
      list.resize(size_t{number[i]} + 1);
    Component& c = list[number[i]];
    c.first = std::min(c.first, i);
    c.box.extend(row(positions, i));
    all.extend(row(positions, i));
    c.sum += std::sqrt(other.closest(row(positions, i)).square_distance);
    c.count += 1;
  }
  for (const Component& c : list) {
    if (c.count > 0 && c.sum / c.count > std::max(kFarthest * c.box.diagonal().norm(),
                                                  kNear * all.diagonal().norm()))
      throw Error(ErrorKind::kInput, std::string("the component of ") + name + " at vertex " +
                                         std::to_string(c.first) + " has no counterpart in " +
                                         other_name);
  }
}

uint32_t root_of(std::vector<uint32_t>& parent, uint32_t v) {
  while (parent[v] != v)
    v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

double largest_opening(const SurfaceTopology& topology, const Positions& positions) {
  std::vector<uint32_t> parent(topology.vertex_count);
  std::iota(parent.begin(), parent.end(), 0U);
  std::vector<bool> at_boundary(topology.vertex_count, false);
  Eigen::AlignedBox3d all;
  for (size_t t = 0; t < topology.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      all.extend(row(positions, topology.triangles[t][k]));
      if (topology.across[t][k] != SurfaceTopology::kNone)
        continue;
      const uint32_t a = topology.triangles[t][(k + 1) % 3], b = topology.triangles[t][(k + 2) % 3];
      at_boundary[a] = at_boundary[b] = true;
      parent[root_of(parent, a)] = root_of(parent, b);
    }
  }
  std::vector<Eigen::AlignedBox3d> boxes(topology.vertex_count);
  for (uint32_t v = 0; v < topology.vertex_count; ++v) {
    if (at_boundary[v])
      boxes[root_of(parent, v)].extend(row(positions, v));
  }
  double largest = 0;
  for (const Eigen::AlignedBox3d& box : boxes) {
    if (!box.isEmpty())
      largest = std::max(largest, box.diagonal().norm());
  }
  return largest > 0 ? largest / all.diagonal().norm() : 0;
}

double check_openings(const SurfaceTopology& mesh, const Positions& positions,
                      const Surface& surface) {
  const bool is_open = mesh.has_boundary();
  if (is_open == surface.topology().has_boundary())
    return 0;
  const double opening = is_open ? largest_opening(mesh, positions)
                                 : largest_opening(surface.topology(), surface.positions());
  if (opening > kSmallOpening)
    throw Error(ErrorKind::kInput,
                (is_open ? "the mesh is open, but the surface is closed: an opening has "
                         : "the mesh is closed, but the surface is open: an opening has ") +
                    std::to_string(std::lround(100 * opening)) + " % of the diagonal");
  return opening;
}

void check_surfaces_match(const SurfaceTopology& mesh, const Positions& positions,
                          const Surface& surface) {
  check_openings(mesh, positions, surface);
  check_components(mesh, positions, surface, "the mesh", "the surface");
  Surface moving(mesh, positions);
  moving.build_index();
  check_components(surface.topology(), surface.positions(), moving, "the surface", "the mesh");
}

}  // namespace anicodec
