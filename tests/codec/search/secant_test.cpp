// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/secant.h"

#include <cmath>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kAim = 0.997;
constexpr Secant::Exponent kExponent{0.75, 0.35, 1.5};

/// Trials until an outcome is within six thousandths below 1, at most 20; `scatter`: by how much
/// outcomes go up and down from one trial to the next.
int trials(double exponent, double first_outcome, double scatter = 0) {
  Secant secant(kExponent);
  double setting = 1;
  for (int n = 1; n <= 20; ++n) {
    const double outcome =
        first_outcome * std::pow(setting, exponent) * (n % 2 == 0 ? 1 + scatter : 1);
    if (outcome <= 1 && outcome >= 0.994)
      return n;
    secant.add(setting, outcome);
    setting = secant.next(kAim, 1);
  }
  return 21;
}

TEST(Secant, MeetsABoundInAFewTrialsWhateverTheExponent) {
  for (double exponent : {0.4, 0.6, 0.75, 1.0, 1.4}) {
    for (double first : {0.9, 0.98, 1.02, 1.1, 3.0})
      EXPECT_LE(trials(exponent, first), 4) << exponent << " " << first;
  }
}

TEST(Secant, BearsOutcomesThatScatter) {
  for (double first : {0.95, 1.03, 1.1})
    EXPECT_LE(trials(0.7, first, 0.004), 6) << first;
}

TEST(Secant, NeverTriesASettingAgain) {
  Secant secant(kExponent);
  double setting = 1;
  for (int n = 0; n < 8; ++n) {  // as if nothing helped
    secant.add(setting, 1.001);
    const double next = secant.next(kAim, 1);
    EXPECT_GT(std::abs(std::log(next / setting)), 1e-4);
    setting = next;
  }
}

TEST(Secant, GoesOnTowardsTheAimWhereTrialsAgree) {
  Secant secant(kExponent);
  secant.add(1, 0.9945);
  const double second = secant.next(kAim, 1);
  EXPECT_GT(second, 1);
  secant.add(second, 0.9945);
  EXPECT_GT(secant.next(kAim, 1), second);
}

TEST(Secant, TellsTheExponent) {
  Secant secant(kExponent);
  EXPECT_EQ(secant.exponent(), 0.75);
  secant.add(1, 1.5);
  const double second = secant.next(kAim, 1);
  secant.add(second, 1.5 * std::pow(second, 0.5));
  secant.next(kAim, 1);
  EXPECT_NEAR(secant.exponent(), 0.5, 1e-9);
}

TEST(Secant, GoesOnForAnotherBoundByWhatItLearnt) {
  Secant secant({0.5, 0.05, 2});
  EXPECT_TRUE(secant.empty());
  for (double fineness : {1.0, 10.0, 50.0})
    secant.add(fineness, 100 * fineness);
  EXPECT_FALSE(secant.empty());
  EXPECT_NEAR(secant.next(2000, 2000), 20, 1e-6);
  EXPECT_NEAR(secant.next(300, 300), 3, 1e-6);
}

TEST(Secant, GoesNoFurtherThanSixteenTimes) {
  Secant secant({0.5, 0.05, 2});
  secant.add(100, 10000);
  EXPECT_GT(secant.next(1, 1), 100 / 17.0);
  EXPECT_LT(secant.next(1e9, 1e9), 100 * 17.0);
}

}  // namespace
}  // namespace anicodec
