// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FORMATS_VERTEX_CACHE_H_
#define ANICODEC_TOOLS_IO_FORMATS_VERTEX_CACHE_H_

#include "codec/sequence/progress.h"
#include "tools/io/files/byte_source.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The content of a PC2 or MDD file besides positions. Size and counts have been checked against each
/// other.
struct VertexCache {
  uint32_t vertex_count = 0;
  uint32_t frame_count = 0;
  uint64_t data_offset = 0;  ///< of frame_count x vertex_count x 3 floats
  std::endian order = std::endian::little;
  std::vector<float> times;  ///< seconds of each frame (MDD); PC2 has none
  /// For PC2: the frame of the scene at which the first sample stands, and frames from sample to
  /// sample.
  float first_frame = 0, frames_per_sample = 1;
};

/// Reads the header of a PC2 (little-endian, "POINTCACHE2", version 1). Throws Error(kInput).
VertexCache open_pc2(const ByteSource& source);

/// Reads the header and times of an MDD (big-endian). Throws Error(kInput).
VertexCache open_mdd(const ByteSource& source);

/// Reads all positions into frame_count x vertex_count x 3 floats, piece by piece. Throws
/// Error(kInput) naming frame and vertex where one is not finite.
void read_positions(const VertexCache& cache, const ByteSource& source, std::span<float> positions,
                    const Progress& progress = {});

/// Appends the 32 bytes before the positions of a PC2: start 0, rate 1.
void append_pc2_header(uint32_t vertex_count, uint32_t frame_count, std::string& out);

/// Appends what comes before the positions of an MDD. One time per frame, in seconds.
void append_mdd_header(uint32_t vertex_count, std::span<const float> times, std::string& out);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FORMATS_VERTEX_CACHE_H_
