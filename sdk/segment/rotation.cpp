// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/rotation.h"

namespace anicodec {

UnitQuaternion rotation_of(const Affine& motion) {
  Matrix3 transposed;  // the products of the axes with what they turn into
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column)
      transposed.m[column][row] = double{motion.m[4 * row + column]};
  }
  return votes_for(transposed).leading();
}

Affine motion_of(const UnitQuaternion& rotation, const double (&translation)[3]) {
  const Matrix3 matrix = to_matrix(rotation);
  Affine motion;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column)
      motion.m[4 * row + column] = static_cast<float>(matrix.m[row][column]);
    motion.m[4 * row + 3] = static_cast<float>(translation[row]);
  }
  return motion;
}

UnitQuaternion mean_rotation(const UnitQuaternion* rotations, const double* weights, int count) {
  if (count == 2) {
    Vector3 turn = log_rotation(rotations[0].conjugate() * rotations[1]);
    for (size_t i = 0; i < 3; ++i)
      turn[i] *= weights[1];
    return rotations[0] * exp_rotation(turn);
  }
  RotationVotes votes;
  for (int i = 0; i < count; ++i)
    votes.add(rotations[i], weights[i]);
  return votes.leading();
}

}  // namespace anicodec
