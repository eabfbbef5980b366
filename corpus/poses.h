// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Pairs of poses that straight lines cannot connect (thesis section 4.3): clips of two frames.
#ifndef ANICODEC_CORPUS_POSES_H_
#define ANICODEC_CORPUS_POSES_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace anicodec::corpus {

/// bend: a cylinder and the same bent by two turns; twist: the cylinder twisted by two turns about
/// its axis; coil: wound up into two and a half turns of a helix; needles: the bent cylinder of
/// triangles 43 times as long as wide.
const std::vector<std::string_view>& pose_names();

/// About as many vertices; 0 stands for 7000. Coordinates are float32 as the mathematics
/// library has them. Throws Error(kUsage) for an unknown name or fewer than 200 vertices.
MeshSequence make_poses(std::string_view name, uint32_t vertices = 0);

}  // namespace anicodec::corpus

#endif  // ANICODEC_CORPUS_POSES_H_
