// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any bytes as poses over a mesh. The first are the mesh and who follows whom.
#include "sdk/pose/pose_coding.h"

#include <cstdlib>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr size_t kHead = 4;
  if (size < kHead)
    return 0;
  Topology topology;
  topology.coded_vertices = 1U + data[0];
  const auto steps = static_cast<PoseSteps>(data[1] % 2);
  Vector<uint32_t> parents;
  for (uint32_t j = 0; j < 1U + data[2] % 4U; ++j)
    parents.push_back((data[2] >> (2 + j) & 3U) % (j + 1));
  const size_t corners = size_t{3} * data[3];
  if (size < kHead + corners)
    return 0;
  for (size_t c = 0; c < corners; ++c)
    topology.triangles.push_back(data[kHead + c] % topology.coded_vertices);
  const CornerTable table(topology);
  Vector<Vector<int32_t>> poses;
  const ByteView stream{data + kHead + corners, size - kHead - corners};
  (void)decode_poses(stream, table, steps, parents, &poses);
  require(poses.size() == parents.size());
  for (const Vector<int32_t>& pose : poses)
    require(pose.size() == size_t{3} * topology.coded_vertices);
  return 0;
}
