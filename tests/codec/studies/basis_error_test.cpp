// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/studies/basis_error.h"

#include "tests/codec/moving_points.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

TEST(BasisError, HasARowPerMethodAndCount) {
  const MovingPoints clip = swinging_points(20, 30, 6, 1, 0.05);
  KeyframeFitter fitter(clip.view());
  const size_t counts[] = {1, 5, 20, 21};
  const auto rows = basis_errors(fitter, counts);
  EXPECT_EQ(rows.size(), 3 * 12u);
  std::set<std::string> seen;
  for (const BasisError& row : rows) {
    seen.insert(row.method);
    EXPECT_NEAR(row.rmse * 100, row.kg * std::sqrt(fitter.gram().kg_reference() / 600), 1e-6);
    EXPECT_TRUE(row.k < 20 || row.kg < 1e-4);
  }
  EXPECT_EQ(seen.size(), 12u);
  EXPECT_EQ(basis_errors(fitter, counts, false).size(), 3 * 8u);
}

TEST(BasisError, OfPrincipalComponentsIsALowerBound) {
  for (uint32_t seed = 1; seed <= 3; seed++) {
    const MovingPoints clip = swinging_points(40, 50, 10, seed, 0.05);
    KeyframeFitter fitter(clip.view());
    const size_t counts[] = {2, 4, 8};
    std::map<std::pair<std::string, size_t>, double> kg;
    for (const BasisError& row : basis_errors(fitter, counts)) {
      kg[{row.method, row.k}] = row.kg;
    }
    for (size_t k : counts) {
      EXPECT_LE((kg[{"pca-mean", k}]), (kg[{"pca", k}]) * (1 + 1e-9));
      for (const char* method : {"gas", "pivot", "uniform"}) {
        EXPECT_LE((kg[{"pca", k}]), (kg[{std::string(method) + "-linear", k}]));
      }
    }
  }
}

TEST(BasisError, OfAllComponentsIsZero) {
  const MovingPoints clip = swinging_points(12, 20, 3, 2);
  KeyframeFitter fitter(clip.view());
  const auto errors = principal_errors(fitter.products(KeyframeWeights::kLinear));
  ASSERT_EQ(errors.size(), 13u);
  EXPECT_EQ(errors.back(), 0);
  EXPECT_NEAR(errors[0], fitter.products(KeyframeWeights::kLinear).trace(), 1e-9 * errors[0]);
  EXPECT_LT(errors[4], 1e-9 * errors[0]);
}

}  // namespace
}  // namespace anicodec
