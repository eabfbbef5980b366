// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/remesh_fit.h"

#include "codec/massage/welded_surface.h"
#include "codec/sequence/error.h"
#include "codec/surface/surface_match.h"
#include "codec/transfer/close_fit.h"

#include <utility>

namespace anicodec {
namespace {

/// A mesh and the surface it is to lie on.
struct FittedPair {
  FittedPair(const SurfaceFrame& mesh_frame, const SurfaceFrame& surface_frame)
      : mesh(mesh_frame),
        surface(surface_frame),
        moving(single_frame(mesh)),
        fixed(single_frame(surface)),
        start(moving.frame(mesh.positions)),
        target(fixed.topology, fixed.frame(surface.positions)) {
    if (moving.topology.triangles.empty() || fixed.topology.triangles.empty())
      throw Error(ErrorKind::kInput, "a mesh without triangles cannot be fitted, nor be fitted to");
    target.build_index();
  }

  HausdorffDistance distance(std::span<const float> positions) const {
    return hausdorff(mesh.polygons, positions, surface.polygons, surface.positions);
  }

  uint32_t turned(const Positions& v) const {
    return static_cast<uint32_t>(turned_triangles(moving.topology, v, target).size());
  }

  const SurfaceFrame& mesh;
  const SurfaceFrame& surface;
  WeldedSurface moving, fixed;
  Positions start;
  Surface target;
};

RemeshFit measured(const FittedPair& pair) {
  RemeshFit fit;
  fit.positions = pair.mesh.positions;
  fit.before = fit.after = pair.distance(pair.mesh.positions);
  fit.ratio_before = fit.ratio_after = radius_ratio(pair.moving.topology, pair.start);
  fit.turned_before = fit.turned_after = pair.turned(pair.start);
  const Positions& w = pair.target.positions();
  fit.diagonal = (w.colwise().maxCoeff() - w.colwise().minCoeff()).norm();
  return fit;
}

}  // namespace

RemeshFit measure_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface) {
  return measured(FittedPair(mesh, surface));
}

RemeshFit fit_remesh(const SurfaceFrame& mesh, const SurfaceFrame& surface) {
  const FittedPair pair(mesh, surface);
  check_surfaces_match(pair.moving.topology, pair.start, pair.target);
  RemeshFit fit = measured(pair);
  fit.opening = check_openings(pair.moving.topology, pair.start, pair.target);
  Positions v = pair.start;
  fit.convergence = fit_closely(pair.moving.topology, pair.target, &v);
  FrameArray positions = mesh.positions;
  pair.moving.store(v, positions);
  const HausdorffDistance after = pair.distance(positions);
  fit.improved = after.mean() < fit.before.mean() && after.max() <= fit.before.max();
  if (!fit.improved)
    return fit;
  fit.positions = std::move(positions);
  fit.after = after;
  fit.ratio_after = radius_ratio(pair.moving.topology, v);
  fit.turned_after = pair.turned(v);
  return fit;
}

}  // namespace anicodec
