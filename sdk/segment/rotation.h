// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_ROTATION_H_
#define ANICODEC_SDK_SEGMENT_ROTATION_H_

#include "sdk/base/quaternion.h"
#include "sdk/segment/segment.h"

namespace anicodec {

/// The rotation of a rigid motion.
UnitQuaternion rotation_of(const Affine& motion);

/// The motion with this rotation and this translation.
Affine motion_of(const UnitQuaternion& rotation, const double (&translation)[3]);

/// The rotation that is weights[i] parts of each, weights summing to one: of two, on the shorter
/// arc between them at constant speed (Shoemake 1985), carried on beyond its ends too; of more,
/// their mean in the chordal sense.
UnitQuaternion mean_rotation(const UnitQuaternion* rotations, const double* weights, int count);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_ROTATION_H_
