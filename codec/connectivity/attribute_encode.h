// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_
#define ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/attribute_record.h"
#include "sdk/mesh/topology.h"

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
  /// Largest error of attributes that move and have no bound of their own; nothing: half a step of colour_bits for
  /// colours, 0.1 % for others.
  std::optional<AttributeBound> error;
  /// Numbers of attributes that later frames move, of a live stream, though these may not.
  std::vector<uint32_t> moving;
  bool share = true;  ///< whether elements at one vertex that move alike are coded once
};

/// An attribute as the file holds it.
struct StoredAttribute {
  uint32_t source = 0;  ///< its number in the sequence
  uint32_t number = 0;  ///< and in the file
  AttributeHeader header;
  std::vector<uint32_t> rows;  ///< the source's element of each element in canonical order
  /// Some frame has other values than the first. Normals and tangents follow from positions.
  bool moves = false;
  // An attribute that moves has also
  double bound = 0;  ///< the largest error that it may have
  /// Values of the first frame as decoders get them: elements of the source x components.
  std::vector<float> rest;
  Topology surface;  ///< attribute_surface(), in canonical order
};

/// Whether elements that share a moving value in `stored` share it in the frames of `attribute`,
/// too. O(values).
bool moves_as_stored(const Attribute& attribute, const StoredAttribute& stored);

/// Codes what stands beside the positions, as in the first frame, into layout->attributes (chunk
/// ATTR) and counts of them (layout->sizes). Normals are kept as hard edges only, unless options
/// ask for more: corners at one coded vertex whose normals are less than half a degree apart share
/// one. Materials and parts become labels of polygons. The steps of an attribute that moves are
/// halved until its first frame takes a quarter of its error at most, and its elements share what
/// moves only where their values stay within an eighth of it. An attribute that rests and has a
/// bound of its own has the coarsest steps that keep it. Returns the attributes that are stored as
/// numbers. Throws Error(kInput), naming frame and element, for values that are not finite, that no
/// grid can hold or that are not whole although they are to be exact, or if there are not as many
/// as the mesh has elements; Error(kUsage) for a bound that cannot be kept. Cost: O(values +
/// corners log corners).
std::vector<StoredAttribute> encode_attributes(const MeshSequence& sequence,
                                               const AttributeOptions& options, MeshLayout* layout);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_ATTRIBUTE_ENCODE_H_
