// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/motion_products.h"

#include "codec/algebra/gram.h"
#include "codec/motion/frame_products.h"
#include "codec/motion/motion_sketch.h"
#include "codec/motion/vertex_products.h"
#include "tests/codec/moving_points.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Points that move by some functions of time, each less than the one before.
std::vector<float> smooth_points(size_t frames, size_t vertices, size_t functions) {
  const std::vector<float> shapes = noise_values(3 * vertices * functions, 4);
  std::vector<float> x(3 * frames * vertices);
  for (size_t f = 0; f < frames; ++f)
    for (size_t i = 0; i < 3 * vertices; ++i) {
      double sum = 0;
      for (size_t k = 0; k < functions; ++k) {
        const double t = static_cast<double>(f * (k + 1)) / static_cast<double>(frames);
        sum += std::cos(9 * t + static_cast<double>(k % 7)) *
               std::exp(-0.4 * static_cast<double>(k)) *
               static_cast<double>(shapes[k * 3 * vertices + i]);
      }
      x[3 * f * vertices + i] = static_cast<float>(sum);
    }
  return x;
}

class Products : public testing::Test {
 protected:
  Products(size_t frames, size_t vertices)
      : x_(smooth_points(frames, vertices, 20)), view_(x_.data(), frames, vertices) {
    const Centroids centroids = frame_centroids(view_);
    origin_ = centroids.colwise().mean().transpose();
    sums_ = static_cast<double>(vertices) *
            (centroids.rowwise() - origin_.transpose()).transpose().reshaped();
    pose_.resize(static_cast<Index>(vertices), 3);
    for (Index i = 0; i < pose_.size(); ++i)
      pose_(i / 3, i % 3) = static_cast<double>(view_.frame(3)[i]) - origin_[i % 3];
    MatrixXd functions(pose_.rows(), 4);
    functions << VectorXd::Ones(pose_.rows()), pose_;
    span_ = functions.householderQr().householderQ() * MatrixXd::Identity(pose_.rows(), 4);
    by_frames_ = std::make_unique<const FrameProducts>(view_, origin_, sums_);
  }

  /// The same energies, and the same space in time.
  static void expect_near(const TimeComponents& actual, const TimeComponents& expected,
                          double tolerance) {
    EXPECT_NEAR(actual.base_energy, expected.base_energy, tolerance * expected.base_energy);
    ASSERT_EQ(actual.energies.size(), expected.energies.size());
    const Index count = actual.energies.size();
    ASSERT_GT(count, 4);
    EXPECT_LT((actual.energies - expected.energies).cwiseAbs().maxCoeff(),
              tolerance * expected.energies[0]);
    EXPECT_LT((actual.time.transpose() * actual.time - MatrixXd::Identity(count, count))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-4);
    EXPECT_NEAR((expected.time.transpose() * actual.time).squaredNorm(), static_cast<double>(count),
                1e-2);
  }

  void expect_same(const MotionProducts& products, double tolerance) const {
    EXPECT_NEAR(products.energy(), by_frames_->energy(), 1e-9 * by_frames_->energy());
    const double smallest = 1e-7 * products.energy();
    for (const auto kind : {BasisKind::kEigentrajectories, BasisKind::kEigenshapes})
      expect_near(products.beyond_span(kind, span_, 12, smallest),
                  by_frames_->beyond_span(kind, span_, 12, smallest), tolerance);
    expect_near(products.beyond_pose(pose_, 12, smallest),
                by_frames_->beyond_pose(pose_, 12, smallest), tolerance);
    const VectorXd energies = products.frame_energies(10),
                   expected = by_frames_->frame_energies(10);
    ASSERT_EQ(energies.size(), 10);
    EXPECT_LT((energies - expected).cwiseAbs().maxCoeff(), tolerance * expected[0]);
    const MatrixXd leading = products.leading_trajectories(3);
    ASSERT_EQ(leading.cols(), 3);
    EXPECT_NEAR((by_frames_->leading_trajectories(3).transpose() * leading).squaredNorm(), 3, 1e-3);
  }

  std::vector<float> x_;
  FrameView view_;
  Vector3d origin_;
  VectorXd sums_;
  MatrixXd pose_, span_;
  std::unique_ptr<const FrameProducts> by_frames_;
};

class ProductsOfFewVertices : public Products {
 protected:
  ProductsOfFewVertices() : Products(200, 70) {}
};

TEST_F(ProductsOfFewVertices, AreThoseOfAllFrames) {
  const VertexProducts products(view_, origin_, VectorXd::Ones(70), 70);
  expect_same(products, 1e-9);
  EXPECT_EQ(products.best_frame(), by_frames_->best_frame());
}

class ProductsOfMany : public Products {
 protected:
  ProductsOfMany() : Products(150, 600) {}
};

TEST_F(ProductsOfMany, AreNearlyThoseOfASketch) {
  const MotionSketch sketch(view_, origin_, sums_);
  expect_same(sketch, 1e-6);
  EXPECT_EQ(sketch.best_frame(), by_frames_->best_frame());
}

TEST(MotionProducts, AcceptOneVertexAndAStillClip) {
  const std::vector<float> one = noise_values(3 * 20, 2), still(3 * 20 * 5, 1.5F);
  const FrameView clips[] = {FrameView(one.data(), 20, 1), FrameView(still.data(), 20, 5)};
  for (const FrameView& clip : clips) {
    const auto vertices = static_cast<Index>(clip.vertex_count);
    const Vector3d origin = frame_centroids(clip).colwise().mean().transpose();
    const MatrixXd span =
        VectorXd::Constant(vertices, 1 / std::sqrt(static_cast<double>(vertices)));
    const VectorXd sums = VectorXd::Zero(60);
    const MotionSketch sketch(clip, origin, sums);
    const std::unique_ptr<const MotionProducts> exact = motion_products(clip, origin, sums);
    for (const MotionProducts* products :
         {exact.get(), static_cast<const MotionProducts*>(&sketch)}) {
      const TimeComponents components =
          products->beyond_span(BasisKind::kEigentrajectories, span, 9, 0);
      EXPECT_EQ(components.energies.size(), 0);
      EXPECT_NEAR(components.base_energy, 0, 1e-9);
    }
  }
}

TEST(MotionProducts, HaveAllOfNoiseByASketch) {
  const std::vector<float> noise = noise_values(size_t{3} * 60 * 44, 7);
  const FrameView clip(noise.data(), 60, 44);
  const MotionSketch sketch(clip, Vector3d::Zero(), VectorXd::Zero(180));
  const MatrixXd span = VectorXd::Constant(44, 1 / std::sqrt(44.0));
  for (const BasisKind kind : {BasisKind::kEigentrajectories, BasisKind::kEigenshapes}) {
    const TimeComponents components = sketch.beyond_span(kind, span, 60, 0);
    EXPECT_NEAR(components.energies.sum(), components.base_energy, 1e-5 * components.base_energy);
  }
}

TEST(MotionProducts, AcceptNoVertices) {
  const FrameView clip(nullptr, 7, 0);
  const auto products = motion_products(clip, Vector3d::Zero(), VectorXd::Zero(21));
  const TimeComponents components =
      products->beyond_span(BasisKind::kEigentrajectories, MatrixXd(0, 0), 9, 0);
  EXPECT_EQ(components.energies.size(), 0);
  EXPECT_EQ(components.base_energy, 0);
}

}  // namespace
}  // namespace anicodec
