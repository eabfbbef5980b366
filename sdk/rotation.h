// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_ROTATION_H_
#define ANICODEC_SDK_ROTATION_H_

#include "sdk/segment.h"

namespace anicodec {

/// w, x, y, z; of length one when it is a rotation.
struct Quaternion {
  double q[4] = {1, 0, 0, 0};
};

/// The rotation of a rigid motion (Shepperd 1978). Its first three columns must be one.
Quaternion rotation_of(const Affine& motion);

/// The motion with this rotation and this translation.
Affine motion_of(const Quaternion& rotation, const double (&translation)[3]);

/// The rotation that is `weight[i]` parts of each, weights summing to one: of two, the shorter arc
/// between them at constant speed (Shoemake 1985), carried on beyond its ends too; of more, the
/// normalised sum.
Quaternion mean_rotation(const Quaternion* rotations, const double* weights, int count);

}  // namespace anicodec

#endif  // ANICODEC_SDK_ROTATION_H_
