// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/mesh_fit.h"

#include "codec/error.h"
#include "codec/registration.h"
#include "codec/surface_match.h"
#include "codec/welded_clip.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr int kHalvings = 6;

MeshSequence single_frame(const SurfaceFrame& mesh) {
  MeshSequence sequence;
  sequence.polygons = mesh.polygons;
  sequence.positions = mesh.positions;
  sequence.vertex_count = static_cast<uint32_t>(mesh.positions.size() / 3);
  sequence.frame_count = 1;
  check(sequence);
  return sequence;
}

/// Draws triangles that have turned back to where they started.
uint32_t untangle(const SurfaceTopology& topology, const Surface& surface, const Positions& start,
                  const std::vector<uint32_t>& turned_at_start, Positions* v) {
  std::vector<bool> drawn(topology.vertex_count, false);
  for (int pass = 0; pass <= kHalvings + 1; ++pass) {
    const std::vector<uint32_t> turned = turned_triangles(topology, *v, surface);
    std::vector<uint32_t> fresh, vertices;
    std::set_difference(turned.begin(), turned.end(), turned_at_start.begin(),
                        turned_at_start.end(), std::back_inserter(fresh));
    if (fresh.empty())
      break;
    for (uint32_t t : fresh)
      vertices.insert(vertices.end(), topology.triangles[t].begin(), topology.triangles[t].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (uint32_t i : vertices) {
      const auto r = static_cast<Index>(i);
      const double share = pass < kHalvings ? 0.5 : 0;
      v->row(r) = start.row(r) + share * (v->row(r) - start.row(r));
      drawn[i] = true;
    }
  }
  return static_cast<uint32_t>(std::count(drawn.begin(), drawn.end(), true));
}

}  // namespace

MeshFit fit_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface,
                 const MeshFitOptions& options) {
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
  const std::vector<uint32_t> turned = turned_triangles(moving.topology, start, target);
  fit.turned_before = static_cast<uint32_t>(turned.size());
  const RigidShape shape(moving.topology, start);
  Registration registration(moving.topology, shape);
  RegistrationOptions registered;
  registered.first_stiffness = options.first_stiffness;
  registered.last_stiffness = options.last_stiffness;
  registered.rounds = options.rounds;
  registered.trust_near = false;
  registered.centres = true;
  Positions v = start;
  fit.convergence = registration.run(target, registered, &v).convergence;
  fit.drawn_back = untangle(moving.topology, target, start, turned, &v);
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
