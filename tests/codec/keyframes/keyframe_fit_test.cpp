// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_fit.h"

#include "tests/codec/keyframes/frame_of_fit.h"
#include "tests/codec/keyframes/keyframe_testing.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

constexpr KeyframeWeights kKinds[] = {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne,
                                      KeyframeWeights::kRigid};

// Every frame turned and moved along a path.
void set_in_motion(MovingPoints& clip) {
  for (size_t f = 0; f < clip.frame_count; f++) {
    const double t = static_cast<double>(f);
    move_frame(clip, f, turn(0.3 * t, {std::cos(0.1 * t), 1, std::sin(0.2 * t)}),
               {0.5 * t, std::sin(t), -t});
  }
}

TEST(KeyframeFit, RecoversARotatedClipFromOneKeyframe) {
  MovingPoints clip = random_points(25, 40, 1);
  for (size_t f = 1; f < 25; f++) {
    std::copy_n(clip.frame(0), 120, clip.frame(f));
  }
  set_in_motion(clip);
  KeyframeFitter fitter(clip.view());
  for (KeyframeMethod method : kMethods) {
    EXPECT_LT(fitter.kg(fitter.fit(1, method, KeyframeWeights::kRigid)), 1e-3);
    EXPECT_GT(fitter.kg(fitter.fit(1, method, KeyframeWeights::kSumToOne)), 50);
  }
}

TEST(KeyframeFit, RecoversADeformingClipInRigidMotionFromFewKeyframes) {
  MovingPoints clip = swinging_points(60, 80, 2, 2);
  set_in_motion(clip);
  KeyframeFitter fitter(clip.view());
  const double rigid = fitter.kg(fitter.fit(6, KeyframeMethod::kPivot, KeyframeWeights::kRigid));
  const double linear = fitter.kg(fitter.fit(6, KeyframeMethod::kPivot, KeyframeWeights::kLinear));
  EXPECT_LT(rigid, 0.2 * linear);
}

/// A shape and itself with a little noise, and frames far outside the line through both.
TEST(KeyframeFit, DoesNotEnlargeTheRoundingOfNearRepeats) {
  MovingPoints clip = swinging_points(30, 60, 8, 3, 0.001);
  for (size_t i = 0; i < 180; i++)
    clip.frame(20)[i] = clip.frame(4)[i] + 1e-4F * static_cast<float>(i % 7);
  KeyframeFitter fitter(clip.view());
  for (KeyframeWeights kind : kKinds) {
    const KeyframeFit alone = fitter.fit({4, 12}, kind), both = fitter.fit({4, 12, 20}, kind);
    EXPECT_LT(both.noise_gain(), 10);
    EXPECT_LT(both.squared_error(), 1.05 * alone.squared_error());
  }
}

TEST(KeyframeFit, FitsBetterWithMoreFreedom) {
  for (uint32_t seed = 1; seed <= 4; seed++) {
    MovingPoints clip = swinging_points(40, 60, 6, seed, 0.02);
    if (seed % 2 == 0) {
      set_in_motion(clip);
    }
    KeyframeFitter fitter(clip.view());
    const std::vector<uint32_t> keyframes = {3, 12, 20, 31};
    const double linear = fitter.kg(fitter.fit(keyframes, KeyframeWeights::kLinear));
    const double affine = fitter.kg(fitter.fit(keyframes, KeyframeWeights::kSumToOne));
    const double rigid = fitter.kg(fitter.fit(keyframes, KeyframeWeights::kRigid));
    EXPECT_LE(linear, affine * (1 + 1e-9));
    EXPECT_LE(rigid, affine * (1 + 1e-9));
  }
}

TEST(KeyframeFit, ReproducesKeyframes) {
  MovingPoints clip = swinging_points(30, 50, 6, 3, 0.05);
  set_in_motion(clip);
  KeyframeFitter fitter(clip.view());
  for (KeyframeWeights kind : kKinds) {
    const KeyframeFit fit = fitter.fit(5, KeyframeMethod::kPivot, kind);
    ASSERT_EQ(fit.keyframes.size(), 5u);
    for (size_t j = 0; j < 5; j++) {
      const uint32_t k = fit.keyframes[j];
      EXPECT_EQ(fit.weights.row(k), Eigen::RowVectorXd::Unit(5, static_cast<Index>(j)));
      EXPECT_NEAR(fit.squared_errors[k], 0, 1e-10);
      const auto frame = frame_of_fit(clip.view(), fit, fitter.gram().mean_position(), k);
      EXPECT_LT(squared_distance(frame.data(), clip.view().frame(k), 50), 1e-9);
    }
  }
}

TEST(KeyframeFit, AlignsKeyframesAboutTheOrigin) {
  MovingPoints clip = swinging_points(10, 50, 2, 4);
  set_in_motion(clip);
  KeyframeFitter fitter(clip.view());
  const KeyframeFit fit = fitter.fit(3, KeyframeMethod::kPivot, KeyframeWeights::kRigid);
  ASSERT_EQ(fit.motions.size(), 10u);
  for (uint32_t k : fit.keyframes) {
    std::vector<float> aligned = aligned_frame(clip.view(), k, fit.motions[k]);
    const Eigen::Map<const Eigen::Matrix3Xf> points(aligned.data(), 3, 50);
    EXPECT_LT(points.rowwise().mean().norm(), 1e-5F);
    MovingPoints back{1, 50, aligned};
    move_frame(back, 0, fit.motions[k].rotation, fit.motions[k].translation);
    EXPECT_LT(squared_distance(back.frame(0), clip.frame(k), 50), 1e-8);
  }
}

TEST(KeyframeFit, IsExactWithAllFrames) {
  MovingPoints clip = swinging_points(8, 30, 7, 5, 0.1);
  KeyframeFitter fitter(clip.view());
  for (KeyframeMethod method : kMethods) {
    for (KeyframeWeights kind : kKinds) {
      EXPECT_LT(fitter.kg(fitter.fit(8, method, kind)), 1e-4);
    }
  }
}

TEST(KeyframeFit, AcceptsDegenerateClips) {
  MovingPoints still = random_points(6, 10, 6);
  for (size_t f = 1; f < 6; f++) {
    std::copy_n(still.frame(0), 30, still.frame(f));
  }
  const MovingPoints clips[] = {random_points(1, 4, 1), random_points(5, 1, 2),
                                random_points(4, 2, 3), std::move(still),
                                MovingPoints{3, 4, std::vector<float>(36, 0.0F)}};
  for (const MovingPoints& clip : clips) {
    KeyframeFitter fitter(clip.view());
    for (KeyframeMethod method : kMethods) {
      for (KeyframeWeights kind : kKinds) {
        const KeyframeFit fit = fitter.fit(clip.frame_count, method, kind);
        ASSERT_FALSE(fit.keyframes.empty());
        EXPECT_TRUE(fit.weights.allFinite());
        EXPECT_LT(fitter.rmse(fit), 1e-5);
        EXPECT_TRUE(fitter.fit(1, method, kind).weights.allFinite());
      }
    }
  }
}

TEST(KeyframeFit, IsTheSameForAnyNumberOfThreads) {
  MovingPoints clip = swinging_points(70, 300, 8, 7, 0.05);
  set_in_motion(clip);
  for (KeyframeWeights kind : kKinds) {
    const auto compute = [&](size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return KeyframeFitter(clip.view()).fit(9, KeyframeMethod::kGas, kind);
    };
    const KeyframeFit one = compute(1);
    const KeyframeFit two = compute(2);
    EXPECT_EQ(one.keyframes, two.keyframes);
    EXPECT_EQ(one.weights, two.weights);
    EXPECT_EQ(one.squared_errors, two.squared_errors);
    for (size_t f = 0; f < one.motions.size(); f++) {
      EXPECT_EQ(one.motions[f].rotation, two.motions[f].rotation);
    }
  }
}

}  // namespace
}  // namespace anicodec
