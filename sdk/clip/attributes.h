// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_ATTRIBUTES_H_
#define ANICODEC_SDK_CLIP_ATTRIBUTES_H_

#include "format/attribute_record.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"

#include <cstdint>

namespace anicodec {

/// A decoded attribute of a mesh, as in frame 0.
struct MeshAttribute {
  AttributeHeader header;
  Vector<float> values;     ///< elements x components
  Vector<uint32_t> labels;  ///< of polygons: 0 none, else one more than the number of a label.
                            ///< Without components: elements of one number share a value
  /// The attribute_surface() of an attribute that moves; its triangles go once segments are open.
  Topology surface;
};

/// Decodes the attributes of a mesh in canonical order. `moving`: for each attribute, one more than
/// the domain over which segments move it, 0 if none do; attributes of that domain get their
/// entries. Cost: O(corners log corners + numbers), memory 40 bytes for each corner and 8 for each
/// vertex beside the result, for a moment.
Status decode_attributes(const AttributeRecord& record, const Limits::Mesh& sizes,
                         const Topology& topology, const Vector<uint8_t>& moving,
                         Vector<MeshAttribute>* out);

/// Reorders the values of vertices as apply_vertex_map() does the vertices.
void apply_vertex_map(const Vector<uint32_t>& source, Vector<MeshAttribute>* attributes);

/// Reorders the values of polygons and corners as apply_face_map() does these; `topology` as it is
/// before.
void apply_face_map(const Vector<uint32_t>& place, const Vector<uint32_t>& first,
                    const Topology& topology, Vector<MeshAttribute>* attributes);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ATTRIBUTES_H_
