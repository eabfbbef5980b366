// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The counts that Draco's poses announce, read before Draco does (spec/07-topology.md, section 7).
// Draco makes room for counts that it has not compared with anything, and runs whatever prediction a
// stream names: what passes here, it decodes in memory and time that the limits tell.
#ifndef ANICODEC_SDK_MESH_DRACO_PROFILE_H_
#define ANICODEC_SDK_MESH_DRACO_PROFILE_H_

#include "format/bytes.h"

#include <cstdint>

namespace anicodec {

/// Poses that one attribute holds, and attributes of a bitstream, at most.
inline constexpr uint32_t kMaxDracoAttributePoses = 85, kMaxDracoAttributes = 64;

/// Bits of the table that symbols are decoded with, if they stand for so many values, at most.
uint32_t draco_table_bits(uint64_t values);

/// Symbols that the values of an attribute can have, at most.
inline constexpr uint32_t kMaxDracoSymbols = 1U << 18;

/// Checks the descriptions of the attributes, with which `bytes` begin: together they hold so many
/// poses.
bool check_draco_attributes(ByteView bytes, uint32_t poses);

/// Checks how the values of an attribute are coded, with which `rest` begins: their prediction and
/// their alphabet. `values`: points x components.
bool check_draco_values(ByteView rest, uint64_t values);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DRACO_PROFILE_H_
