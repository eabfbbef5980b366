// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A reference pose, predicted over the known connectivity (spec/09b-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_CODING_H_
#define ANICODEC_SDK_POSE_POSE_CODING_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"
#include "sdk/pose/surface_growth.h"

#include <cstdint>

namespace anicodec {

/// What the poses of a mesh take from its connectivity alone.
struct PoseSurface {
  /// The topology must outlive it. O(triangles).
  explicit PoseSurface(const Topology& topology)
      : table(topology.coded_vertices, topology.triangles), order(growth_order(table)) {}

  CornerTable table;
  Vector<uint32_t> order;  ///< in which vertices are coded
};

/// The largest coordinate, in magnitude, that encode_pose() takes.
constexpr int32_t kMaxPoseCoordinate = 1 << 22;

/// Codes a pose of vertices x 3 integers, losslessly. Any triangles do: they only serve to predict.
/// About 1 microsecond per vertex.
/// @pre along each axis, in the order of the surface, entries fit DependentSteps if `coding` says so
Bytes encode_pose(const PoseSurface& surface, PoseCoding coding, const Vector<int32_t>& pose);

/// Decodes it. kEntropy when the stream is not one of encode_pose() for this surface.
Status decode_pose(ByteView stream, const PoseSurface& surface, PoseCoding coding,
                   Vector<int32_t>* pose);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_CODING_H_
