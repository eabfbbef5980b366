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
/// polygon of n corners. A polygon is a fan from its first corner where no triangle of it is turned against the others;
/// a concave one is cut by mapbox earcut in the plane of its mean normal, but stays a fan where it crosses itself.
/// `positions` are x y z per vertex, of a frame that stands for all. A polygon of more than 4000 corners, and in a
/// build without earcut every one, is a fan. Cost: O(corners); of concave polygons about n log n, n^2 at worst.
std::vector<uint32_t> corner_triangles(const Polygons& polygons, std::span<const float> positions);

/// The same as polygons of three vertices.
Polygons triangulated(const Polygons& polygons, std::span<const float> positions);

/// How many polygons have a corner that turns against the others, by more than 1e-4 of the area: fans from some corners
/// do not cover these once.
uint32_t count_concave(const Polygons& polygons, std::span<const float> positions);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_TRIANGULATE_H_
