// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Poses, predicted over the known connectivity (spec/09b-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_CODING_H_
#define ANICODEC_SDK_POSE_POSE_CODING_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"
#include "sdk/pose/partners.h"
#include "sdk/pose/surface_growth.h"

#include <cstdint>

namespace anicodec {

/// The tables for the poses of a mesh that follow from its connectivity alone.
struct PoseSurface {
  /// The topology must outlive it. O(triangles).
  explicit PoseSurface(const Topology& topology)
      : table(topology.coded_vertices, topology.triangles), order(growth_order(table)) {}

  CornerTable table;
  Vector<uint32_t> order;  ///< in which vertices are coded
};

/// The largest coordinate, in magnitude, that encode_poses() takes.
constexpr int32_t kMaxPoseCoordinate = 1 << 22;

/// Codes poses of vertices x 3 integers, losslessly, in one stream: each by itself or by one before
/// it, of which it is a later moment. Any triangles do: they only serve to predict. About 1
/// microsecond per vertex and pose.
///   parents   for each pose 0, or one more than the number of an earlier pose
///   partners  vertices that those without a parent can be told by; null: nobody
/// @pre along each axis, in the order of the surface, entries fit DependentSteps if `coding` says so
Bytes encode_poses(const PoseSurface& surface, PoseCoding coding,
                   const Vector<Vector<int32_t>>& poses, const Vector<uint32_t>& parents,
                   const PosePartners* partners = nullptr);

/// Decodes them. kEntropy when the stream is not one of encode_poses() for this surface and parents.
Status decode_poses(ByteView stream, const PoseSurface& surface, PoseCoding coding,
                    const Vector<uint32_t>& parents, Vector<Vector<int32_t>>* poses);

/// The same of a single pose.
Bytes encode_pose(const PoseSurface& surface, PoseCoding coding, const Vector<int32_t>& pose,
                  const PosePartners* partners = nullptr);
Status decode_pose(ByteView stream, const PoseSurface& surface, PoseCoding coding,
                   Vector<int32_t>* pose);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_CODING_H_
