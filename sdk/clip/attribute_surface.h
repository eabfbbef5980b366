// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_ATTRIBUTE_SURFACE_H_
#define ANICODEC_SDK_CLIP_ATTRIBUTE_SURFACE_H_

#include "sdk/clip/attribute_coding.h"
#include "sdk/mesh/topology.h"
#include "sdk/pose/reference_pose.h"

namespace anicodec {

/// The surface that the segments of an attribute are coded over in place of the mesh (spec/09a-segments.md, section 8): its
/// entries are the coded vertices, its elements the vertices. Triangles a, b, b link entries that follow one another
/// around a polygon, or of polygons those across an edge. Has no polygons. O(corners).
Topology attribute_surface(const CornerGraph& graph, AttributeDomain domain,
                           AttributeEntries entries);

/// The pose of the entries: the mean of the vertices, or of the corners of a polygon, that have each, rounded down.
/// `mesh` and `surface` are in the same order. O(corners).
PoseGrid surface_pose(const PoseGrid& pose, const Topology& mesh, AttributeDomain domain,
                      const Topology& surface);

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ATTRIBUTE_SURFACE_H_
