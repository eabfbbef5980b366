// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_MESH_QUALITY_H_
#define ANICODEC_CODEC_SURFACE_MESH_QUALITY_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Twice the radius of the inscribed circle over that of the circumscribed one: 1 for equilateral
/// triangles, 0 for degenerate ones (thesis table 3.3).
struct RadiusRatio {
  double mean = 0;  ///< over the triangles
  double least = 0;
};

RadiusRatio radius_ratio(const SurfaceTopology& topology, const Positions& positions);

/// How a map that is linear on every triangle changes it, by the singular values s1 >= s2 of its
/// Jacobian: conformal (s1/s2 + s2/s1)/2, area (a + 1/a)/2 for the change a of its area relative to
/// that of the whole surface; both 1 at best. Means are weighted by area before the map, and every
/// triangle counts with at most 20 in them (degenerate ones have no finite value).
struct Distortion {
  double conformal_mean = 1, conformal_max = 1;
  double area_mean = 1, area_max = 1;
};

/// From positions before to positions after. Triangles without area before are left out.
Distortion distortion(const SurfaceTopology& topology, const Positions& before,
                      const Positions& after);

/// The triangle of the surface below each triangle of a mesh of any connectivity: the one closest
/// to its centre, by the index. If that triangle faces the other way, walks to the centre from the
/// triangle below a neighbour, and takes the end of the walk if it faces the right way and is less
/// than a tenth of its longest side away: so the far side of a thin part is not mistaken for the
/// near one.
std::vector<uint32_t> triangles_below(const SurfaceTopology& topology, const Positions& positions,
                                      const Surface& surface);

/// Whether a triangle of a mesh faces against the surface where a walk from `start`, a triangle of
/// the surface, to its centre ends. Never one that has the same corners as its neighbour: together
/// they are both sides of a part without thickness.
bool is_turned(const SurfaceTopology& topology, const Positions& positions, uint32_t triangle,
               const Surface& surface, uint32_t start);

/// The triangles at some vertices that is_turned() finds, ascending. `below`: of every
/// triangle of the mesh, where its walk starts.
std::vector<uint32_t> turned_around(const SurfaceTopology& topology, const Positions& positions,
                                    std::span<const uint32_t> vertices, const Surface& surface,
                                    std::span<const uint32_t> below);

/// Triangles that face against what is below them (triangles_below()), but for those that have the
/// same corners as a neighbour, ascending. The surface has an index.
std::vector<uint32_t> turned_triangles(const SurfaceTopology& topology, const Positions& positions,
                                       const Surface& surface);

/// The same for positions of the surface's own connectivity, of which each triangle is compared
/// with where a walk from its own place to its centre ends: a fold nearby is not mistaken for it.
/// Needs no index.
std::vector<uint32_t> turned_in_place(const Positions& positions, const Surface& surface);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_MESH_QUALITY_H_
