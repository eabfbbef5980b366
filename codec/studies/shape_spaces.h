// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_STUDIES_SHAPE_SPACES_H_
#define ANICODEC_CODEC_STUDIES_SHAPE_SPACES_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec {

/// Error of a clip expressed by k principal components of one shape space, and what they take.
struct ShapeSpaceError {
  /// "vertices": positions of the aligned frames. "edges": edge lengths and dihedral angles, meshes
  /// rebuilt by multi-scale geometry interpolation. "gradients": logarithms and stretches of the
  /// triangles' deformation gradients, tracked by PML.
  std::string space;
  size_t k = 0;                 ///< components beside the mean
  double kg = 0;                ///< per cent, every frame moved rigidly onto the original
  uint64_t numbers = 0;         ///< of one component
  uint64_t bytes = 0;           ///< mean, components and coefficients of all frames as float32
  double residual_percent = 0;  ///< of the variance in the space itself that k components leave
};

/// Principal components of a sequence in three shape spaces (thesis section 5.3). In each the
/// components are linear combinations of the frames, so a frame cut off after k components is a
/// blend of all frames by weights that sum to one; the space's own interpolation makes the mesh.
/// Lengths count in scene units, angles by the length of their edge, gradients by the root of
/// their triangle's area, so that large features lead in all spaces.
///
/// Frames of long clips are left out evenly, so that vertices x frames stays below 1.6 million;
/// errors are measured on at most 16 frames. Rows space by space, for every k below the number of
/// frames; a space that a mesh has no part in is left out, as gradients without a triangle of some
/// area. Cost: per k and measured frame a blend of all frames, some 0.1 s for 200 frames of 7000
/// vertices in each of the last two spaces.
std::vector<ShapeSpaceError> shape_space_errors(const MeshSequence& clip,
                                                std::span<const size_t> counts);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_STUDIES_SHAPE_SPACES_H_
