// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What a Draco bitstream announces, read before Draco does (spec/07-topology.md, section 3). Draco
// makes room for counts that it has not compared with anything, and runs whatever prediction a
// stream names: what passes here, it decodes in memory and time that the limits tell.
#ifndef ANICODEC_SDK_MESH_DRACO_PROFILE_H_
#define ANICODEC_SDK_MESH_DRACO_PROFILE_H_

#include "format/bytes.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Counts of a mesh that the limits tell.
struct DracoCounts {
  uint32_t points = 0;
  uint32_t triangles = 0;
  uint32_t components = 0;  ///< of all attributes together
};

/// Attributes hold poses of three components each; there may be a stand-in.
uint32_t most_draco_attributes(uint32_t components);

/// Bits of the table that symbols are decoded with, if they stand for so many values, at most.
uint32_t draco_table_bits(uint64_t values);

/// Symbols that the values of an attribute can have, at most.
inline constexpr uint32_t kMaxDracoSymbols = 1U << 18;

/// The streams that tell where attributes have seams: one for each attribute but the first.
struct DracoSeams {
  size_t begin = 0, end = 0;  ///< bytes of the bitstream
  uint32_t streams = 0;
  uint32_t symbols = 0;  ///< that follow in lists by valence; 0: there are none
};

/// Checks the header of a bitstream and everything up to the end of the seams, and says where those
/// are. False for what is not of the profile. Cost: O(bytes).
bool read_draco_head(ByteView bytes, const DracoCounts& counts, DracoSeams* seams);

/// Checks the descriptions of `attributes` attributes, with which `rest` begins.
bool check_draco_attributes(ByteView rest, const DracoCounts& counts, uint32_t attributes);

/// Checks the alphabet of a list of so many symbols, with which `rest` begins.
bool check_draco_symbols(ByteView rest, uint64_t values);

/// Checks how the values of an attribute are coded, with which `rest` begins: their prediction and
/// their alphabet. `values`: points x components.
bool check_draco_values(ByteView rest, uint64_t values);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DRACO_PROFILE_H_
