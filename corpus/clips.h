// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CORPUS_CLIPS_H_
#define ANICODEC_CORPUS_CLIPS_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::corpus {

struct ClipInfo {
  std::string name;
  std::string description;  ///< one line
  bool scalable;            ///< make_scaled() takes it
};

/// All clips, in a fixed order.
const std::vector<ClipInfo>& clips();

/// The names of all clips, in the order of clips().
std::vector<std::string> clip_names();

/// The clip of that name: the same bits on every machine. Throws Error(kUsage) listing the names if
/// there is none. Every clip is small: at most a few thousand vertices and a few hundred frames.
MeshSequence make_clip(std::string_view name);

/// A scalable clip with about as many vertices (at least 100; "waves": exactly as many) and exactly
/// as many frames; 0 keeps the clip's own number. More frames make it longer, not slower. Throws
/// Error(kUsage) for an unknown name or one of fixed size.
MeshSequence make_scaled(std::string_view name, uint32_t vertices, uint32_t frames);

/// A sheet of exactly `vertices` (at least 4) triangulated vertices whose frames are a rest pose
/// plus a combination of `shapes` (at most 1000) standing waves. The sum is exact in float32, so
/// that the frames span exactly `shapes` dimensions about their mean if there are more frames than
/// shapes and enough vertices to tell the waves apart. Coordinates are multiples of 2^-22. Cost:
/// about 3 * vertices * frames * shapes multiplications; no memory to speak of but the result.
/// Throws Error(kUsage) if a number is out of range.
MeshSequence make_wave_grid(uint32_t vertices, uint32_t frames, uint32_t shapes);

/// A description of all clips with the XXH64 of their positions (little-endian float32), as
/// committed in manifest.json.
std::string manifest();

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_CLIPS_H_
