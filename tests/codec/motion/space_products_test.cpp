// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/space_products.h"

#include "codec/algebra/gram.h"
#include "codec/motion/frame_products.h"
#include "tests/codec/moving_points.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr size_t kFrames = 60, kVertices = 90;
constexpr Index kComponents = 12;

/// Noise over a few functions of time that move far.
class SpaceProductsTest : public testing::Test {
 protected:
  SpaceProductsTest() : x_(noise_values(3 * kFrames * kVertices, 1)) {
    const std::vector<float> shapes = noise_values(3 * kVertices * kComponents, 2);
    const std::vector<float> times = noise_values(kFrames * kComponents, 3);
    for (size_t f = 0; f < kFrames; ++f)
      for (size_t i = 0; i < 3 * kVertices; ++i) {
        x_[3 * f * kVertices + i] *= 0.01F;
        for (size_t k = 0; k < kComponents; ++k)
          x_[3 * f * kVertices + i] += times[f * kComponents + k] * shapes[k * 3 * kVertices + i] /
                                       static_cast<float>(k + 1);
      }
    view_ = FrameView(x_.data(), kFrames, kVertices);
    const Centroids centroids = frame_centroids(view_);
    origin_ = centroids.colwise().mean().transpose();
    const VectorXd sums = static_cast<double>(kVertices) *
                          (centroids.rowwise() - origin_.transpose()).transpose().reshaped();
    whole_ = std::make_unique<const FrameProducts>(view_, origin_, sums);
    const MatrixXd functions = MatrixXd::Random(static_cast<Index>(kVertices), 4);
    span_ = functions.householderQr().householderQ() *
            MatrixXd::Identity(static_cast<Index>(kVertices), 4);
  }

  SpaceProducts in(MatrixXd space) const {
    return {view_, origin_, std::make_shared<const MatrixXd>(std::move(space))};
  }

  std::vector<float> x_;
  FrameView view_;
  Vector3d origin_;
  std::unique_ptr<const FrameProducts> whole_;
  MatrixXd span_;
};

TEST_F(SpaceProductsTest, HaveTheComponentsOfTheClipInTheSpaceOfAllTrajectories) {
  const auto all = static_cast<Index>(3 * kFrames);
  const SpaceProducts products = in(MatrixXd::Identity(all, all));
  const TimeComponents found = products.beyond_span(span_, kComponents, 0);
  const TimeComponents expected =
      whole_->beyond_span(BasisKind::kEigentrajectories, span_, kComponents, 0);
  EXPECT_NEAR(found.base_energy, expected.base_energy, 1e-9 * expected.base_energy);
  ASSERT_EQ(found.energies.size(), kComponents);
  EXPECT_LT((found.energies - expected.energies).norm(), 1e-9 * expected.energies.norm());
  const MatrixXd both = found.time.transpose() * expected.time;
  EXPECT_LT((both * both.transpose() - MatrixXd::Identity(kComponents, kComponents)).norm(), 1e-6);
  EXPECT_NEAR(
      (products.leading_trajectories(3).transpose() * whole_->leading_trajectories(3)).norm(),
      std::sqrt(3.0), 1e-6);
}

TEST_F(SpaceProductsTest, ComeNearWithinTheLeadingTrajectories) {
  const MatrixXd space = whole_->space_of_trajectories(3 * kComponents);
  ASSERT_LE(space.cols(), 3 * kComponents + 16);  // whole blocks
  EXPECT_LT((space.transpose() * space - MatrixXd::Identity(space.cols(), space.cols())).norm(),
            1e-9);
  const TimeComponents found = in(space).beyond_span(span_, kComponents, 0);
  const TimeComponents expected =
      whole_->beyond_span(BasisKind::kEigentrajectories, span_, kComponents, 0);
  for (Index k = 0; k < kComponents; ++k) {
    EXPECT_LE(found.energies[k], expected.energies[k] * (1 + 1e-9));
    EXPECT_GT(found.energies[k], expected.energies[k] * 0.9);
  }
  EXPECT_LT(
      (found.time.transpose() * found.time - MatrixXd::Identity(kComponents, kComponents)).norm(),
      1e-9);
}

TEST_F(SpaceProductsTest, HaveNothingWithoutVertices) {
  view_ = view_.vertices(0, 0);
  const auto all = static_cast<Index>(3 * kFrames);
  const SpaceProducts products = in(MatrixXd::Identity(all, all));
  EXPECT_EQ(products.beyond_span(MatrixXd(0, 4), kComponents, 0).energies.size(), 0);
}

}  // namespace
}  // namespace anicodec
