// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_POSE_PARTNERS_H_
#define ANICODEC_CODEC_SEGMENT_POSE_PARTNERS_H_

#include "sdk/pose/partners.h"
#include "sdk/pose/pose_coding.h"

#include <Eigen/Core>

namespace anicodec {

/// Finds parts of a pose (vertices x 3, any unit) that repeat or mirror one another: components
/// against earlier ones, then the surface against its own mirror image.
/// Both grow from a triangle over the surface as long as each vertex is where its partner says,
/// whatever the diagonals of quads are. Empty if nothing is alike. Bounded: about 10 microseconds
/// per vertex.
PosePartners find_partners(const Eigen::MatrixXd& pose, const CornerTable& table);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_POSE_PARTNERS_H_
