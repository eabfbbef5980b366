// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/mesh_map.h"

#include "codec/massage/welded_surface.h"
#include "codec/sequence/error.h"
#include "codec/transfer/cross_parametrisation.h"

#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

/// The pairs as welded vertices of the mesh and places on the surface.
std::vector<Landmark> landmarks_of(std::span<const VertexPair> pairs, const WeldedSurface& mesh,
                                   const WeldedSurface& surface, const Positions& places) {
  std::vector<Landmark> landmarks;
  auto welded = [](const WeldedSurface& side, uint32_t vertex, const char* which) {
    if (vertex >= side.weld.welded.size())
      throw Error(ErrorKind::kUsage, "landmark at vertex " + std::to_string(vertex) + " of the " +
                                         which + ", which has " +
                                         std::to_string(side.weld.welded.size()));
    return side.weld.welded[vertex];
  };
  for (const VertexPair& pair : pairs)
    landmarks.push_back(
        {welded(mesh, pair.mesh, "mesh"), row(places, welded(surface, pair.surface, "surface"))});
  return landmarks;
}

/// The triangles of a welded surface as corners of its polygons.
class CornerTriangles {
 public:
  CornerTriangles(const SurfaceFrame& mesh, const WeldedSurface& welded) {
    const Polygons& polygons = mesh.polygons;
    const auto vertex = [&](uint32_t corner) {
      return welded.weld.welded[polygons.corners[corner]];
    };
    for (uint32_t p = 0; p < polygons.size(); ++p) {
      for (uint32_t k = polygons.offsets[p] + 1; k + 1 < polygons.offsets[p + 1]; ++k) {
        const uint32_t a = polygons.offsets[p];
        if (vertex(a) != vertex(k) && vertex(k) != vertex(k + 1) && vertex(k + 1) != vertex(a))
          triangles_.push_back({p, {a, k, k + 1}, {}});  // others are none of the surface's
      }
    }
  }

  MeshPoint at(uint32_t triangle, const Eigen::Vector3d& weights) const {
    MeshPoint point = triangles_[triangle];
    for (Eigen::Index k = 0; k < 3; ++k)
      point.weights[k] = weights[k];
    return point;
  }

 private:
  std::vector<MeshPoint> triangles_;
};

/// Barycentric weights of the point of a triangle's plane that is next to p.
Eigen::Vector3d weights_in_plane(const Surface& surface, uint32_t triangle,
                                 const Eigen::Vector3d& p) {
  const SurfaceTopology::Triangle& t = surface.topology().triangles[triangle];
  const Eigen::Vector3d a = row(surface.positions(), t[0]);
  const Eigen::Vector3d u = row(surface.positions(), t[1]) - a,
                        v = row(surface.positions(), t[2]) - a;
  const Eigen::Vector3d n = u.cross(v);
  if (!(n.squaredNorm() > 0))
    return {1, 0, 0};
  const double second = (p - a).cross(v).dot(n) / n.squaredNorm();
  const double third = u.cross(p - a).dot(n) / n.squaredNorm();
  return {1 - second - third, second, third};
}

/// See MeshMap::corners.
std::vector<MeshPoint> corner_points(const Polygons& polygons, std::span<const float> positions,
                                     const Surface& surface, const CornerTriangles& triangles) {
  constexpr double kInwards = 0.02;  // of the way to the middle of the polygon
  const Positions all = positions_of(positions);
  std::vector<MeshPoint> points;
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const uint32_t v : polygons[p])
      middle += row(all, v) / static_cast<double>(polygons[p].size());
    for (const uint32_t v : polygons[p]) {
      const Eigen::Vector3d at = row(all, v);
      const uint32_t triangle = surface.closest(at + kInwards * (middle - at)).triangle;
      points.push_back(triangles.at(triangle, weights_in_plane(surface, triangle, at)));
    }
  }
  return points;
}

}  // namespace

MeshMap map_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface,
                 std::span<const VertexPair> landmarks) {
  const WeldedSurface moving(single_frame(mesh)), fixed(single_frame(surface));
  if (moving.topology.triangles.empty() || fixed.topology.triangles.empty())
    throw Error(ErrorKind::kInput, "a map needs triangles on both sides");
  const Positions shape = moving.frame(mesh.positions);
  Surface target(fixed.topology, fixed.frame(surface.positions));
  target.build_index();
  CrossParametrisationOptions options;
  options.landmarks = landmarks_of(landmarks, moving, fixed, target.positions());
  const Positions rough = map_by_landmarks(moving.topology, shape, target, options.landmarks);
  const CrossParametrisation found = improve_map(moving.topology, shape, target, rough, options);

  MeshMap map;
  map.positions = mesh.positions;
  moving.store(found.positions, map.positions);
  const CornerTriangles triangles(surface, fixed);
  for (const uint32_t welded : moving.weld.welded)
    map.points.push_back(triangles.at(found.points[welded].triangle, found.points[welded].weights));
  map.corners = corner_points(mesh.polygons, map.positions, target, triangles);
  map.before = found.before;
  map.after = found.after;
  map.turned = found.turned;
  map.distance = hausdorff(mesh.polygons, map.positions, surface.polygons, surface.positions);
  const Positions& w = target.positions();
  map.diagonal = (w.colwise().maxCoeff() - w.colwise().minCoeff()).norm();
  map.converged = found.convergence.converged;
  return map;
}

}  // namespace anicodec
