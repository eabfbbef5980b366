// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Chunk ATTR: what stands beside the positions of a mesh, as in frame 0 (spec/06-chunks.md, section
// 10).
#ifndef ANICODEC_FORMAT_ATTRIBUTE_RECORD_H_
#define ANICODEC_FORMAT_ATTRIBUTE_RECORD_H_

#include "format/bytes.h"
#include "format/material_look.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

enum class AttributeKind : uint8_t {
  kUv = 0,
  kNormal = 1,
  kTangent = 2,
  kColour = 3,
  kCustom = 4,
  kMaterial = 5,
  kPart = 6
};

/// One attribute: numbers on a grid, or with no component only the information which corners share a value; of
/// materials and parts, a label for each polygon, or none.
struct AttributeHeader {
  /// A component of an integer n is origin + n / scale.
  struct Grid {
    double origin = 0;
    double scale = 1;
  };

  AttributeKind kind = AttributeKind::kUv;
  AttributeDomain domain = AttributeDomain::kVertex;
  String name;
  Vector<Grid> grids;  ///< one for each component, empty for labels
  Vector<String> labels;
  Vector<MaterialLook> looks;  ///< of materials: one for each label, or none

  uint32_t components() const { return static_cast<uint32_t>(grids.size()); }

  bool has_labels() const { return kind >= AttributeKind::kMaterial; }

  /// How many elements a mesh has in the domain.
  uint32_t elements(const Limits::Mesh& mesh) const { return mesh.elements(domain); }
};

/// Sets what the limits say of the attributes of a mesh, whose other counts are there.
void count_attributes(const Vector<AttributeHeader>& attributes, Limits::Mesh* mesh);

/// Bytes that the attributes of a mesh keep in memory, at most (spec/11-limits.md, section 3).
inline uint64_t attribute_bytes(const Limits::Mesh& mesh) {
  return 4 * mesh.attribute_numbers + uint64_t{2} * mesh.attribute_head +
         512 * uint64_t{mesh.attributes} + 256 * uint64_t{mesh.attribute_labels};
}

struct AttributeRecord {
  Vector<AttributeHeader> attributes;
  ByteView stream;  ///< entropy-coded values of all, one after the other

  Bytes write() const;
  /// kRecord where the attributes are not those that the limits of their mesh announce, too.
  static Status read(ByteView view, const Limits::Mesh& mesh, AttributeRecord* out);
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_ATTRIBUTE_RECORD_H_
