// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/pose/reference_pose.h"

#include "sdk/mesh/plain_coding.h"
#include "sdk/pose/pose_coding.h"

#include <algorithm>

namespace anicodec {

uint32_t vertices_in_triangles(const Topology& topology) {
  uint32_t count = 0;
  for (uint32_t c : topology.point_vertex)
    count = std::max(count, c + 1);
  return count;
}

Status open_pose(const PoseRecord& record, const Topology& topology, const DracoMesh& draco,
                 PoseGrid* out) {
  std::copy_n(record.origin, 3, out->origin);
  out->step = record.step;
  size_t n = topology.coded_vertices;
  if (record.coder == CoderId::kPlain)
    return decode_plain_integers(record.stream, 3 * n, 3, &out->points);
  if (record.coder == CoderId::kPredictive)
    return decode_pose(record.stream, topology, &out->points);
  if (draco.components < 3)
    return Status::kSegment;
  size_t in_triangles = vertices_in_triangles(topology);
  Vector<int32_t> loose;
  if (Status s = decode_plain_integers(record.stream, 3 * (n - in_triangles), 3, &loose);
      s != Status::kOk)
    return s;
  out->points.resize(3 * n);
  for (size_t p = 0; p < topology.point_vertex.size(); ++p)
    std::copy_n(draco.values.data() + p * draco.components, 3,
                out->points.data() + size_t{3} * topology.point_vertex[p]);
  std::copy(loose.begin(), loose.end(),
            out->points.begin() + static_cast<ptrdiff_t>(3 * in_triangles));
  return Status::kOk;
}

}  // namespace anicodec
