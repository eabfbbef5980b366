// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Mesh Massage of one mesh (thesis section 3.3.2, remeshing): a coarse mesh comes to lie on a
// surface as well as its vertices allow.
#ifndef ANICODEC_CODEC_MESH_FIT_H_
#define ANICODEC_CODEC_MESH_FIT_H_

#include "codec/hausdorff.h"
#include "codec/mesh_quality.h"
#include "codec/mesh_sequence.h"
#include "codec/sliding_solve.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// A mesh by itself.
struct SurfaceFrame {
  Polygons polygons;
  std::vector<float> positions;  ///< vertices x 3
};

struct MeshFitOptions {
  double first_stiffness = 1;    ///< of the mesh's own shape against the distance, at first
  double last_stiffness = 0.01;  ///< and at last
  int rounds = 14;
};

struct MeshFit {
  std::vector<float> positions;  ///< of the mesh, vertices x 3
  HausdorffDistance before, after;
  double diagonal = 0;  ///< of the box around the surface
  RadiusRatio ratio_before, ratio_after;
  uint32_t turned_before = 0, turned_after = 0;  ///< triangles that face against the surface
  uint32_t drawn_back = 0;                       ///< vertices, because a triangle had turned
  bool improved = false;  ///< if not, the positions are those that were given
  Convergence convergence;
};

/// Fits a mesh to a surface of any connectivity that it roughly covers already: Registration with
/// the centres of triangles as well and falling stiffness. Vertices at the same place move
/// together. Triangles that turned are drawn back towards where they came from. If the mean
/// distance did not fall, the mesh stays as it was. Throws Error(kInput) if a mesh has no
/// triangles, if one is open and the other closed, and for a component of one that has no
/// counterpart in the other.
MeshFit fit_mesh(const SurfaceFrame& mesh, const SurfaceFrame& surface,
                 const MeshFitOptions& options = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MESH_FIT_H_
