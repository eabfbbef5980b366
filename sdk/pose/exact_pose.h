// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_EXACT_POSE_H_
#define ANICODEC_SDK_POSE_EXACT_POSE_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "sdk/pose/corner_table.h"
#include "sdk/pose/partners.h"

#include <cstdint>

namespace anicodec {

/// Codes a pose of any vertices x 3 integers, telling first of each whether it is exactly that of a
/// neighbour or a parallelogram, as in shapes built along the axes. decode_pose() reads it as one with
/// PoseSteps::kDependent: the stream says which of the two it is.
Bytes encode_exact_pose(const CornerTable& table, const Vector<int32_t>& pose,
                        const PosePartners* partners = nullptr);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_EXACT_POSE_H_
