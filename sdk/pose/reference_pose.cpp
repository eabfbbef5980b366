// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/reference_pose.h"

#include "sdk/mesh/plain_coding.h"

#include <algorithm>

namespace anicodec {

Status open_pose(const PoseRecord& record, const Topology& topology, const CodedValues& draco,
                 PoseSurface* surface, PoseGrid* out) {
  std::copy_n(record.origin, 3, out->origin);
  out->step = record.step;
  const size_t n = topology.coded_vertices, in_triangles = topology.vertices_in_triangles;
  if (record.coder == CoderId::kPlain)
    return decode_plain_integers(record.stream, 3 * n, 3, &out->points);
  if (record.coder == CoderId::kPredictive)
    return decode_pose(record.stream, topology, surface, &out->points);
  if (draco.components < 3)
    return Status::kSegment;
  Vector<int32_t> loose;
  if (Status s = decode_plain_integers(record.stream, 3 * (n - in_triangles), 3, &loose);
      s != Status::kOk)
    return s;
  out->points.resize(3 * n);
  for (size_t v = 0; v < in_triangles; ++v)
    std::copy_n(draco.row(v), 3, out->points.data() + 3 * v);
  std::copy(loose.begin(), loose.end(),
            out->points.begin() + static_cast<ptrdiff_t>(3 * in_triangles));
  return Status::kOk;
}

}  // namespace anicodec
