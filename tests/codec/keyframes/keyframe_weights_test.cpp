// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_weights.h"

#include "codec/keyframes/keyframe_fit.h"
#include "tests/codec/keyframes/frame_of_fit.h"
#include "tests/codec/keyframes/keyframe_testing.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr WeightConstraint kConstraints[] = {WeightConstraint::kNone, WeightConstraint::kSumToOne};

TEST(KeyframeWeights, SumToOneWhenAsked) {
  const MatrixXd gram = gram_of(swinging_points(40, 30, 6, 1, 0.1));
  const std::vector<uint32_t> keyframes = {0, 9, 18, 33};
  const FrameWeights fit = fit_weights(gram, keyframes, WeightConstraint::kSumToOne);
  for (Index f = 0; f < 40; f++) {
    EXPECT_NEAR(fit.weights.row(f).sum(), 1, 1e-12);
  }
}

TEST(KeyframeWeights, AreUnitVectorsForKeyframes) {
  const MatrixXd gram = gram_of(swinging_points(40, 30, 6, 2, 0.1));
  const std::vector<uint32_t> keyframes = {3, 4, 39};
  for (WeightConstraint constraint : kConstraints) {
    const FrameWeights fit = fit_weights(gram, keyframes, constraint);
    for (Index j = 0; j < 3; j++) {
      EXPECT_EQ(fit.weights.row(keyframes[static_cast<size_t>(j)]), Eigen::RowVectorXd::Unit(3, j));
      EXPECT_NEAR(fit.squared_errors[keyframes[static_cast<size_t>(j)]], 0, 1e-12);
    }
  }
}

TEST(KeyframeWeights, LeaveTheErrorThatTheVerticesShow) {
  for (uint32_t seed = 1; seed <= 4; seed++) {
    const MovingPoints clip = swinging_points(30, 50 * seed, 7, seed, 0.05);
    KeyframeFitter fitter(clip.view());
    for (KeyframeWeights kind :
         {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne, KeyframeWeights::kRigid}) {
      const KeyframeFit fit = fitter.fit({2, 11, 19, 27}, kind);
      for (uint32_t f = 0; f < 30; f++) {
        const auto frame = frame_of_fit(clip.view(), fit, fitter.gram().mean_position(), f);
        const double measured =
            squared_distance(frame.data(), clip.view().frame(f), clip.vertex_count);
        EXPECT_NEAR(fit.squared_errors[static_cast<Index>(f)], measured, 1e-5 * (1e-3 + measured));
      }
    }
  }
}

TEST(KeyframeWeights, CannotBeImproved) {
  const MatrixXd gram = gram_of(swinging_points(30, 40, 7, 5, 0.05));
  const std::vector<uint32_t> keyframes = {2, 11, 19, 27};
  const double free_error =
      fit_weights(gram, keyframes, WeightConstraint::kNone).squared_errors.sum();
  for (WeightConstraint constraint : kConstraints) {
    const FrameWeights fit = fit_weights(gram, keyframes, constraint);
    EXPECT_GE(fit.squared_errors.sum(), free_error * (1 - 1e-12));
    Noise noise(7);
    for (int trial = 0; trial < 20; trial++) {
      MatrixXd change = MatrixXd::NullaryExpr(30, 4, [&] { return 1e-3 * noise.next(); });
      if (constraint == WeightConstraint::kSumToOne) {
        change.colwise() -= change.rowwise().mean().eval();
      }
      const auto errors = squared_errors(gram, keyframes, fit.weights + change);
      for (Index f = 0; f < 30; f++) {
        EXPECT_GE(errors[f], fit.squared_errors[f] - 1e-12);
      }
    }
  }
}

TEST(KeyframeWeights, OfSumOneDoNotChangeWhenTheClipMoves) {
  MovingPoints clip = swinging_points(20, 40, 5, 6, 0.1);
  const std::vector<uint32_t> keyframes = {1, 8, 15};
  const auto there =
      fit_weights(frame_gram(clip.view()).clip_centred(), keyframes, WeightConstraint::kSumToOne);
  for (size_t f = 0; f < 20; f++) {
    move_frame(clip, f, Eigen::Matrix3d::Identity(), {5, -7, 3});
  }
  const auto here =
      fit_weights(frame_gram(clip.view()).clip_centred(), keyframes, WeightConstraint::kSumToOne);
  EXPECT_LT((there.weights - here.weights).norm(), 1e-4);
}

TEST(KeyframeWeights, StayFiniteForDependentKeyframes) {
  MovingPoints clip = swinging_points(20, 40, 2, 7);
  std::copy_n(clip.frame(3), 120, clip.frame(4));
  const MatrixXd gram = gram_of(clip);
  const std::vector<uint32_t> keyframes = {0, 3, 4, 8, 12, 16, 19};  // rank 3
  for (WeightConstraint constraint : kConstraints) {
    const FrameWeights fit = fit_weights(gram, keyframes, constraint);
    EXPECT_LT(fit.weights.cwiseAbs().maxCoeff(), 100);
    EXPECT_LT(fit.squared_errors.sum(), 1e-9 * gram.trace());
  }
}

TEST(KeyframeWeights, OfOneKeyframe) {
  const MatrixXd gram = gram_of(random_points(5, 10, 8));
  const std::vector<uint32_t> keyframes = {2};
  const FrameWeights fit = fit_weights(gram, keyframes, WeightConstraint::kSumToOne);
  EXPECT_EQ(fit.weights, MatrixXd::Ones(5, 1));
  const FrameWeights still = fit_weights(MatrixXd::Zero(4, 4), keyframes, WeightConstraint::kNone);
  EXPECT_EQ(still.squared_errors.sum(), 0);
}

}  // namespace
}  // namespace anicodec
