// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_
#define ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "sdk/mesh/topology.h"

#include <cstdint>
#include <span>

namespace anicodec {

/// Poses as Draco codes them over a mesh that it is not to code.
struct DracoPoses {
  Bytes bytes;          ///< empty: Draco could not
  uint32_t points = 0;  ///< of the mesh, split where it is not manifold
};

/// Largest number of poses that one bitstream may carry.
inline constexpr size_t kMaxDracoPoses = 1 + 63 * 85;

/// Codes poses, each of coded vertices x 3 integers, of which those in triangles are held. Draco
/// takes neither meshes without triangles nor more than kMaxDracoPoses poses.
///
/// Cost: Draco counts symbols in tables as long as coordinates differ, of which draco_symbol_bytes() tells the bytes.
DracoPoses encode_draco_poses(const Topology& topology, std::span<const Vector<int32_t>> poses);

/// About the bytes of Draco's tables of symbols, for poses of so many points whose coordinates differ by at most `span`.
double draco_symbol_bytes(double points, size_t poses, double span);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_CONNECTIVITY_DRACO_ENCODE_H_
