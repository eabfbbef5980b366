// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_match.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

constexpr double kFarthest = 0.25;  // of the diagonal of the component's box
constexpr double kNear = 0.01;      // of the whole's: always good enough, for tiny components

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

}  // namespace

void check_surfaces_match(const SurfaceTopology& mesh, const Positions& positions,
                          const Surface& surface) {
  if (mesh.has_boundary() != surface.topology().has_boundary())
    throw Error(ErrorKind::kInput, mesh.has_boundary()
                                       ? "the mesh is open, but the surface is closed"
                                       : "the mesh is closed, but the surface is open");
  check_components(mesh, positions, surface, "the mesh", "the surface");
  Surface moving(mesh, positions);
  moving.build_index();
  check_components(surface.topology(), surface.positions(), moving, "the surface", "the mesh");
}

}  // namespace anicodec
