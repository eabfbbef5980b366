// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_CORRESPONDENCE_H_
#define ANICODEC_CODEC_MASSAGE_CORRESPONDENCE_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// Least dot product of unit normals for a surface to count as the same sheet.
inline constexpr double kLeastAgreement = 0.3;

/// A point of the mesh and where it should be: a row of the matrix B of the thesis (section 3.2.2).
struct Correspondence {
  SurfaceTopology::Triangle corners{};  ///< of the mesh; thrice the same for one of its vertices
  Eigen::Vector3d weights = Eigen::Vector3d::UnitX();  ///< barycentric, over the corners
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the surface at the target
  /// For a boundary vertex, the direction of the boundary at the target; else zero.
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  bool used = false;
  double importance = 1;  ///< a factor to its weight, kept from update to update

  Eigen::Vector3d point(const Positions& v) const {
    return weights[0] * row(v, corners[0]) + weights[1] * row(v, corners[1]) +
           weights[2] * row(v, corners[2]);
  }
};

/// Distances between the points and their targets.
struct Residuals {
  double rms = 0;
  double max = 0;
  double dropped_share = 0;  ///< of all correspondences
};

/// The correspondences between a mesh that moves and the surface that it is to cover, both ways:
/// every vertex (and triangle centre) of the mesh with its closest point on the surface, and every
/// vertex of the surface with the closest point of the mesh. Closest points are kept by walking
/// from the ones before, and found anew by the spatial index when asked. A pair is left out if its
/// normals disagree, or if one of its sides lies on the boundary and the other does not; the
/// boundary of the mesh corresponds with that of the surface if it has one. On all threads; the
/// result does not depend on their number.
class Correspondences {
 public:
  /// Both must outlive it; the surface has an index. centres: of the triangles as well.
  Correspondences(const SurfaceTopology& mesh, const Surface& surface, bool centres);

  /// For the positions v of the mesh.
  void update(const Positions& v, bool by_index);

  /// From the mesh: first its vertices in order, then the centres.
  const std::vector<Correspondence>& from_mesh() const { return from_mesh_; }

  const std::vector<Correspondence>& from_surface() const { return from_surface_; }

  Residuals residuals(const Positions& v) const;

  /// Multiplies the importance of each by (distance / RMS)^exponent, mean 1, within [0.01, 1000]
  /// (Lawson's algorithm, thesis section 3.2.3).
  void reweight(const Positions& v, double exponent);

  /// Lowers the importance of far ones to exp(-(d / s)^2), s thrice the 90 % quantile of all d.
  void trust_near(const Positions& v);

  /// Sum of the surface's normals at the targets of the vertices.
  Eigen::Vector3d facing(uint32_t triangle) const;

 private:
  SurfacePoint find(const Surface& surface, const Eigen::Vector3d& q, bool by_index,
                    uint32_t* start) const;
  void draw_vertex(uint32_t i, const Positions& v, const Positions& normals, bool by_index);
  void draw_centre(uint32_t t, const Positions& v, bool by_index);
  void draw_to_vertex(uint32_t j, const Surface& moving, bool by_index);

  template <class Visit>
  void for_used(const Visit& visit);

  const SurfaceTopology* mesh_;
  const Surface* surface_;
  bool surface_has_boundary_;
  std::vector<Correspondence> from_mesh_, from_surface_;
  std::vector<uint32_t> start_on_surface_, start_on_mesh_;  ///< where walks start
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_CORRESPONDENCE_H_
