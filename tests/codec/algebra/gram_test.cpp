// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/gram.h"

#include "tests/codec/moving_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

void expect_distances(const FrameView& clip, double tolerance) {
  const MatrixXd gram = frame_gram(clip).clip_centred();
  for (size_t f = 0; f < clip.frame_count; f++) {
    for (size_t g = 0; g < clip.frame_count; g++) {
      const double direct = squared_distance(clip.frame(f), clip.frame(g), clip.vertex_count);
      EXPECT_NEAR(squared_distance(gram, static_cast<Index>(f), static_cast<Index>(g)), direct,
                  tolerance * (1 + direct))
          << f << " " << g;
    }
  }
}

TEST(Gram, GivesTheDistancesBetweenFrames) {
  for (uint32_t seed = 1; seed <= 8; seed++) {
    const MovingPoints clip = random_points(1 + 13 * seed % 29, 1 + 211 * (seed - 1), seed, seed);
    expect_distances(clip.view(), 1e-10);
  }
}

TEST(Gram, GivesTheDistancesOfPartsOfAClip) {
  const MovingPoints clip = random_points(20, 700, 3);
  expect_distances(clip.view().frames(4, 9), 1e-10);
  expect_distances(clip.view().frames(1, 6, 3), 1e-10);
  expect_distances(clip.view().vertices(123, 456).frames(2, 7), 1e-10);
}

TEST(Gram, GivesTheDistancesOfASmallObjectThatTravelsFar) {
  MovingPoints clip = swinging_points(12, 50, 2, 1);
  for (size_t f = 0; f < 12; f++) {
    move_frame(clip, f, Matrix3d::Identity(), {1e4 * static_cast<double>(f), 0, 0});
  }
  const FrameGram gram = frame_gram(clip.view());
  // The products of the shapes are as close: no cancellation against the travel.
  MovingPoints still = clip;
  for (size_t f = 0; f < 12; f++) {
    move_frame(still, f, Matrix3d::Identity(),
               -gram.centroids.row(static_cast<Index>(f)).transpose());
  }
  for (size_t f = 1; f < 12; f++) {
    EXPECT_NEAR(squared_distance(gram.shape, 0, static_cast<Index>(f)),
                squared_distance(still.frame(0), still.frame(f), 50), 1e-4);
  }
}

TEST(Gram, HasTheRankOfTheMotion) {
  const MovingPoints clip = swinging_points(30, 200, 3, 5);
  const MatrixXd gram = frame_gram(clip.view()).clip_centred();
  const auto values = gram.selfadjointView<Eigen::Lower>().eigenvalues();  // ascending
  EXPECT_GT(values[30 - 4], 1e-3 * values[29]);
  EXPECT_LT(values[30 - 5], 1e-10 * values[29]);
}

TEST(Gram, HasTheSameBitsForAnyNumberOfThreads) {
  const MovingPoints clip = random_points(150, 900, 7);
  const auto compute = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return frame_gram(clip.view());
  };
  const FrameGram one = compute(1);
  const FrameGram two = compute(2);
  EXPECT_EQ(one.shape, two.shape);
  EXPECT_EQ(one.centroids, two.centroids);
}

TEST(Gram, MeasuresTheReferenceOfTheKgError) {
  const MovingPoints clip = random_points(6, 40, 9, 5);
  double reference = 0;
  for (size_t f = 0; f < 6; f++) {
    const Eigen::Map<const Eigen::Matrix3Xf> frame(clip.view().frame(f), 3, 40);
    const Eigen::Matrix3Xd x = frame.cast<double>();
    reference += (x.colwise() - x.rowwise().mean()).squaredNorm();
  }
  EXPECT_NEAR(frame_gram(clip.view()).kg_reference(), reference, 1e-9 * reference);
  EXPECT_DOUBLE_EQ(kg_error(4, 1e4), 2);
  EXPECT_DOUBLE_EQ(kg_error(4, 0), 200);
  EXPECT_DOUBLE_EQ(rmse(32, 4, 2), 2);
}

TEST(Gram, TurnsFramesBackBeforeMultiplying) {
  MovingPoints clip = random_points(2, 60, 2);
  std::copy_n(clip.frame(0), 180, clip.frame(1));
  const Matrix3d rotation = turn(1.2, {1, 2, 3});
  move_frame(clip, 1, rotation, {4, 5, 6});
  const std::vector<Matrix3d> rotations = {Matrix3d::Identity(), rotation};
  const FrameGram gram = frame_gram(clip.view(), rotations);
  EXPECT_NEAR(gram.shape(0, 1), gram.shape(0, 0), 1e-4);
  EXPECT_NEAR(gram.shape(1, 1), gram.shape(0, 0), 1e-4);
}

TEST(Gram, SumsToZeroAboutTheMean) {
  const MatrixXd centred = about_mean(frame_gram(random_points(9, 30, 1, 2).view()).shape);
  EXPECT_LT(centred.rowwise().sum().cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(centred.colwise().sum().cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Gram, AcceptsASingleFrameAndASingleVertex) {
  EXPECT_EQ(frame_gram(random_points(1, 5, 1).view()).shape.rows(), 1);
  const FrameGram dot = frame_gram(random_points(4, 1, 1).view());
  EXPECT_DOUBLE_EQ(dot.shape.norm(), 0);
  EXPECT_GT(dot.clip_centred().norm(), 0);
}

void expect_block(const CrossProducts& products, const FrameView& clip, size_t f, uint32_t g) {
  const auto count = static_cast<Index>(clip.vertex_count);
  const auto centred = [&](size_t frame) {
    const Eigen::Map<const Eigen::Matrix3Xf> x(clip.frame(frame), 3, count);
    return Eigen::Matrix3Xd(x.cast<double>().colwise() -
                            Vector3d(x.cast<double>().rowwise().mean()));
  };
  const Matrix3d direct = centred(f) * centred(g).transpose();
  const Matrix3d block = products.column(g).middleRows<3>(static_cast<Index>(3 * f));
  EXPECT_LT((block - direct).norm(), 1e-9 * (1 + direct.norm())) << f << " " << g;
}

TEST(CrossProducts, EqualDirectProducts) {
  const MovingPoints clip = random_points(11, 2500, 4, 1);
  CrossProducts products(clip.view(), frame_centroids(clip.view()));
  const std::vector<uint32_t> first = {7, 2};
  const std::vector<uint32_t> second = {2, 9, 0, 9};
  products.require(first);
  products.require(second);
  for (uint32_t g : {0u, 2u, 7u, 9u}) {
    for (size_t f = 0; f < 11; f++) {
      expect_block(products, clip.view(), f, g);
    }
  }
}

TEST(CrossProducts, DropEarlierColumnsAboveTheLimit) {
  const MovingPoints clip = random_points(6, 30, 4);
  CrossProducts products(clip.view(), frame_centroids(clip.view()));
  for (uint32_t g = 0; g < 5; g++) {
    const std::vector<uint32_t> pair = {g, g + 1};
    products.require(pair, 2);
    expect_block(products, clip.view(), 3, g);
    expect_block(products, clip.view(), 1, g + 1);
  }
}

}  // namespace
}  // namespace anicodec
