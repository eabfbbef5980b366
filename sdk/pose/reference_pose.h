// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_REFERENCE_POSE_H_
#define ANICODEC_SDK_POSE_REFERENCE_POSE_H_

#include "format/memory.h"
#include "format/records.h"
#include "sdk/pose/pose_coding.h"

#include <cstdint>

namespace anicodec {

/// A pose of the coded vertices on an integer grid: origin + step * point. The order of the
/// vertices, the weights of the prediction and the base of the frames come from it.
struct PoseGrid {
  double origin[3] = {0, 0, 0};
  double step = 1;
  Vector<int32_t> points;  ///< coded vertices x 3
};

/// Decodes a reference pose (spec/09b-reference-pose.md). O(coded vertices).
Status open_pose(const PoseRecord& record, const CornerTable& table, PoseGrid* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_REFERENCE_POSE_H_
