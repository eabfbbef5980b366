// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/rigid_motion.h"

#include "tests/codec/moving_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void expect_rotation(const Matrix3d& r) {
  EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(r.determinant(), 1, 1e-12);
}

std::vector<float> moved(const std::vector<float>& points, const Matrix3d& rotation,
                         const Vector3d& translation) {
  MovingPoints clip{1, points.size() / 3, points};
  move_frame(clip, 0, rotation, translation);
  return clip.positions;
}

TEST(RigidMotion, RecoversAMotion) {
  Noise noise(1);
  for (uint32_t seed = 1; seed <= 20; seed++) {
    const std::vector<float> points = random_points(1, 3 + seed, seed).positions;
    const Matrix3d rotation = turn(3.14 * noise.next(), {noise.next(), noise.next(), noise.next()});
    const Vector3d translation(noise.next(), noise.next(), noise.next());
    const RigidMotion fit = fit_rigid_motion(points, moved(points, rotation, translation));
    EXPECT_LT((fit.rotation - rotation).norm(), 1e-5);
    EXPECT_LT((fit.translation - translation).norm(), 1e-5);
    expect_rotation(fit.rotation);
  }
}

TEST(RigidMotion, NeverReflects) {
  const std::vector<float> points = random_points(1, 30, 2).positions;
  std::vector<float> mirrored = points;
  for (size_t i = 0; i < mirrored.size(); i += 3) {
    mirrored[i] = -mirrored[i];
  }
  expect_rotation(fit_rigid_motion(points, mirrored).rotation);
}

TEST(RigidMotion, TurnsALineTheShortestWay) {
  const std::vector<float> line = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  const std::vector<float> turned = {0, 0, 0, 0, 1, 0, 0, 2, 0};
  const RigidMotion fit = fit_rigid_motion(line, turned);
  expect_rotation(fit.rotation);
  EXPECT_LT((fit.rotation - turn(std::acos(0.0), {0, 0, 1})).norm(), 1e-6);
  EXPECT_LT((fit_rigid_motion(line, line).rotation - Matrix3d::Identity()).norm(), 1e-6);
}

TEST(RigidMotion, LeavesAPointUnturned) {
  const std::vector<float> a = {1, 2, 3};
  const std::vector<float> b = {4, 6, 8};
  const RigidMotion fit = fit_rigid_motion(a, b);
  EXPECT_EQ(fit.rotation, Matrix3d::Identity());
  EXPECT_EQ(fit.translation, Vector3d(3, 4, 5));
  EXPECT_EQ(fit_rigid_motion({}, {}).rotation, Matrix3d::Identity());
}

TEST(RigidMotion, TakesThePriorWhereNothingElseDecides) {
  const Matrix3d prior = turn(0.7, {1, 1, 0});
  EXPECT_EQ(best_rotation(Matrix3d::Zero(), prior), prior);
  // Opposite directions along a line: a half turn, about any axis across.
  expect_rotation(best_rotation(-Vector3d::UnitX() * Vector3d::UnitX().transpose()));
}

TEST(RigidMotion, FitsAPlaneWithoutReflection) {
  std::vector<float> plane = random_points(1, 12, 3).positions;
  for (size_t i = 2; i < plane.size(); i += 3) {
    plane[i] = 0;
  }
  const Matrix3d rotation = turn(2.5, {1, -2, 0.5});
  const RigidMotion fit = fit_rigid_motion(plane, moved(plane, rotation, {1, 1, 1}));
  expect_rotation(fit.rotation);
  EXPECT_LT((fit.rotation - rotation).norm(), 1e-5);
}

TEST(RigidMotion, AlignsTheFramesOfARigidClip) {
  MovingPoints clip = random_points(20, 50, 4);
  std::vector<Matrix3d> turns;
  for (size_t f = 0; f < 20; f++) {
    std::copy_n(clip.frame(0), 150, clip.frame(f));
  }
  for (size_t f = 0; f < 20; f++) {
    const double t = static_cast<double>(f);
    turns.push_back(turn(0.5 * t, {std::cos(t), 1, std::sin(t)}));
    move_frame(clip, f, turns.back(), {t, 2 * t, -t});
  }
  const auto rotations = align_frames(clip.view(), frame_centroids(clip.view()));
  for (size_t f = 0; f < 20; f++) {
    expect_rotation(rotations[f]);
    EXPECT_LT((rotations[f] - turns[f] * turns[0].transpose()).norm(), 1e-4);
  }
}

TEST(RigidMotion, AlignsWithTheSameBitsForAnyNumberOfThreads) {
  const MovingPoints clip = swinging_points(30, 3000, 4, 5, 0.1);
  const auto compute = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return align_frames(clip.view(), frame_centroids(clip.view()));
  };
  EXPECT_EQ(compute(1), compute(2));
}

}  // namespace
}  // namespace anicodec
