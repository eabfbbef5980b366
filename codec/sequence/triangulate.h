// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_TRIANGULATE_H_
#define ANICODEC_CODEC_SEQUENCE_TRIANGULATE_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Triangles of all polygons, three corners (indices into polygons.corners) each, polygon by polygon, n - 2 of a
/// polygon of n corners, cut as players cut them (PolygonCutter). `positions` are x y z per vertex, of a frame that stands
/// for all.
std::vector<uint32_t> corner_triangles(const Polygons& polygons, std::span<const float> positions);

/// The same as polygons of three vertices.
Polygons triangulated(const Polygons& polygons, std::span<const float> positions);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_TRIANGULATE_H_
