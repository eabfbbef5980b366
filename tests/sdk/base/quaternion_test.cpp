// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/quaternion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

Vector3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  double x = uniform(random), y = uniform(random), z = uniform(random);
  return {{x, y, z}};
}

double distance(const UnitQuaternion& a, const UnitQuaternion& b) {
  double d = std::fabs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z);
  return std::acos(std::min(1.0, d));
}

TEST(Quaternion, LogarithmUndoesExponential) {
  std::mt19937 random(1);
  for (double size : {1e-13, 1e-9, 1e-4, 1.0, 1.8}) {
    Vector3 v = random_vector(random, size);
    EXPECT_LE(length(log_rotation(exp_rotation(v)) - v), 1e-14 + 1e-14 * size) << size;
  }
  Vector3 half{{0, std::numbers::pi, 0}};
  EXPECT_NEAR(length(log_rotation(exp_rotation(half))), std::numbers::pi, 1e-12);
}

TEST(Quaternion, FindsTheRotationBetweenPoints) {
  std::mt19937 random(2);
  for (double angle : {0.0, 0.3, std::numbers::pi / 2, 3.0, std::numbers::pi}) {
    for (double flat : {1.0, 1e-3, 0.0}) {
      Vector3 axis = random_vector(random, 1);
      UnitQuaternion q = exp_rotation((angle / length(axis)) * axis);
      Matrix3 turn = to_matrix(q), products;
      for (int i = 0; i < 20; ++i) {
        Vector3 a = random_vector(random, 1);
        a[2] *= flat;
        products.add_product(a, turn * a);
      }
      EXPECT_LE(distance(votes_for(products).leading(), q), 1e-6) << angle << " " << flat;
    }
  }
}

TEST(Quaternion, TurnsALineOntoALine) {
  Vector3 from{{0, 0, 2}}, to{{0, -2, 0}};
  Matrix3 products;
  products.add_product(from, to);
  Vector3 turned = to_matrix(votes_for(products).leading()) * from;
  EXPECT_LE(length(turned - to), 1e-6);
}

TEST(Quaternion, LeavesPointsWithoutExtentAlone) {
  EXPECT_EQ(std::fabs(votes_for(Matrix3{}).leading().w), 1);
  EXPECT_EQ(RotationVotes{}.leading().w, 1);
}

TEST(Quaternion, AveragesVotesByWeight) {
  RotationVotes votes;
  votes.add(exp_rotation({{0.2, 0, 0}}), 3);
  UnitQuaternion minus = exp_rotation({{0.6, 0, 0}});
  votes.add({-minus.w, -minus.x, -minus.y, -minus.z}, 3);
  EXPECT_LE(distance(votes.leading(), exp_rotation({{0.4, 0, 0}})), 1e-7);
}

}  // namespace
}  // namespace anicodec
