// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_NORMAL_FIT_H_
#define ANICODEC_CODEC_MASSAGE_NORMAL_FIT_H_

#include "codec/surface/surface.h"

namespace anicodec {

/// Moves inner vertices along their normals to where the polygons are closest to a surface of the
/// same connectivity, vertex i near its own place: least squares of the distances, point to plane,
/// of the vertices and the triangle centres from the curved surface (Surface::curved()) and of the
/// vertices of the surface from the polygons. Vertices keep their places along the surface.
/// Serial; cost a round: about 4 queries a vertex, by walking, and 20 passes over the edges.
void fit_normals(const Surface& surface, int rounds, Positions* v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_NORMAL_FIT_H_
