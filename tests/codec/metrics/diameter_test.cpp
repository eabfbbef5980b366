// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/diameter.h"

#include "corpus/clips.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

double all_pairs(std::span<const float> p) {
  double most = 0;
  for (size_t i = 0; i < p.size(); i += 3) {
    for (size_t j = 0; j < i; j += 3) {
      double x = double{p[i]} - double{p[j]}, y = double{p[i + 1]} - double{p[j + 1]},
             z = double{p[i + 2]} - double{p[j + 2]};
      most = std::max(most, x * x + y * y + z * z);
    }
  }
  return std::sqrt(most);
}

TEST(Diameter, IsZeroForOnePointAndForNone) {
  EXPECT_EQ(diameter({}), 0);
  EXPECT_EQ(diameter(std::vector<float>{1, 2, 3}), 0);
  EXPECT_EQ(diameter(std::vector<float>{1, 2, 3, 1, 2, 3}), 0);
}

TEST(Diameter, IsThatOfAllPairs) {
  for (const std::string& name : corpus::clip_names()) {
    SCOPED_TRACE(name);
    MeshSequence s = corpus::make_clip(name);
    EXPECT_DOUBLE_EQ(diameter(s.frame(0)), all_pairs(s.frame(0)));
  }
}

TEST(Diameter, ManyPointsOnASphereAreNoTrouble) {
  std::vector<float> p;
  uint32_t rings = 300;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j < 2 * rings; ++j) {
      double a = M_PI * i / rings, b = M_PI * j / rings;
      for (double x : {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)})
        p.push_back(static_cast<float>(x));
    }
  }
  EXPECT_NEAR(diameter(p), 2, 1e-6);
}

}  // namespace
}  // namespace anicodec
