// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FORMAT_THREE_FRAMES_H_
#define ANICODEC_TESTS_FORMAT_THREE_FRAMES_H_

#include "format/records.h"

namespace anicodec {

/// Limits of a file of one mesh of four vertices, with one segment of three frames.
inline Limits three_frames() {
  Limits limits;
  limits.frames = 3;
  Limits::Mesh mesh;
  mesh.source_vertices = mesh.coded_vertices = 4;
  limits.meshes.push_back(mesh);
  Limits::Segment segment;
  segment.kind = BasisKind::kEigentrajectories;
  segment.frames = 3;
  limits.segments.push_back(segment);
  return limits;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FORMAT_THREE_FRAMES_H_
