// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_MESH_LAYOUT_H_
#define ANICODEC_CODEC_CONNECTIVITY_MESH_LAYOUT_H_

#include "codec/connectivity/weld.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/records.h"
#include "sdk/mesh/topology.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec {

/// How a mesh is laid out in the file: the numbering of its coded vertices, its connectivity as the
/// decoder will see it, and everything that leads back to the source.
struct MeshLayout {
  std::string name;
  Limits::Mesh sizes;
  Topology topology;                   ///< canonical order, exactly what a decoder rebuilds
  std::vector<uint32_t> coded_source;  ///< a source vertex of each coded vertex
  std::vector<uint32_t> source_coded;  ///< coded vertex of each source vertex
  Bytes faces;                         ///< the stream of chunk MESH
  Bytes vertex_map;                    ///< chunk VMAP
  Bytes face_map;                      ///< chunk FMAP
  Bytes root;                          ///< chunk ROOT, empty for none
  uint32_t root_frames = 0;            ///< Limits::root_frames
  String metadata;                     ///< chunk META, empty for none
  bool has_bounds = false;             ///< whether segments of positions have a chunk BNDS
  Bytes attributes;  ///< chunk ATTR, empty for none: encode_attributes() puts it there
  Vector<uint32_t> vertex_source;   ///< source vertex of each canonical vertex
  Vector<uint32_t> polygon_source;  ///< source polygon of each canonical polygon,
  Vector<uint32_t> polygon_first;   ///< and which of its corners is the source's first
};

/// Lays out a mesh. Cost: O(corners log corners).
MeshLayout lay_out_mesh(const MeshSequence& sequence, const Weld& weld);

/// The same where vertices of the same trajectory are one.
MeshLayout lay_out_mesh(const MeshSequence& sequence);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_MESH_LAYOUT_H_
