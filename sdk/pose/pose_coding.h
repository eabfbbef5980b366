// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Coder 2: a reference pose, predicted over the known connectivity (spec/09c-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_CODING_H_
#define ANICODEC_SDK_POSE_POSE_CODING_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"

#include <cstdint>

namespace anicodec {

/// Codes a pose of coded_vertices x 3 integers, losslessly. Any triangles do: they only serve to
/// predict. About 15 microseconds and 500 bytes per vertex.
Bytes encode_pose(const Topology& topology, const Vector<int32_t>& pose);

/// Decodes it. kEntropy when the stream is not one of encode_pose() for this topology.
Status decode_pose(ByteView stream, const Topology& topology, Vector<int32_t>* pose);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_CODING_H_
