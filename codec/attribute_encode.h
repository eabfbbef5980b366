// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ATTRIBUTE_ENCODE_H_
#define ANICODEC_CODEC_ATTRIBUTE_ENCODE_H_

#include "codec/mesh_layout.h"
#include "codec/mesh_sequence.h"
#include "sdk/attributes.h"

#include <cstdint>

namespace anicodec {

/// Which attributes are stored, and how finely.
struct AttributeOptions {
  bool keep = true;          ///< false: positions alone
  uint32_t uv_bits = 12;     ///< UV are stored in steps of 2^-uv_bits
  uint32_t colour_bits = 8;  ///< colours in steps of 1 / (2^colour_bits - 1)
  uint32_t other_bits = 12;  ///< normals, tangents and others, over the range of each component
  bool normals = false;      ///< normals of the first frame as numbers, not only the hard edges
};

/// Codes what stands beside the positions, as in the first frame, into layout->attributes (chunk
/// ATTR) and layout->sizes.attribute_bytes. Of normals only the hard edges are kept, unless options
/// ask for more: corners at one coded vertex whose normals are less than half a degree apart share
/// one. Materials and parts become labels of polygons. Throws Error(kInput) for values that are not
/// finite, that do not fit the mesh, or that the grid cannot hold. Cost: O(corners log corners).
void encode_attributes(const MeshSequence& sequence, const AttributeOptions& options,
                       MeshLayout* layout);

/// Puts decoded attributes into a sequence of the same numbering: the first material and part
/// attribute into fields of their own, which corners share normals into shared_normals.
void restore_attributes(const Vector<MeshAttribute>& decoded, MeshSequence* sequence);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ATTRIBUTE_ENCODE_H_
