// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Poses, predicted over the known connectivity (spec/09b-reference-pose.md).
#ifndef ANICODEC_SDK_POSE_POSE_CODING_H_
#define ANICODEC_SDK_POSE_POSE_CODING_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/pose/corner_table.h"
#include "sdk/pose/partners.h"

#include <cstdint>

namespace anicodec {

/// The largest coordinate, in magnitude, that encode_poses() takes.
constexpr int32_t kMaxPoseCoordinate = 1 << 22;

/// The coordinates that a pose may have: any, or along each axis those that DependentSteps allow from vertex
/// to vertex, which is a finer grid for the bits.
enum class PoseSteps : uint8_t { kAny, kDependent };

/// Codes poses of vertices x 3 integers, losslessly, vertex after vertex in one stream: each pose by
/// itself or by one before it, of which it is a later moment. Any triangles do: they only serve to
/// predict. About 0.6 microseconds per vertex and pose.
///   parents   for each pose 0, or one more than the number of an earlier pose
///   partners  vertices that those without a parent can be told by; null: nobody
Bytes encode_poses(const CornerTable& table, PoseSteps steps, const Vector<Vector<int32_t>>& poses,
                   const Vector<uint32_t>& parents, const PosePartners* partners = nullptr);

/// Decodes them. kEntropy when the stream is not one of encode_poses() for this table and parents.
Status decode_poses(ByteView stream, const CornerTable& table, PoseSteps steps,
                    const Vector<uint32_t>& parents, Vector<Vector<int32_t>>* poses);

/// The same of a single pose.
Bytes encode_pose(const CornerTable& table, PoseSteps steps, const Vector<int32_t>& pose,
                  const PosePartners* partners = nullptr);
Status decode_pose(ByteView stream, const CornerTable& table, PoseSteps steps,
                   Vector<int32_t>* pose);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_POSE_CODING_H_
