// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/bit_cost.h"

#include "format/coding/binary_coder.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(BitCost, IsTheLogarithm) {
  for (uint32_t p = 1; p <= 65536; ++p)
    ASSERT_NEAR(bit_cost(p) / 65536.0, -std::log2(p / 65536.0), 0.001) << p;
}

}  // namespace
}  // namespace anicodec
