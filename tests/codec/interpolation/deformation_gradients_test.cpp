// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/deformation_gradients.h"

#include "codec/surface/closest_point.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(DeformationGradients, DecomposeIntoRotationAndStretch) {
  for (double angle : {0.0, 0.4, 2.9, std::numbers::pi}) {
    const Vector3d turn = angle * Vector3d(1, 2, -2).normalized();
    Matrix3d stretch;
    stretch << 2, 0.3, 0.1, 0.3, 1, -0.2, 0.1, -0.2, 0.5;
    const RotationAndStretch parts = decompose(exponential(turn) * stretch);
    EXPECT_LE((exponential(parts.turn) * parts.stretch - exponential(turn) * stretch).norm(),
              1e-12);
    EXPECT_LE((parts.stretch - stretch).norm(), 1e-12);
    EXPECT_LE(std::abs(parts.turn.norm() - angle), 1e-7);
  }
}

TEST(DeformationGradients, DecomposeAMirroredMatrixIntoAProperRotation) {
  const Matrix3d mirrored = Vector3d(1, 2, -0.5).asDiagonal();
  const RotationAndStretch parts = decompose(mirrored);
  EXPECT_LE((exponential(parts.turn) * parts.stretch - mirrored).norm(), 1e-12);
  EXPECT_LT(parts.stretch.determinant(), 0);
}

TEST(DeformationGradients, LogarithmsFollowTheirNeighbours) {
  const Vector3d axis = Vector3d(1, 1, 0).normalized();
  const double turn = 2 * std::numbers::pi;
  EXPECT_LE((nearest_logarithm(0.2 * axis, (turn + 0.1) * axis) - (turn + 0.2) * axis).norm(),
            1e-12);
  EXPECT_LE((nearest_logarithm(0.2 * axis, -turn * axis) - (0.2 - turn) * axis).norm(), 1e-12);
  EXPECT_LE((nearest_logarithm(Vector3d::Zero(), turn * axis) - turn * axis).norm(), 1e-12);
  EXPECT_EQ(nearest_logarithm(Vector3d::Zero(), Vector3d::Zero()), Vector3d::Zero());
}

}  // namespace
}  // namespace anicodec
