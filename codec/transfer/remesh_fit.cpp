// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/remesh_fit.h"

#include "codec/massage/untangle.h"
#include "codec/massage/welded_surface.h"
#include "codec/sequence/error.h"
#include "codec/surface/surface_match.h"

#include <utility>

namespace anicodec {
namespace {

MeshSequence single_frame(const SurfaceFrame& mesh) {
  MeshSequence sequence;
  sequence.polygons = mesh.polygons;
  sequence.positions = mesh.positions;
  sequence.vertex_count = static_cast<uint32_t>(mesh.positions.size() / 3);
  sequence.frame_count = 1;
  check(sequence);
  return sequence;
}

}  // namespace

MeshFit fit_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface,
                 const DistanceFitOptions& options) {
  const MeshSequence mesh_clip = single_frame(mesh), surface_clip = single_frame(surface);
  const WeldedClip moving(mesh_clip), fixed(surface_clip);
  if (moving.topology.triangles.empty() || fixed.topology.triangles.empty())
    throw Error(ErrorKind::kInput, "a mesh without triangles cannot be fitted, nor be fitted to");
  const Positions start = moving.frame(mesh.positions);
  Surface target(fixed.topology, fixed.frame(surface.positions));
  target.build_index();
  check_surfaces_match(moving.topology, start, target);

  MeshFit fit;
  fit.before = hausdorff(mesh.polygons, mesh.positions, surface.polygons, surface.positions);
  fit.ratio_before = radius_ratio(moving.topology, start);
  fit.turned_before =
      static_cast<uint32_t>(turned_triangles(moving.topology, start, target).size());
  Positions v = start;
  const RigidShape shape(moving.topology, start);
  fit.convergence = fit_distance(moving.topology, shape, target, options, &v);
  fit.positions = mesh.positions;
  moving.store(v, fit.positions);
  fit.after = hausdorff(mesh.polygons, fit.positions, surface.polygons, surface.positions);
  fit.improved = fit.after.mean() < fit.before.mean();
  if (!fit.improved) {
    fit.positions = mesh.positions;
    fit.after = fit.before;
    v = start;
  }
  fit.ratio_after = radius_ratio(moving.topology, v);
  fit.turned_after = static_cast<uint32_t>(turned_triangles(moving.topology, v, target).size());
  const Positions& w = target.positions();
  fit.diagonal = (w.colwise().maxCoeff() - w.colwise().minCoeff()).norm();
  return fit;
}

}  // namespace anicodec
