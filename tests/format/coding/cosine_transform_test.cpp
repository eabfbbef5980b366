// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/cosine_transform.h"

#include "format/coding/time_weights.h"
#include "tests/random.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(CosineTransform, InvertsTheForwardTransform) {
  for (const uint32_t n : {1u, 2u, 3u, 5u, 48u, 201u, 1000u, 4096u}) {
    const CosineTransform transform(n);
    std::vector<double> x(n), y(n);
    Random random(n);
    for (double& v : x)
      v = static_cast<double>(random() % 20000) - 10000;
    transform.forward(x.data(), y.data());
    std::vector<int32_t> q(n), back(n);
    double energy = 0, error = 0, rounding = 0;
    for (uint32_t k = 0; k < n; ++k) {
      q[k] = static_cast<int32_t>(std::lround(y[k]));
      energy += x[k] * x[k] - y[k] * y[k];
      rounding += (q[k] - y[k]) * (q[k] - y[k]);
    }
    EXPECT_NEAR(energy / n, 0, 1) << n;
    transform.inverse(q.data(), back.data());
    for (uint32_t k = 0; k < n; ++k)
      error += (back[k] / 16.0 - x[k]) * (back[k] / 16.0 - x[k]);
    EXPECT_NEAR(error / n, rounding / n, 0.05) << n;
  }
}

TEST(CosineTransform, StaysWithinLimits) {
  for (const uint32_t n : {1u, 2u, 48u, CosineTransform::kMaxLength}) {
    std::vector<int32_t> y(n), x(n);
    for (const int32_t sign : {-1, 1}) {
      for (uint32_t k = 0; k < n; ++k)
        y[k] = k % 2 ? CosineTransform::kLimit : sign * CosineTransform::kLimit;
      CosineTransform(n).inverse(y.data(), x.data());
      for (const int32_t v : x)
        ASSERT_LE(std::abs(int64_t{v}), CosineTransform::kValueLimit);
    }
  }
}

}  // namespace
}  // namespace anicodec
