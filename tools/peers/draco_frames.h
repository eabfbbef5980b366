// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_PEERS_DRACO_FRAMES_H_
#define ANICODEC_TOOLS_PEERS_DRACO_FRAMES_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/peers/cubic_grid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec::peers {

/// Every frame as a Draco mesh of its own: edgebreaker, speed 0 (the smallest and slowest).
struct DracoFrames {
  int bits = 0;   ///< of a coordinate
  double kg = 0;  ///< per cent
  std::vector<std::vector<char>> frames;

  uint64_t bytes() const;
};

/// Draco's own quantisation, each frame in its own cube, with the fewest bits (at most 24) whose KG
/// error is at most `kg`. Throws Error(kUsage) if there are none.
DracoFrames draco_at_kg(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                        double kg);

/// The positions of one frame as draco_at_kg() would store them with so many bits.
std::vector<char> draco_frame(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                              uint32_t frame, int bits);

/// The positions of the grid: just its error, where bits give one of few.
DracoFrames draco_on_grid(const MeshSequence& sequence, std::span<const uint32_t> triangles,
                          const GriddedClip& grid);

/// Decodes a mesh; returns its number of points. Throws Error(kInternal).
uint32_t decode_draco(std::span<const char> bytes);

}  // namespace anicodec::peers

#endif  // ANICODEC_TOOLS_PEERS_DRACO_FRAMES_H_
