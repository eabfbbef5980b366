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
#include "sdk/pose/surface_growth.h"

#include <cstdint>
#include <optional>

namespace anicodec {

/// What the poses of a mesh take from its connectivity alone. Made with the first of them, so that
/// each takes O(vertices), however many triangles there are.
struct PoseSurface {
  struct Made {
    CornerTable table;
    Vector<uint32_t> order;
    CornerMarks marks;
  };

  std::optional<Made> made;
};

/// Codes a pose of coded_vertices x 3 integers, losslessly. Any triangles do: they only serve to
/// predict. About 15 microseconds and 500 bytes per vertex.
Bytes encode_pose(const Topology& topology, const Vector<int32_t>& pose);

/// Decodes it. kEntropy when the stream is not one of encode_pose() for this topology. `surface` is
/// of the topology, which must outlive it.
Status decode_pose(ByteView stream, const Topology& topology, PoseSurface* surface,
                   Vector<int32_t>* pose);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_CODING_H_
