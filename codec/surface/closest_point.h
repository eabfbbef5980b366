// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_CLOSEST_POINT_H_
#define ANICODEC_CODEC_SURFACE_CLOSEST_POINT_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Every polygon of three or more corners as a fan from its first corner, three vertices each;
/// degenerate triangles included.
std::vector<uint32_t> fan_triangles(const Polygons& polygons);

struct ClosestPoint {
  double square_distance = 0;
  uint32_t element = 0;  ///< the triangle, or the vertex of a point cloud; the first of equal ones
  /// Barycentric, none negative, sum 1; {1, 0, 0} in a point cloud.
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// The point of a triangle (corners a, b, c, may be degenerate) that is closest to q, to the
/// precision of double; `element` is left 0.
ClosestPoint closest_on_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c, const Eigen::Vector3d& q);

/// Closest points on a triangle mesh, or, if it has no triangle, closest vertices of a point cloud.
/// A hierarchy of boxes finds the candidates, so that the result is that of a search through all
/// elements. Memory: about 100 bytes an element. Cost: building n log n; a query 3 to 5 microseconds
/// near the surface of 10k to 40k triangles, 12 far from it.
class ClosestPointQuery {
 public:
  /// Copies what it needs. `positions` is x y z per vertex, all finite, at least one. Throws
  /// Error(kInput) if there is none or one is not finite.
  ClosestPointQuery(std::span<const uint32_t> triangles, std::span<const float> positions);
  ~ClosestPointQuery();
  ClosestPointQuery(ClosestPointQuery&&) noexcept;
  ClosestPointQuery& operator=(ClosestPointQuery&&) noexcept;

  /// May be called from several threads at once.
  ClosestPoint operator()(const Eigen::Vector3d& q) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_CLOSEST_POINT_H_
