// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/mesh_map.h"

#include "codec/massage/welded_surface.h"
#include "codec/sequence/error.h"
#include "codec/transfer/cross_parametrisation.h"

#include <string>

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
