// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_
#define ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_

#include "format/bytes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// Largest number of poses (three integers per point) that one bitstream may carry: 63 generic
/// attributes of at most 85 poses, and the POSITION attribute. Draco 1.5.5 wraps silently above 255
/// components of an attribute and fails above about 129 attributes.
inline constexpr size_t kMaxDracoPoses = 1 + 63 * 85;

/// Integer components per point of a bitstream with so many poses: a stand-in follows a lone pose.
constexpr uint32_t draco_components(size_t poses) {
  return poses > 1 ? static_cast<uint32_t>(3 * poses) : 4;
}

/// Encodes a manifold triangle mesh with edgebreaker; every pose is rows x 3 int32, and point p has
/// row rows[p] of each. Without a pose a constant POSITION attribute stands in. An empty result
/// means that Draco could not. `points_by_decoded[d]` is the point that a decoder returns as its
/// d-th, if wanted. The triangles come back in another order, each with its corners rotated.
Bytes encode_draco_mesh(uint32_t points, std::span<const uint32_t> triangles,
                        std::span<const Vector<int32_t>> poses, std::span<const uint32_t> rows,
                        std::vector<uint32_t>* points_by_decoded = nullptr);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_
