// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_selection.h"

#include "codec/keyframes/keyframe_weights.h"
#include "tests/codec/keyframes/keyframe_testing.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::MatrixXd;

constexpr KeyframeSpan kSpans[] = {KeyframeSpan::kLinear, KeyframeSpan::kAffine};

double error_of(const MatrixXd& gram, const std::vector<uint32_t>& keyframes, KeyframeSpan span) {
  return fit_weights(
             gram, keyframes,
             span == KeyframeSpan::kAffine ? WeightConstraint::kSumToOne : WeightConstraint::kNone)
      .squared_errors.sum();
}

TEST(KeyframeSelection, ReturnsDistinctFramesAscending) {
  const MatrixXd gram = gram_of(swinging_points(50, 40, 8, 1, 0.05));
  for (KeyframeMethod method : kMethods) {
    for (KeyframeSpan span : kSpans) {
      for (size_t count : {1u, 3u, 20u, 50u}) {
        const auto frames = select_keyframes(gram, count, method, span);
        EXPECT_EQ(frames.size(), count);
        EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end()));
        EXPECT_EQ(std::set<uint32_t>(frames.begin(), frames.end()).size(), count);
        EXPECT_LT(frames.back(), 50u);
      }
    }
  }
}

TEST(KeyframeSelection, PivotReproducesAClipOfLowRankWithAsManyFrames) {
  const MatrixXd gram = gram_of(swinging_points(60, 50, 5, 2));
  const double all = gram.trace();
  for (KeyframeSpan span : kSpans) {
    const auto frames = select_keyframes(gram, 6, KeyframeMethod::kPivot, span);
    EXPECT_LT(error_of(gram, frames, span), 1e-9 * all);
    EXPECT_GT(error_of(gram, select_keyframes(gram, 4, KeyframeMethod::kPivot, span), span),
              1e-4 * all);
  }
}

TEST(KeyframeSelection, PivotIsNoWorseThanUniformAndExchangesOnlyHelp) {
  for (uint32_t seed = 1; seed <= 6; seed++) {
    const MatrixXd gram = gram_of(swinging_points(70, 40, 12, seed, 0.02));
    for (KeyframeSpan span : kSpans) {
      const auto pivot = select_keyframes(gram, 7, KeyframeMethod::kPivot, span);
      const auto uniform = select_keyframes(gram, 7, KeyframeMethod::kUniform, span);
      EXPECT_LE(error_of(gram, pivot, span), error_of(gram, uniform, span));
    }
    std::vector<uint32_t> frames = {0, 1, 2, 3, 40, 41, 42};
    const double before = error_of(gram, frames, KeyframeSpan::kLinear);
    exchange_keyframes(gram, frames);
    EXPECT_LT(error_of(gram, frames, KeyframeSpan::kLinear), before);
    // No exchange of the first key-frame pays any more.
    const double after = error_of(gram, frames, KeyframeSpan::kLinear);
    EXPECT_EQ(std::set<uint32_t>(frames.begin(), frames.end()).size(), 7u);
    std::vector<uint32_t> again = frames;
    exchange_keyframes(gram, again);
    EXPECT_LE(error_of(gram, again, KeyframeSpan::kLinear), after * (1 + 1e-9));
  }
}

TEST(KeyframeSelection, TakesNoMoreFramesThanAreOfUse) {
  MovingPoints clip = random_points(15, 20, 3);
  for (size_t f = 0; f < 15; f++) {
    std::copy_n(clip.frame(f % 3), 60, clip.frame(f));
  }
  const MatrixXd gram = gram_of(clip);
  for (KeyframeMethod method : kMethods) {
    for (KeyframeSpan span : kSpans) {
      EXPECT_EQ(select_keyframes(gram, 10, method, span).size(), 3u);
    }
  }
}

TEST(KeyframeSelection, AlwaysReturnsAFrame) {
  for (KeyframeMethod method : kMethods) {
    for (KeyframeSpan span : kSpans) {
      EXPECT_THAT(select_keyframes(MatrixXd::Zero(5, 5), 3, method, span),
                  testing::SizeIs(1));  // one point that stays
      EXPECT_THAT(select_keyframes(MatrixXd::Identity(1, 1), 1, method, span),
                  testing::ElementsAre(0));
    }
  }
}

TEST(KeyframeSelection, UniformTakesTheMiddlesOfEqualParts) {
  const MatrixXd gram = gram_of(random_points(20, 10, 4));
  EXPECT_THAT(select_keyframes(gram, 4, KeyframeMethod::kUniform),
              testing::ElementsAre(2, 7, 12, 17));
  EXPECT_THAT(select_keyframes(gram, 1, KeyframeMethod::kUniform), testing::ElementsAre(10));
}

/// Frames that repeat every five but for a little noise.
TEST(KeyframeSelection, UniformPassesNearRepeatsOverWhileItsPartHasOthers) {
  MovingPoints clip = random_points(20, 30, 4);
  for (size_t f = 5; f < 20; f++) {
    for (size_t i = 0; i < 90; i++)
      clip.frame(f)[i] = clip.frame(f % 5)[i] + 1e-3F * static_cast<float>(i % 3);
  }
  const auto frames = select_keyframes(gram_of(clip), 4, KeyframeMethod::kUniform);
  EXPECT_EQ(frames.size(), 4u);
  std::set<uint32_t> phases;
  for (uint32_t f : frames)
    phases.insert(f % 5);
  EXPECT_EQ(phases.size(), 4u);
}

TEST(KeyframeSelection, IsTheSameForAnyNumberOfThreads) {
  const MatrixXd gram = gram_of(swinging_points(90, 30, 9, 5, 0.1));
  for (KeyframeMethod method : kMethods) {
    const auto compute = [&](size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return select_keyframes(gram, 12, method);
    };
    EXPECT_EQ(compute(1), compute(2));
  }
}

}  // namespace
}  // namespace anicodec
