// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_TEXTURES_BASIS_TEXTURES_H_
#define ANICODEC_TOOLS_TEXTURES_BASIS_TEXTURES_H_

#include "tools/textures/vat.h"
#include "tools/words/quantity.h"

#include <cstdint>

namespace anicodec::tools {

/// The error that a basis may have.
struct BasisBounds {
  Length rmse{0.1, true};  ///< metres, or a share of the diagonal of the box of all frames
  double rms_angle = 5;    ///< of the normals, degrees
  uint32_t most = 256;     ///< components, of positions and of normals each
};

/// A basis and weights, in two textures. In frame t, vertex v is at
///
///   rest(v) + weight(t, 0) + weight(t, 1) + sum over j of basis(v, j) weight(t, 2 + j)
///
/// and its normal has the direction of a second sum, with components and weights of its own (Alexa and Mueller 2000, a
/// number for each vertex and component, a vector for each frame and component). The first two weights, the motion of the whole, have together twice the
/// digits of one. NAME.glb has rest(v), the mean.
/// NAME_basis holds four components a texel: a layer of rows for each four, those of positions first. NAME_weights is a
/// row of vectors for each frame, and more of them beside it where there are more frames than rows. NAME_basis.json has
/// the numbers that shaders want.  Rows of the basis have at most 1024 texels where
/// that fits, so that places are exact in half floats, too.
/// Throws Error(kInput) where the bounds want more components than `most`, or textures pass the limit.
/// A bound that rounded numbers pass is named as left out.
/// Cost: O(frames vertices components), some twenty passes, and again where rounding passes a bound. Memory: three floats for each vertex and frame, twice with
/// normals.
VatResult make_basis(const VatSource& source, const VatOptions& options, const BasisBounds& bounds);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_BASIS_TEXTURES_H_
