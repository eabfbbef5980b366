// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_H_

#include "codec/surface/closest_point.h"
#include "codec/surface/surface_topology.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// vertices x 3, a vertex a row.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

Positions positions_of(std::span<const float> frame);

inline Eigen::Vector3d row(const Positions& positions, uint32_t v) {
  return positions.row(static_cast<Eigen::Index>(v)).transpose();
}

/// The position that floats hold of p.
Eigen::Vector3d float_position(const Eigen::Vector3d& p);

/// Normal of a triangle with the length of twice its area.
Eigen::Vector3d area_normal(const Positions& positions, const SurfaceTopology::Triangle& triangle);

/// Unit normals of the vertices: those of the triangles around, weighted by their angles (Thuermer
/// and Wuethrich 1998). Zero where there is none.
Positions vertex_normals(const SurfaceTopology& topology, const Positions& positions);

/// The mean length of the edges; 0 without edges.
double mean_edge(const SurfaceTopology& topology, const Positions& positions);

/// The mean length of each vertex's edges; 0 for vertices without edges.
Eigen::VectorXd ring_sizes(const SurfaceTopology& topology, const Positions& positions);

/// A point of a surface.
struct SurfacePoint {
  uint32_t triangle = SurfaceTopology::kNone;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double square_distance = 0;  ///< from the query
};

/// A mesh as something to find closest points on. The topology must outlive it.
class Surface {
 public:
  Surface(const SurfaceTopology& topology, Positions positions);

  const SurfaceTopology& topology() const { return *topology_; }

  const Positions& positions() const { return positions_; }

  const Positions& normals() const { return normals_; }

  /// Builds the spatial index that closest() and closest_on_boundary() need.
  void build_index();

  /// The closest point of all, by the spatial index.
  SurfacePoint closest(const Eigen::Vector3d& q) const;

  /// The closest point of the boundary, by the spatial index, and the direction of its edge. There
  /// is a boundary.
  Eigen::Vector3d closest_on_boundary(const Eigen::Vector3d& q, Eigen::Vector3d* direction) const;

  /// The closest point on one triangle.
  SurfacePoint closest_on(uint32_t triangle, const Eigen::Vector3d& q) const;

  /// Walks downhill from a triangle: over the edge or around the vertex that the closest point lies
  /// on, to where the distance is strictly smaller. A local minimum, most times the closest point
  /// if it started near; never leaves the component.
  SurfacePoint walk(const Eigen::Vector3d& q, uint32_t start) const;

  /// The closest point on the boundary, downhill along it from the boundary vertex `start`, which
  /// becomes the nearer end of the edge found. `direction` becomes that of the edge.
  SurfacePoint walk_boundary(const Eigen::Vector3d& q, uint32_t* start,
                             Eigen::Vector3d* direction) const;

  /// The interpolated vertex normal at a point, of unit length (or zero).
  Eigen::Vector3d normal(const SurfacePoint& point) const;

  /// The point on the curved PN triangle over its flat one (Vlachos et al., "Curved PN
  /// triangles", I3D 2001): closer to a smooth surface of which the vertices are samples. Flat
  /// where a vertex normal is 30 degrees from the triangle's or more, at creases.
  Eigen::Vector3d curved(const SurfacePoint& point) const;

  /// Whether a point lies on a boundary edge of its triangle.
  bool on_boundary(const SurfacePoint& point) const;

 private:
  const SurfaceTopology* topology_;
  Positions positions_;
  Positions normals_;
  std::unique_ptr<ClosestPointQuery> index_, boundary_index_;
  std::vector<std::array<uint32_t, 2>> boundary_;  ///< edges, in the order of their index
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_H_
