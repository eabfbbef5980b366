// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_MESH_WORK_H_
#define ANICODEC_SDK_CLIP_MESH_WORK_H_

#include "format/records.h"
#include "format/status.h"
#include "sdk/mesh/topology.h"
#include "sdk/pose/reference_pose.h"
#include "sdk/segment/segment.h"

#include <cstdint>
#include <optional>

namespace anicodec {

/// The pose of a mesh, and the last order of its vertices by it.
struct MeshPose {
  PoseGrid grid;
  SharedOrder order;
};

/// Work that the segments of an attribute share until they are open.
struct AttributeWork {
  uint32_t attribute = 0;
  Limits::Mesh sizes;
  PoseGrid pose;
  MeshGraph graph;
  SharedOrder order;
};

/// Data of a mesh that its segments use while they open. All that follows from the connectivity alone
/// is made once, so that no segment costs O(triangles); a lone segment keeps nothing of it.
struct MeshWork {
  uint32_t predicted_segments = 0;     ///< of the limits
  std::optional<CornerTable> corners;  ///< for the poses
  std::optional<MeshGraph> graph;      ///< of the orders of vertices
  Vector<AttributeWork> attributes;    ///< only moving ones, in the order of their first segments

  bool is_shared() const { return predicted_segments > 1; }

  /// After a pose: the corners go when no other can need them.
  void end_pose() {
    if (!is_shared())
      corners.reset();
  }

  /// The corners, made for the first pose. The topology must outlive them.
  const CornerTable& corner_table(const Topology& topology) {
    if (!corners)
      corners.emplace(topology);
    return *corners;
  }

  /// The graph, made now if it is shared; null if not.
  Status shared_graph(const Topology& topology, const MeshGraph** out) {
    *out = nullptr;
    if (!is_shared())
      return Status::kOk;
    if (!graph) {
      graph.emplace();
      if (Status s = graph->init(topology.triangles.data(), topology.triangles.size() / 3,
                                 topology.coded_vertices);
          s != Status::kOk)
        return s;
    }
    *out = &*graph;
    return Status::kOk;
  }
};

/// Whether a segment is predicted over the surface of its mesh: all that Draco did not code.
inline bool is_predicted(const Limits::Segment& segment) {
  return segment.kind != BasisKind::kKeyframes || segment.draco_bytes == 0;
}

/// By mesh: how many of the segments of its positions are predicted.
inline Vector<uint32_t> predicted_segments(const Limits& limits) {
  Vector<uint32_t> counts(limits.meshes.size(), 0);
  for (const Limits::Segment& s : limits.segments)
    counts[s.mesh] += s.attribute == kPositions && is_predicted(s);
  return counts;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_MESH_WORK_H_
