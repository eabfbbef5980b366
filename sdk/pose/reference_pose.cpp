// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/reference_pose.h"

#include <algorithm>

namespace anicodec {

Status open_pose(const PoseRecord& record, const CornerTable& table, PoseGrid* out) {
  std::copy_n(record.origin, 3, out->origin);
  out->step = record.step;
  return decode_pose(record.stream, table, PoseSteps::kDependent, &out->points);
}

}  // namespace anicodec
