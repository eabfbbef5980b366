// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_count.h"

#include "tests/codec/moving_points.h"

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kNoLimit = 1e300;

TEST(KeyframeCount, IsTheFewestThatMeetTheTarget) {
  const MovingPoints clip = swinging_points(60, 40, 12, 3, 0.02);
  KeyframeFitter fitter(clip.view());
  for (KeyframeWeights kind :
       {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne, KeyframeWeights::kRigid}) {
    for (double kg : {30.0, 5.0, 2.0}) {
      const KeyframeFit fit =
          fewest_keyframes(fitter, {kg, kNoLimit}, KeyframeMethod::kPivot, kind);
      EXPECT_LE(fitter.kg(fit), kg);
      if (fit.keyframes.size() > 1) {
        const KeyframeFit fewer =
            fitter.fit(fit.keyframes.size() - 1, KeyframeMethod::kPivot, kind);
        EXPECT_GT(fitter.kg(fewer), kg);
      }
    }
  }
}

TEST(KeyframeCount, MeetsTheRmse) {
  const MovingPoints clip = swinging_points(40, 40, 8, 4, 0.02);
  KeyframeFitter fitter(clip.view());
  const KeyframeFit fit =
      fewest_keyframes(fitter, {kNoLimit, 0.05}, KeyframeMethod::kGas, KeyframeWeights::kLinear);
  EXPECT_LE(fitter.rmse(fit), 0.05);
  EXPECT_LT(fit.keyframes.size(), 40u);
}

TEST(KeyframeCount, IsOneForALooseTargetAndAllForAnImpossibleOne) {
  const MovingPoints clip = random_points(9, 40, 5);
  KeyframeFitter fitter(clip.view());
  for (KeyframeWeights kind :
       {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne, KeyframeWeights::kRigid}) {
    const auto count = [&](double kg) {
      return fewest_keyframes(fitter, {kg, kNoLimit}, KeyframeMethod::kPivot, kind)
          .keyframes.size();
    };
    EXPECT_EQ(count(1000), 1u);
    EXPECT_EQ(count(0), 9u);
  }
}

}  // namespace
}  // namespace anicodec
