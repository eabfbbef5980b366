// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_SHAPE_WEIGHTS_H_
#define ANICODEC_CODEC_MASSAGE_SHAPE_WEIGHTS_H_

#include "codec/surface/surface.h"

#include <cstdint>

#include <Eigen/SparseCore>

namespace anicodec {

/// How a vertex is averaged from its neighbours (thesis section 3.1.1).
enum class ShapeWeights : uint8_t {
  kUniform,    ///< all alike: triangles become equilateral
  kMeanValue,  ///< Floater 2003, of the ring flattened along the vertex normal: keeps shapes
  kHarmonic,   ///< cotangents, clamped from below at a hundredth of the ring's mean: keeps shapes
};

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A = I - Lambda, vertices x vertices: row i says by how much vertex i is off the mean of its
/// neighbours, (A v)_i = v_i - sum_j lambda_ij v_j, with lambda_ij >= 0 and sum 1. The weights come
/// from `reference`, which may be another mesh of the same connectivity.
///   - A ring with a fold or a spike (an angle outside (1e-6, 3.14) when flattened): from the
///   angles
///     in space.
///   - A boundary vertex: from its two neighbours on the boundary, so that it slides along it.
///   - A corner of the boundary (a turn of more than 30 degrees), a vertex that is not manifold or
///     not used: an empty row; such a vertex is to be held.
/// Cost: O(triangles log of the largest ring).
RowMatrix shape_matrix(const SurfaceTopology& topology, const Positions& reference,
                       ShapeWeights weights);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_SHAPE_WEIGHTS_H_
