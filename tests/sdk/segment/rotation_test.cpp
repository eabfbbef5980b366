// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/rotation.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

/// Radians between two rotations.
double angle(const UnitQuaternion& a, const UnitQuaternion& b) {
  return length(log_rotation(a.conjugate() * b));
}

UnitQuaternion random_rotation(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector3 axis{{uniform(random), uniform(random), uniform(random)}};
  return exp_rotation((std::numbers::pi * std::fabs(uniform(random)) / length(axis)) * axis);
}

TEST(Rotation, ComesBackFromItsMotion) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const UnitQuaternion q = random_rotation(random);
    const double translation[3] = {1, -2.5, 1e4};
    const Affine motion = motion_of(q, translation);
    for (size_t r = 0; r < 3; ++r)
      EXPECT_EQ(motion.m[4 * r + 3], static_cast<float>(translation[r]));
    EXPECT_LE(angle(rotation_of(motion), q), 1e-6);
  }
  for (size_t axis = 0; axis < 3; ++axis) {  // half turns
    Vector3 half;
    half[axis] = std::numbers::pi;
    EXPECT_LE(angle(rotation_of(motion_of(exp_rotation(half), {0, 0, 0})), exp_rotation(half)),
              1e-6);
  }
}

TEST(Rotation, MeanOfTwoTurnsTheShorterWayAtConstantSpeed) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    UnitQuaternion ends[2] = {random_rotation(random), random_rotation(random)};
    const double whole = angle(ends[0], ends[1]);
    if (i % 2)  // the same rotation
      ends[1] = {-ends[1].w, -ends[1].x, -ends[1].y, -ends[1].z};
    for (double t : {0.0, 0.1, 0.5, 0.8, 1.0}) {
      const double weights[2] = {1 - t, t};
      const UnitQuaternion mean = mean_rotation(ends, weights, 2);
      EXPECT_NEAR(angle(ends[0], mean), t * whole, 1e-7);
      EXPECT_NEAR(angle(mean, ends[1]), (1 - t) * whole, 1e-7);
    }
  }
}

TEST(Rotation, MeanOfTwoGoesOnBeyondItsEnds) {
  const UnitQuaternion ends[2] = {exp_rotation({{0, 0.2, 0}}), exp_rotation({{0, 0.5, 0}})};
  const double weights[2] = {-0.5, 1.5};
  EXPECT_LE(angle(mean_rotation(ends, weights, 2), exp_rotation({{0, 0.65, 0}})), 1e-12);
}

TEST(Rotation, MeanOfFourLeansTowardsItsWeights) {
  // Weights of a cubic curve half-way between the middle ones.
  const double weights[4] = {-1 / 16.0, 9 / 16.0, 9 / 16.0, -1 / 16.0};
  UnitQuaternion turning[4];
  for (int i = 0; i < 4; ++i)
    turning[i] = exp_rotation({{0, 0, 0.3 * i - 0.45}});
  EXPECT_LE(angle(mean_rotation(turning, weights, 4), {}), 1e-7);
  turning[2] = {-turning[2].w, -turning[2].x, -turning[2].y, -turning[2].z};
  EXPECT_LE(angle(mean_rotation(turning, weights, 4), {}), 1e-7);
  const double one[3] = {0, 1, 0};
  EXPECT_LE(angle(mean_rotation(turning, one, 3), turning[1]), 1e-7);
}

}  // namespace
}  // namespace anicodec
