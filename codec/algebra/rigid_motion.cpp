// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/rigid_motion.h"

#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Weight of the prior: decides what is open, below what single precision can show elsewhere.
constexpr double kPriorWeight = 1e-10;

constexpr int kMaxPasses = 6;
constexpr double kTurnTolerance = 1e-5;  // radians, about

constexpr size_t kVertexBlock = 1024;

using Shape = Eigen::Matrix3Xd;

Shape centred_frame(const FrameView& clip, const Centroids& centroids, size_t f) {
  const Eigen::Map<const Eigen::Matrix3Xf> frame(clip.frame(f), 3,
                                                 static_cast<Index>(clip.vertex_count));
  return frame.cast<double>().colwise() -
         Vector3d(centroids.row(static_cast<Index>(f)).transpose());
}

// Mean over the frames of R_f^T (x_f - c_f).
Shape mean_shape(const FrameView& clip, const Centroids& centroids,
                 const std::vector<Matrix3d>& rotations) {
  Shape mean(3, static_cast<Index>(clip.vertex_count));
  const size_t blocks = (clip.vertex_count + kVertexBlock - 1) / kVertexBlock;
  parallel_for(size_t{0}, blocks, [&](size_t b) {
    const size_t first = b * kVertexBlock;
    const size_t count = std::min(kVertexBlock, clip.vertex_count - first);
    auto out = mean.middleCols(static_cast<Index>(first), static_cast<Index>(count));
    out.setZero();
    for (size_t f = 0; f < clip.frame_count; f++) {
      const Matrix3d back = rotations[f].transpose();
      const Vector3d c = centroids.row(static_cast<Index>(f)).transpose();
      const float* p = clip.frame(f) + 3 * first;
      for (Index v = 0; v < out.cols(); v++, p += 3) {
        out.col(v) += back * (Vector3d(p[0], p[1], p[2]) - c);
      }
    }
    out /= static_cast<double>(clip.frame_count);
  });
  return mean;
}

// Turns every frame onto the shape; returns the largest change of an entry of a rotation.
double turn_onto(const Shape& shape, const FrameView& clip, const Centroids& centroids,
                 std::vector<Matrix3d>& rotations) {
  std::vector<double> change(clip.frame_count);
  parallel_for(size_t{0}, clip.frame_count, [&](size_t f) {
    const Vector3d c = centroids.row(static_cast<Index>(f)).transpose();
    const float* p = clip.frame(f);
    Matrix3d products = Matrix3d::Zero();
    for (Index v = 0; v < shape.cols(); v++, p += 3) {
      products += (Vector3d(p[0], p[1], p[2]) - c) * shape.col(v).transpose();
    }
    const Matrix3d turned = best_rotation(products, rotations[f]);
    change[f] = (turned - rotations[f]).cwiseAbs().maxCoeff();
    rotations[f] = turned;
  });
  return *std::max_element(change.begin(), change.end());
}

}  // namespace

Matrix3d best_rotation(const Matrix3d& m, const Matrix3d& prior) {
  const double size = m.norm();
  if (!(size > 0)) {
    return prior;
  }
  const Eigen::JacobiSVD<Matrix3d> svd(m / size + kPriorWeight * prior,
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) {
    u.col(2) = -u.col(2);
  }
  return u * svd.matrixV().transpose();
}

RigidMotion fit_rigid_motion(std::span<const float> source, std::span<const float> target) {
  const auto count = static_cast<Index>(source.size() / 3);
  const Shape from = Eigen::Map<const Eigen::Matrix3Xf>(source.data(), 3, count).cast<double>();
  const Shape to = Eigen::Map<const Eigen::Matrix3Xf>(target.data(), 3, count).cast<double>();
  if (count == 0) {
    return {};
  }
  const Vector3d from_centre = from.rowwise().mean();
  const Vector3d to_centre = to.rowwise().mean();
  const Shape from_shape = from.colwise() - from_centre;
  const Shape to_shape = to.colwise() - to_centre;
  RigidMotion motion;
  motion.rotation = best_rotation(to_shape * from_shape.transpose());
  motion.translation = to_centre - motion.rotation * from_centre;
  return motion;
}

std::vector<Matrix3d> align_frames(const FrameView& clip, const Centroids& centroids) {
  std::vector<Matrix3d> rotations(clip.frame_count, Matrix3d::Identity());
  turn_onto(centred_frame(clip, centroids, 0), clip, centroids, rotations);
  for (int pass = 0; pass < kMaxPasses; pass++) {
    const Shape mean = mean_shape(clip, centroids, rotations);
    if (turn_onto(mean, clip, centroids, rotations) < kTurnTolerance) {
      break;
    }
  }
  const Matrix3d first = rotations[0];
  for (Matrix3d& r : rotations) {
    r = r * first.transpose();
  }
  return rotations;
}

}  // namespace anicodec
