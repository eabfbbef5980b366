// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_
#define ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/sequence/mesh_sequence.h"
#include "sdk/clip/attributes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace anicodec {

/// Which attributes are stored, and how finely.
struct AttributeOptions {
  bool keep = true;          ///< false: positions alone
  uint32_t uv_bits = 12;     ///< UV are stored in steps of 2^-uv_bits
  uint32_t colour_bits = 8;  ///< colours in steps of 1 / (2^colour_bits - 1)
  uint32_t other_bits = 12;  ///< others, over the range of each component
  /// Normals and tangents of the first frame as numbers, whose directions are at most this many
  /// degrees off. Nothing: of normals the hard edges alone, and no tangents: players make these
  /// from positions and texture coordinates.
  std::optional<double> normals;
  /// Largest error of an attribute that moves, in units of its values or per cent of its range;
  /// nothing: half a step of colour_bits for colours, 0.1 % for others.
  std::optional<double> error;
  bool error_percent = false;
};

/// An attribute as the file holds it.
struct StoredAttribute {
  uint32_t source = 0;  ///< its number in the sequence
  uint32_t number = 0;  ///< and in the file
  AttributeHeader header;
  std::vector<uint32_t> rows;  ///< the source's element of each element in canonical order
  Topology surface;            ///< of one that moves: attribute_surface(), in canonical order
};

/// Whether values of some frame differ from those of the first one. Normals and tangents never do:
/// they follow from positions and texture coordinates.
bool moves(const Attribute& attribute);

/// The largest error that an attribute which moves may have. O(values).
double error_bound(const Attribute& attribute, const AttributeOptions& options);

/// The values of the first frame as decoders get them: elements of the source x components.
std::vector<float> stored_values(const Attribute& attribute, const StoredAttribute& stored);

/// Codes what stands beside the positions, as in the first frame, into layout->attributes (chunk
/// ATTR) and counts of them (layout->sizes). Of normals only the hard edges are kept, unless options
/// ask for more: corners at one coded vertex whose normals are less than half a degree apart share
/// one. Materials and parts become labels of polygons. The steps of an attribute that moves are
/// halved until its first frame takes a quarter of its error at most, and its elements share what moves only where
/// their values stay within an eighth of it. Returns the attributes that
/// are stored as numbers. Throws Error(kInput) for values that are not
/// finite, that do not fit the mesh, or that the grid cannot hold. Cost: O(corners log corners).
std::vector<StoredAttribute> encode_attributes(const MeshSequence& sequence,
                                               const AttributeOptions& options, MeshLayout* layout);

/// Puts decoded attributes into a sequence of the same numbering: the first material and part
/// attribute into fields of their own, which corners share normals into shared_normals.
void restore_attributes(const Vector<MeshAttribute>& decoded, MeshSequence* sequence);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_
