// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_SHADER_DATA_H_
#define ANICODEC_SDK_PLAY_SHADER_DATA_H_

#include "sdk/play/play.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Textures of a basis: four numbers a texel, of float32, int32 and int16. The fourth of a pose is the
/// vertex' region.
enum class BasisTexture : uint8_t { kPose = 0, kWide = 1, kNarrow = 2 };

size_t texel_bytes(BasisTexture texture);

/// Layers of texels below one another, a texel for each vertex. Components come in groups of four: a
/// layer for a group of numbers, three for one of vectors.
struct TextureLayout {
  uint32_t width = 0;  ///< texels of a row
  uint32_t rows = 0;   ///< of a layer

  /// The layout of fewest texels whose sides are at most max_size. False when there is none.
  static bool find(const Segment& segment, uint32_t max_size, TextureLayout* out);

  /// Whether a layer holds the segment's vertices, with no row too many.
  bool holds(const Segment& segment) const;

  /// Rows of a texture; 0: the segment has none.
  uint32_t height(const Segment& segment, BasisTexture texture) const;
};

/// Writes a texture, a row each `stride` bytes, ascending. Cost: O(bytes).
void write_texture(const Segment& segment, BasisTexture texture, const TextureLayout& layout,
                   size_t stride, void* out);

/// Floats of write_state(): for each region 28 and the weights, in whole groups.
size_t state_floats(const Segment& segment);

/// Writes what a shader needs of a state: maps (the origin in the first one), counts of groups, share,
/// corrections, weights; so for each region, one after another. Cost: O(regions x components).
void write_state(const FrameState& state, float share, float* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_SHADER_DATA_H_
