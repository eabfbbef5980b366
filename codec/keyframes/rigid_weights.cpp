// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/rigid_weights.h"

#include "codec/algebra/rigid_motion.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <limits>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxTurns = 10;   // of weights and rotation of one frame
constexpr int kMaxRounds = 12;  // of all frames and the key-frames' rotations

// Turns and rounds go on while they lower the error by this part of itself.
constexpr double kTurnProgress = 1e-3;
constexpr double kRoundProgress = 1e-3;

// The problem for fixed rotations of the key-frames.
class RigidFitter {
 public:
  RigidFitter(const CrossProducts& products, std::span<const uint32_t> keyframes,
              const MatrixXd& shape_gram, WeightConstraint constraint, double noise,
              RigidWeights& fit)
      : products_(products),
        keyframes_(keyframes),
        shape_gram_(shape_gram),
        constraint_(constraint),
        noise_(noise),
        keyframe_of_(fit.rotations.size(), -1),
        fit_(fit) {
    for (size_t j = 0; j < keyframes.size(); j++) {
      keyframe_of_[keyframes[j]] = static_cast<Index>(j);
    }
  }

  // Weights and rotations of all frames but the key-frames'.
  void fit_frames() {
    const Index keys = key_count();
    MatrixXd key_gram(keys, keys);
    for (Index i = 0; i < keys; i++) {
      const uint32_t k = keyframes_[static_cast<size_t>(i)];
      key_gram.col(i) = blocks(static_cast<Index>(k)) * fit_.rotations[k].reshaped();
    }
    key_gram = (key_gram + key_gram.transpose().eval()) / 2;
    const WeightSolver solver(key_gram, constraint_, noise_);
    parallel_for(Index{0}, shape_gram_.rows(), [&](Index f) {
      const Index key = keyframe_of_[static_cast<size_t>(f)];
      if (key >= 0) {
        fit_.weights.row(f) = Eigen::RowVectorXd::Unit(keys, key);
        fit_.squared_errors[f] = 0;
      } else {
        fit_frame(f, solver, key_gram);
      }
    });
  }

  // Turns each key-frame to where, in the given combinations, it serves the frames best.
  void turn_keyframes() {
    const Index keys = key_count();
    std::vector<Matrix3d>& rotations = fit_.rotations;
    MatrixXd use = fit_.weights;  // of the frames that are not key-frames themselves
    for (uint32_t k : keyframes_) {
      use.row(k).setZero();
    }
    const MatrixXd overlap = use.transpose() * use;
    for (Index j = 0; j < keys; j++) {
      const uint32_t k = keyframes_[static_cast<size_t>(j)];
      const auto column = products_.column(k);
      Matrix3d wanted = Matrix3d::Zero();
      for (Index f = 0; f < use.rows(); f++) {
        wanted +=
            use(f, j) * rotations[static_cast<size_t>(f)].transpose() * column.middleRows<3>(3 * f);
      }
      for (Index i = 0; i < keys; i++) {
        if (i != j) {
          const uint32_t other = keyframes_[static_cast<size_t>(i)];
          wanted -= overlap(i, j) * rotations[other].transpose() *
                    column.middleRows<3>(3 * static_cast<Index>(other));
        }
      }
      rotations[k] = best_rotation(wanted.transpose(), rotations[k]);
    }
  }

 private:
  Index key_count() const { return static_cast<Index>(keyframes_.size()); }

  // Row j: the nine entries of C_fk R_k for key-frame j. Their product with R_f is that of the
  // frame turned back with the aligned key-frame.
  MatrixXd blocks(Index f) const {
    MatrixXd result(key_count(), 9);
    for (Index j = 0; j < key_count(); j++) {
      const uint32_t k = keyframes_[static_cast<size_t>(j)];
      const Matrix3d m = products_.column(k).middleRows<3>(3 * f) * fit_.rotations[k];
      result.row(j) = m.reshaped().transpose();
    }
    return result;
  }

  void fit_frame(Index f, const WeightSolver& solver, const MatrixXd& key_gram) {
    const MatrixXd turned = blocks(f);
    Matrix3d rotation = fit_.rotations[static_cast<size_t>(f)];
    double error = std::numeric_limits<double>::max();
    for (int turn = 0; turn < kMaxTurns; turn++) {
      const VectorXd right = turned * rotation.reshaped();
      const VectorXd w = solver.solve(right);
      const double now = std::max(0.0, shape_gram_(f, f) - 2 * right.dot(w) + w.dot(key_gram * w));
      if (!(now < error)) {
        return;
      }
      fit_.weights.row(f) = w.transpose();
      fit_.squared_errors[f] = now;
      fit_.rotations[static_cast<size_t>(f)] = rotation;
      if (now > error * (1 - kTurnProgress)) {
        return;
      }
      error = now;
      const VectorXd sum = turned.transpose() * w;
      rotation = best_rotation(Eigen::Map<const Matrix3d>(sum.data()), rotation);
    }
  }

  const CrossProducts& products_;
  std::span<const uint32_t> keyframes_;
  const MatrixXd& shape_gram_;
  WeightConstraint constraint_;
  double noise_;
  std::vector<Index> keyframe_of_;  // per frame: which key-frame it is, or -1
  RigidWeights& fit_;
};

}  // namespace

RigidWeights fit_rigid_weights(const CrossProducts& products, std::span<const uint32_t> keyframes,
                               std::span<const Matrix3d> rotations, const MatrixXd& shape_gram,
                               WeightConstraint constraint, double noise) {
  const Index frames = shape_gram.rows();
  RigidWeights fit;
  fit.weights.resize(frames, static_cast<Index>(keyframes.size()));
  fit.squared_errors.resize(frames);
  fit.rotations.assign(rotations.begin(), rotations.end());
  RigidFitter fitter(products, keyframes, shape_gram, constraint, noise, fit);
  fitter.fit_frames();
  for (int round = 0; round < kMaxRounds; round++) {
    const RigidWeights last_fit = fit;
    fitter.turn_keyframes();
    fitter.fit_frames();
    const double old = last_fit.squared_errors.sum();
    const double now = fit.squared_errors.sum();
    if (!(now < old)) {
      return last_fit;
    }
    if (now > old * (1 - kRoundProgress)) {
      break;
    }
  }
  return fit;
}

}  // namespace anicodec
