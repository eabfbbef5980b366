// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_basis.h"

#include "codec/algebra/trajectory_gram.h"
#include "tests/codec/moving_points.h"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

MatrixXd residual(const MatrixXd& x, const LinearBasis& basis) {
  MatrixXd rest = x;
  if (basis.base == Base::kAffine) {
    MatrixXd functions(x.cols(), 4);
    functions << VectorXd::Ones(x.cols()), basis.pose;
    const Eigen::JacobiSVD<MatrixXd> svd(functions, Eigen::ComputeThinU);
    rest -= (x * svd.matrixU()) * svd.matrixU().transpose();
  } else {
    for (Index r = 0; r < x.rows(); ++r)
      rest.row(r) -= basis.pose.col(r % 3).transpose();
  }
  return rest;
}

MatrixXd as_frames(const MatrixXd& trajectories) {
  MatrixXd out(trajectories.rows() / 3, 3 * trajectories.cols());
  for (Index r = 0; r < trajectories.rows(); ++r)
    for (Index v = 0; v < trajectories.cols(); ++v)
      out(r / 3, 3 * v + r % 3) = trajectories(r, v);
  return out;
}

TEST(LinearBasis, HasOrthonormalComponentsWithTheEnergiesOfTheClip) {
  const size_t frames = 17, n = 301;
  const std::vector<float> x = affine_points(frames, n);
  const LinearAnalysis analysis(FrameView(x.data(), frames, n));
  for (const auto pose : {ReferencePose::kMean, ReferencePose::kFrame, ReferencePose::kRankThree})
    for (const auto base : {Base::kPose, Base::kAffine})
      for (const auto kind : {BasisKind::kEigenshapes, BasisKind::kEigentrajectories}) {
        if (kind == BasisKind::kEigentrajectories && base == Base::kPose)
          continue;
        const LinearBasis b = analysis.basis(kind, pose, base, 1000, 1e-7);
        MatrixXd rest = residual(trajectories(x, frames, b.origin), b);
        if (kind == BasisKind::kEigenshapes)
          rest = as_frames(rest);
        EXPECT_NEAR(b.base_energy, rest.squaredNorm(), 1e-9 * b.base_energy + 1e-7);
        const Index k = b.energies.size();
        ASSERT_GT(k, 2);
        EXPECT_LT((b.time.transpose() * b.time - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(),
                  1e-10);
        const VectorXd singular = Eigen::JacobiSVD<MatrixXd>(rest).singularValues();
        for (Index j = 0; j < k; ++j) {
          EXPECT_NEAR(b.energies[j], singular[j] * singular[j], 1e-8 * b.energies[0]);
          EXPECT_NEAR((rest.transpose() * b.time.col(j)).squaredNorm(), b.energies[j],
                      1e-8 * b.energies[0]);
        }
      }
}

TEST(LinearBasis, KnowsTheReferenceOfTheKgError) {
  const size_t frames = 5, n = 40;
  const std::vector<float> x = affine_points(frames, n);
  const LinearAnalysis analysis(FrameView(x.data(), frames, n));
  MatrixXd rows = trajectories(x, frames, Vector3d::Zero());
  rows.colwise() -= rows.rowwise().mean().eval();
  EXPECT_NEAR(analysis.kg_reference(), rows.squaredNorm(), 1e-9 * rows.squaredNorm());
}

TEST(LinearBasis, LeavesNothingOfAnAffineMotion) {
  const size_t frames = 6, n = 50;
  const std::vector<float> p = noise_values(3 * n, 5);
  std::vector<float> x;
  for (size_t f = 0; f < frames; ++f)
    for (size_t v = 0; v < n; ++v)
      for (size_t c = 0; c < 3; ++c)
        x.push_back(p[3 * v + c] * (1 + 0.1f * static_cast<float>(f)) +
                    0.2f * static_cast<float>(f) * p[3 * v + (c + 1) % 3]);
  const LinearAnalysis analysis(FrameView(x.data(), frames, n));
  const LinearBasis b =
      analysis.basis(BasisKind::kEigentrajectories, ReferencePose::kFrame, Base::kAffine, 10, 1e-6);
  EXPECT_LT(b.base_energy, 1e-6);
  EXPECT_EQ(b.energies.size(), 0);
}

TEST(LinearBasis, AcceptsFlatAndStillClips) {
  std::vector<float> x = affine_points(4, 30);
  for (size_t i = 2; i < x.size(); i += 3)
    x[i] = 7;
  const LinearAnalysis flat(FrameView(x.data(), 4, 30));
  const std::vector<float> still(4 * 30 * 3, 2.5f);
  const LinearAnalysis constant(FrameView(still.data(), 4, 30));
  for (const auto pose : {ReferencePose::kMean, ReferencePose::kFrame, ReferencePose::kRankThree}) {
    const auto kind = BasisKind::kEigentrajectories;
    EXPECT_TRUE(flat.basis(kind, pose, Base::kAffine, 9, 1e-9).time.allFinite());
    const LinearBasis b = constant.basis(kind, pose, Base::kAffine, 9, 1e-9);
    EXPECT_TRUE(b.pose.allFinite());
    EXPECT_EQ(b.energies.size(), 0);
  }
}

TEST(LinearBasis, IsTheSameForAnyNumberOfThreads) {
  const size_t frames = 30, n = 3000;
  const std::vector<float> x = affine_points(frames, n);
  const auto make = [&] {
    const LinearAnalysis analysis(FrameView(x.data(), frames, n));
    return analysis.basis(BasisKind::kEigentrajectories, ReferencePose::kRankThree, Base::kAffine,
                          20, 0);
  };
  const LinearBasis many = make();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LinearBasis single = make();
  EXPECT_EQ(many.energies, single.energies);
  EXPECT_EQ(many.time, single.time);
  EXPECT_EQ(many.pose, single.pose);
}

}  // namespace
}  // namespace anicodec
