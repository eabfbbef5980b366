// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Rotations as unit quaternions: exponential, logarithm and the best rotation between point sets.
#ifndef ANICODEC_SDK_BASE_QUATERNION_H_
#define ANICODEC_SDK_BASE_QUATERNION_H_

#include "sdk/base/vector3.h"

#include <cmath>
#include <cstddef>

namespace anicodec {

/// w + x i + y j + z k; a rotation when of unit length. q and -q are the same rotation.
struct UnitQuaternion {
  double w = 1, x = 0, y = 0, z = 0;

  UnitQuaternion conjugate() const { return {w, -x, -y, -z}; }
};

inline UnitQuaternion operator*(const UnitQuaternion& a, const UnitQuaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// A 3 x 3 matrix, row-major.
struct Matrix3 {
  double m[3][3] = {};

  /// Adds a b^T.
  void add_product(const Vector3& a, const Vector3& b) {
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j)
        m[i][j] += a[i] * b[j];
    }
  }

  friend Vector3 operator*(const Matrix3& a, const Vector3& v) {
    Vector3 r;
    for (size_t i = 0; i < 3; ++i)
      r[i] = a.m[i][0] * v[0] + a.m[i][1] * v[1] + a.m[i][2] * v[2];
    return r;
  }
};

/// The matrix of a rotation.
Matrix3 to_matrix(const UnitQuaternion& q);

/// The rotation by |v| radians about v.
UnitQuaternion exp_rotation(const Vector3& v);

/// Axis times angle, the angle in [0, pi].
Vector3 log_rotation(const UnitQuaternion& q);

/// A symmetric 4 x 4 matrix; its leading eigenvector is the quaternion of a best rotation (Horn,
/// "Closed-form solution of absolute orientation using unit quaternions", 1987).
struct RotationVotes {
  double n[4][4] = {};

  /// One more rotation, of that weight, towards their mean in the chordal sense.
  void add(const UnitQuaternion& q, double weight);

  /// The rotation that has most of the votes; identity when there are none. Quick, but for the
  /// rare votes that are almost equally good for two rotations.
  UnitQuaternion leading() const;
};

/// The votes for the rotation R that maximises the sum of (R a) . b over pairs of points, for
/// products = sum of a b^T. If the pairs leave R open (points on a line, a single point) the votes
/// lean towards the identity.
RotationVotes votes_for(const Matrix3& products);

}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_QUATERNION_H_
