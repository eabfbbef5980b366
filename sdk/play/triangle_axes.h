// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_TRIANGLE_AXES_H_
#define ANICODEC_SDK_PLAY_TRIANGLE_AXES_H_

#include "sdk/base/vector3.h"

namespace anicodec {

/// Axes of length 1 in and on a triangle, whatever its shape.
struct TriangleAxes {
  Vector3 normal;   ///< the corners run counter-clockwise around it
  Vector3 tangent;  ///< from corner 0 to corner 1

  explicit TriangleAxes(const Vector3 (&corners)[3]);
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_TRIANGLE_AXES_H_
