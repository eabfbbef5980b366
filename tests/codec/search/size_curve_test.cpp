// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/size_curve.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(SizeCurve, ExpectsAUsualSlopeFromOneTrial) {
  SizeCurve curve;
  EXPECT_TRUE(curve.empty());
  curve.add(0.01, 10000);
  EXPECT_FALSE(curve.empty());
  EXPECT_NEAR(curve.rmse_of(10000), 0.01, 1e-12);
  EXPECT_NEAR(curve.rmse_of(5000), 0.04, 1e-9);
}

TEST(SizeCurve, FollowsTheLineThroughTheTrialsNextToTheSize) {
  SizeCurve curve;
  const auto bytes = [](double rmse) { return 100 / rmse; };
  for (double rmse : {1.0, 0.1, 0.02})
    curve.add(rmse, bytes(rmse));
  EXPECT_NEAR(curve.rmse_of(bytes(0.05)), 0.05, 1e-9);
  EXPECT_NEAR(curve.rmse_of(bytes(0.3)), 0.3, 1e-9);
}

TEST(SizeCurve, IsNotMisledByTrialsThatContradictEachOtherOrAreFarAway) {
  SizeCurve curve;
  curve.add(0.010, 10000);
  curve.add(0.011, 10010);  // coarser and larger
  EXPECT_NEAR(curve.rmse_of(5000), 0.04, 0.005);
  EXPECT_NEAR(curve.rmse_of(1), 0.01 * SizeCurve::kFurthest, 0.02);
}

}  // namespace
}  // namespace anicodec
