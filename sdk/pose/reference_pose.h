// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_REFERENCE_POSE_H_
#define ANICODEC_SDK_POSE_REFERENCE_POSE_H_

#include "format/memory.h"
#include "format/records.h"
#include "sdk/mesh/draco_mesh.h"
#include "sdk/mesh/topology.h"

#include <cstdint>

namespace anicodec {

/// A pose of the coded vertices on an integer grid: origin + step * point. The order of the
/// vertices, the weights of the prediction and the base of the frames come from it.
struct PoseGrid {
  double origin[3] = {0, 0, 0};
  double step = 1;
  Vector<int32_t> points;  ///< coded vertices x 3
};

/// Coded vertices that are in a triangle: they come first, the loose ones follow.
uint32_t vertices_in_triangles(const Topology& topology);

/// Decodes a reference pose (spec/09a-segments.md).
Status open_pose(const PoseRecord& record, const Topology& topology, const DracoMesh& draco,
                 PoseGrid* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_REFERENCE_POSE_H_
