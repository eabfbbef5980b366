// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_DRACO_POSES_H_
#define ANICODEC_SDK_MESH_DRACO_POSES_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"

#include <cstdint>

namespace anicodec {

/// Whether this build has Draco.
bool has_draco();

/// Decodes poses that Draco predicted over a mesh (spec/07-topology.md, section 7): of each, 3
/// integers for each vertex in triangles. The mesh must split into `points` points, else kRecord;
/// kDraco for any other fault of the bytes, kFeature in a build without Draco. Never throws but for
/// memory that cannot be had: Draco's exceptions are caught here. Only this file of the decoder calls
/// Draco. It takes memory from the global heap, as much as the limits tell.
Status decode_draco_poses(ByteView bytes, const Topology& topology, uint32_t points, uint32_t poses,
                          Vector<Vector<int32_t>>* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DRACO_POSES_H_
