// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/base/float_control.h"

#include <cfenv>
#include <limits>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(FloatControl, RoundsToNearestAndThenAsBefore) {
  volatile float one = 1, little = std::numeric_limits<float>::epsilon() / 4;
  std::fesetround(FE_UPWARD);
  float within;
  {
    const FloatControl control;
    within = one + little;
  }
  const float after = one + little;
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(within, 1);
  EXPECT_GT(after, 1);
}

#if defined(__SSE2__)
TEST(FloatControl, KeepsSubnormalNumbersAndThenAsBefore) {
  volatile float least = std::numeric_limits<float>::min();
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // flushes results, and takes operands for 0
  float within;
  {
    const FloatControl control;
    within = least * 0.5F;
  }
  const float after = least * 0.5F;
  _mm_setcsr(before);
  EXPECT_GT(within, 0);
  EXPECT_EQ(after, 0);
}
#endif

}  // namespace
}  // namespace anicodec
