// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/affine_functions.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

std::vector<int32_t> cloud(bool flat) {
  std::vector<int32_t> p;
  uint32_t seed = 4;
  for (int v = 0; v < 200; ++v)
    for (int d = 0; d < 3; ++d) {
      seed = seed * 1664525 + 1013904223;
      const auto x = static_cast<int32_t>(seed >> 20);
      // y leans on x; a flat cloud has z = 3x - y.
      p.push_back(d == 1           ? 2 * p[p.size() - 1] + x
                  : d == 2 && flat ? 3 * p[p.size() - 2] - p[p.size() - 1]
                                   : x - 100000);
    }
  return p;
}

TEST(AffineFunctions, AreOrthonormalOverTheVertices) {
  for (const bool flat : {false, true}) {
    const std::vector<int32_t> pose = cloud(flat);
    const AffineFunctions f = AffineFunctions::of(pose.data(), 200);
    double products[4][4] = {};
    for (size_t v = 0; v < 200; ++v) {
      const double p[] = {double(pose[3 * v]), double(pose[3 * v + 1]), double(pose[3 * v + 2])};
      double b[4];
      f.evaluate(p, b);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          products[i][j] += b[i] * b[j];
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        EXPECT_NEAR(products[i][j], i == j && !(flat && i == 3) ? 1 : 0, 1e-9) << i << j;
  }
}

TEST(AffineFunctions, MapAsTheirWeightsSay) {
  const std::vector<int32_t> pose = cloud(false);
  const AffineFunctions f = AffineFunctions::of(pose.data(), 200);
  const double weights[3][4] = {{1, 2, -3, 0.5}, {0, 1, 0, 0}, {-7, 0.1, 0.2, 0.3}};
  double map[12];
  f.map(weights, map);
  const double p[] = {123, -4567, 89};
  double b[4];
  f.evaluate(p, b);
  for (size_t axis = 0; axis < 3; ++axis) {
    double expected = 0;
    for (size_t i = 0; i < 4; ++i)
      expected += weights[axis][i] * b[i];
    const double* m = map + 4 * axis;
    EXPECT_NEAR(m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], expected, 1e-9);
  }
}

TEST(AffineFunctions, ExistForEveryPose) {
  EXPECT_EQ(AffineFunctions::of(nullptr, 0).constant, 0);
  const std::vector<int32_t> point = {5, 6, 7, 5, 6, 7};
  const AffineFunctions f = AffineFunctions::of(point.data(), 2);
  for (const auto& row : f.inverse)
    for (const double x : row)
      EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace anicodec
