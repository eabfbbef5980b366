// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/step_search.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kAim = 0.997;

/// Trials until an error is within three thousandths below the one asked for, at most 20; `scatter`:
/// by how much errors go up and down from one trial to the next.
int trials(double slope, double first_ratio, double scatter = 0) {
  StepSearch search(kAim, 0.75);
  double step = 1;
  for (int n = 1; n <= 20; ++n) {
    const double ratio = first_ratio * std::pow(step, slope) * (n % 2 == 0 ? 1 + scatter : 1);
    if (ratio <= 1 && ratio >= 0.994)
      return n;
    step = search.next(step, ratio);
  }
  return 21;
}

TEST(StepSearch, MeetsAnErrorInAFewTrialsWhateverTheSlope) {
  for (double slope : {0.4, 0.6, 0.75, 1.0, 1.4}) {
    for (double first : {0.9, 0.98, 1.02, 1.1, 3.0})
      EXPECT_LE(trials(slope, first), 4) << slope << " " << first;
  }
}

TEST(StepSearch, BearsErrorsThatScatter) {
  for (double first : {0.95, 1.03, 1.1})
    EXPECT_LE(trials(0.7, first, 0.004), 6) << first;
}

TEST(StepSearch, NeverTriesAStepAgain) {
  StepSearch search(kAim, 0.75);
  double step = 1;
  for (int n = 0; n < 8; ++n) {  // as if nothing helped
    const double next = search.next(step, 1.001);
    EXPECT_GT(std::abs(std::log(next / step)), 1e-4);
    step = next;
  }
}

TEST(StepSearch, GoesOnTowardsTheErrorWhereTrialsAgree) {
  StepSearch search(kAim, 0.75);
  const double second = search.next(1, 0.9945);
  EXPECT_GT(second, 1);
  EXPECT_GT(search.next(second, 0.9945), second);
}

TEST(StepSearch, TellsTheSlope) {
  StepSearch search(kAim, 0.75);
  const double step = search.next(1, 1.5);
  search.next(step, 1.5 * std::pow(step, 0.5));
  EXPECT_NEAR(search.slope(), 0.5, 1e-9);
}

}  // namespace
}  // namespace anicodec
