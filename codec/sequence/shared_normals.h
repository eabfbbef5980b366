// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_SHARED_NORMALS_H_
#define ANICODEC_CODEC_SEQUENCE_SHARED_NORMALS_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// The row of an attribute's values that each corner has.
std::vector<uint32_t> rows_of_corners(const Polygons& polygons, AttributeDomain domain);

/// A number below the number of corners for each corner, the same where corners of one place have
/// normals at most half a degree apart. `rows` says which of the attribute's values a corner has,
/// `places` (any numbers below place_count) where it is. Throws Error(kInput) unless normals have
/// three components. Cost: O(corners x normals at a place).
std::vector<uint32_t> share_normals(const Attribute& normals, std::span<const uint32_t> rows,
                                    std::span<const uint32_t> places, uint32_t place_count);

/// sequence.shared_normals; if it is empty, the same worked out from the normals of the first frame,
/// vertices at one position taken as one. Empty if the sequence has neither. `flat`: of each polygon, whether it shares no normal with others; empty: none is
/// so.
std::vector<uint32_t> known_shared_normals(const MeshSequence& sequence,
                                           const std::vector<bool>& flat = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_SHARED_NORMALS_H_
