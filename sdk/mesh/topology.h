// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_TOPOLOGY_H_
#define ANICODEC_SDK_MESH_TOPOLOGY_H_

#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// The connectivity of a mesh as decoded (spec/07-topology.md). Two numberings occur:
///   coded vertices   distinct trajectories: in the order of their first use by a face, then the
///                    loose ones, which no face of the walk uses
///   vertices         what the user gets: every source vertex once, welds undone. In canonical order
///                    the copies of a coded vertex follow one another, in the order of their first
///                    use by a polygon corner; the vertex map then restores the source's order.
struct Topology {
  uint32_t coded_vertices = 0;
  uint32_t vertices_in_triangles = 0;  ///< coded ones; they come first, the loose ones follow
  Vector<uint32_t> triangles;          ///< coded vertices, three per triangle; fans of the faces
  Vector<uint32_t> vertex_coded;       ///< coded vertex of each vertex
  Vector<uint32_t> polygon_offsets;    ///< polygon p has corners offsets[p] .. offsets[p+1]-1
  Vector<uint32_t> polygon_corners;    ///< vertex of each corner
};

/// Whether a polygon has more than three corners. O(polygons).
bool has_larger_polygons(const Topology& topology);

/// Decodes the polygons of a mesh record, in canonical order. Cost: O(corners + vertices), whatever
/// the bytes.
Status decode_faces(ByteView stream, const Limits::Mesh& sizes, Topology* out);

/// Decodes a vertex map (chunk VMAP): `source[i]` is the place, in the source's order, of vertex i
/// of the canonical order, in which `topology` is; a permutation, else kIndexRange.
Status decode_vertex_map(ByteView bytes, const Topology& topology, Vector<uint32_t>* source);

/// Decodes a face map (chunk FMAP): polygon i of the canonical order is number place[i] of the
/// source, whose first corner is corner first[i] of it.
Status decode_face_map(ByteView bytes, const Topology& topology, Vector<uint32_t>* place,
                       Vector<uint32_t>* first);

/// Renumbers vertices into the source's order.
void apply_vertex_map(const Vector<uint32_t>& source, Topology* topology);

/// Which canonical corner comes at each place once polygons are reordered, canonical[i] to place i,
/// and rotated to begin with corner first[canonical[i]].
Vector<uint32_t> corner_order(const Vector<uint32_t>& canonical, const Vector<uint32_t>& first,
                              const Vector<uint32_t>& offsets);

/// Reorders polygons and rotates their corners into the source's order.
void apply_face_map(const Vector<uint32_t>& place, const Vector<uint32_t>& first,
                    Topology* topology);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_TOPOLOGY_H_
