// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_PARTNER_SURFACE_H_
#define ANICODEC_CODEC_SEGMENT_PARTNER_SURFACE_H_

#include "sdk/pose/corner_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Three vertices: the corners of a triangle, or an edge and the vertex that faces it.
using Triple = std::array<uint32_t, 3>;

/// A pose on its triangles, as the search for partners looks at it.
struct PartnerSurface {
  PartnerSurface(const Eigen::MatrixXd& pose, const CornerTable& t) : table(t) {
    points.reserve(static_cast<size_t>(pose.rows()));
    for (Eigen::Index v = 0; v < pose.rows(); ++v)
      points.emplace_back(pose.row(v).transpose());
  }

  static constexpr uint32_t kMostTriangles = 32;  ///< of a vertex, that are looked at

  uint32_t vertices() const { return table.vertex_count(); }

  const Eigen::Vector3d& operator[](uint32_t v) const { return points[v]; }

  /// Calls visit(neighbour) for the neighbours of a vertex, inner ones twice, of 32 triangles at most.
  template <class Visit>
  void neighbours(uint32_t v, const Visit& visit) const {
    const uint32_t corners = std::min(table.valence(v), kMostTriangles);
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t c = table.corner(v, i);
      visit(table.vertex(next_corner(c)));
      visit(table.vertex(previous_corner(c)));
    }
  }

  Triple triangle(uint32_t t) const {
    return {table.vertex(3 * t), table.vertex(3 * t + 1), table.vertex(3 * t + 2)};
  }

  uint32_t triangles() const { return table.corner_count() / 3; }

  const CornerTable& table;
  std::vector<Eigen::Vector3d> points;
};

/// How far v is from the parallelogram of the gate (an edge and the vertex that faces it), in the
/// directions of the gate's images. False if the gate or its image is degenerate.
bool turned_offset(const PartnerSurface& surface, const Triple& gate, uint32_t v,
                   const Triple& images, bool mirrored, Eigen::Vector3d* offset);

/// Bits that a partner saves at a vertex, about: its offset from the parallelogram alone against that
/// from where the partner says, both in units of the edges' length.
double partner_gain(double alone, double with_partner, double edge);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_PARTNER_SURFACE_H_
