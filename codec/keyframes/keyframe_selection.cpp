// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_selection.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/pivoted_cholesky.h"
#include "codec/keyframes/keyframe_weights.h"
#include "codec/keyframes/neural_gas.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A frame whose squared distance from the others' span is below this part of the largest square
// adds nothing but rounding errors.
constexpr double kRankTolerance = 1e-12;

// An exchange must pay more than rounding.
constexpr double kWorthwhile = 1 + 1e-9;

// Part of the mean squared distance from the mean frame within which two frames are nearly the same:
// weights of both would be large and opposite.
constexpr double kNearRepeat = 1e-3;

constexpr size_t kGasStarts = 3;

constexpr int kMostExchanges = 6;
constexpr double kWorthwhilePass = 0.99;  // of the squared error before

// The residual of every frame after the key-frames, and the gain of each key-frame alone.
struct Projection {
  MatrixXd residual;  // frames x frames products of what is not reproduced
  MatrixXd freed;     // frames x key-frames: without key-frame i, residual grows by
                      // freed_i freed_i^T

  Projection(const MatrixXd& gram, const std::vector<uint32_t>& keyframes) {
    solve(gram, keyframes);
    residual = gram;
    residual.noalias() -= reproduced_.transpose() * reproduced_;
  }

  // Follows an exchange of one key-frame, given what was freed and caught by it.
  void exchange(const MatrixXd& gram, const std::vector<uint32_t>& keyframes, const VectorXd& lost,
                const VectorXd& caught) {
    residual.noalias() += lost * lost.transpose();
    residual.noalias() -= caught * caught.transpose();
    solve(gram, keyframes);
  }

 private:
  void solve(const MatrixXd& gram, const std::vector<uint32_t>& keyframes) {
    const auto count = static_cast<Index>(keyframes.size());
    const Eigen::LLT<MatrixXd> factor(gram(keyframes, keyframes));
    const MatrixXd inverse = factor.matrixL().solve(MatrixXd::Identity(count, count));
    reproduced_ = factor.matrixL().solve(gram(keyframes, Eigen::all));
    freed = factor.matrixU().solve(reproduced_).transpose();
    for (Index i = 0; i < count; i++) {
      freed.col(i) /= inverse.col(i).norm();
    }
  }

  MatrixXd reproduced_;  // key-frames x frames, in an orthonormal basis of the key-frames
};

// A large constant coordinate turns weights of free sum into weights of sum one.
MatrixXd lifted(const MatrixXd& gram) {
  MatrixXd result = about_mean(gram);
  result.array() += result.diagonal().maxCoeff();
  return result;
}

std::vector<uint32_t> pivot_frames(const MatrixXd& gram, size_t count, KeyframeSpan span) {
  const bool affine = span == KeyframeSpan::kAffine;
  const MatrixXd& products = affine ? lifted(gram) : gram;
  const double scale = (affine ? about_mean(gram) : gram).diagonal().maxCoeff();
  std::vector<uint32_t> frames = PivotedCholesky(products, kRankTolerance * scale, count).pivots();
  if (frames.empty()) {
    return {0};
  }
  exchange_keyframes(products, frames);
  return frames;
}

std::vector<uint32_t> gas_frames(const MatrixXd& gram, size_t count, KeyframeSpan span) {
  const auto constraint =
      span == KeyframeSpan::kAffine ? WeightConstraint::kSumToOne : WeightConstraint::kNone;
  std::array<std::vector<uint32_t>, kGasStarts> frames;
  std::array<double, kGasStarts> errors;
  parallel_for(size_t{0}, kGasStarts, [&](size_t start) {
    NeuralGasOptions options;
    options.seed = start;
    frames[start] = prototype_frames(neural_gas(gram, count, options), gram);
    errors[start] = fit_weights(gram, frames[start], constraint).squared_errors.sum();
  });
  return frames[static_cast<size_t>(std::min_element(errors.begin(), errors.end()) -
                                    errors.begin())];
}

/// The middles of equal parts of the clip. If a middle nearly repeats a frame that is taken, the
/// nearest frame of its part that does not; if there is none, the nearest that is no repeat.
std::vector<uint32_t> uniform_frames(const MatrixXd& gram, size_t count) {
  const auto total = static_cast<size_t>(gram.rows());
  const double near = kNearRepeat * about_mean(gram).diagonal().mean();
  std::vector<uint32_t> frames;
  const auto is_new = [&](size_t f, double tolerance) {
    return std::all_of(frames.begin(), frames.end(), [&](uint32_t g) {
      return f != g && squared_distance(gram, static_cast<Index>(f), g) > tolerance;
    });
  };
  const auto add_nearest = [&](size_t wanted, size_t reach, double tolerance) {
    for (size_t away = 0; away < reach; away++) {
      for (const size_t f : {wanted + away, wanted - away}) {  // wraps below 0
        if (f < total && is_new(f, tolerance)) {
          frames.push_back(static_cast<uint32_t>(f));
          return true;
        }
      }
    }
    return false;
  };
  for (size_t i = 0; i < count; i++) {
    const size_t wanted = (2 * i + 1) * total / (2 * count);
    if (!add_nearest(wanted, (total + 2 * count - 1) / (2 * count), near)) {
      add_nearest(wanted, total, repeat_tolerance(gram));
    }
  }
  return frames;
}

}  // namespace

std::vector<uint32_t> select_keyframes(const MatrixXd& gram, size_t count, KeyframeMethod method,
                                       KeyframeSpan span) {
  std::vector<uint32_t> frames;
  switch (method) {
    case KeyframeMethod::kGas:
      frames = gas_frames(gram, count, span);
      break;
    case KeyframeMethod::kPivot:
      frames = pivot_frames(gram, count, span);
      break;
    case KeyframeMethod::kUniform:
      frames = uniform_frames(gram, count);
      break;
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

void exchange_keyframes(const MatrixXd& gram, std::vector<uint32_t>& keyframes) {
  const double tolerance = kRankTolerance * gram.diagonal().maxCoeff();
  std::vector<bool> taken(static_cast<size_t>(gram.rows()), false);
  for (uint32_t k : keyframes) {
    taken[k] = true;
  }
  double error = std::numeric_limits<double>::max();
  std::vector<uint32_t> before = keyframes;
  for (int pass = 0; pass <= kMostExchanges; pass++) {
    Projection projection(gram, keyframes);
    const double now = projection.residual.trace();
    if (!(now < error)) {  // rounding has the upper hand
      keyframes = before;
      return;
    }
    if (pass == kMostExchanges || now > error * kWorthwhilePass) {
      return;
    }
    error = now;
    before = keyframes;
    for (size_t i = 0; i < keyframes.size(); i++) {
      const VectorXd lost = projection.freed.col(static_cast<Index>(i));
      // Squared length of column f of the residual without key-frame i, over its diagonal.
      const VectorXd along = projection.residual * lost;
      const double length = lost.squaredNorm();
      const auto gain = [&](uint32_t f) {
        const double residual = projection.residual(f, f) + lost[f] * lost[f];
        return residual > tolerance ? (projection.residual.col(f).squaredNorm() +
                                       2 * lost[f] * along[f] + lost[f] * lost[f] * length) /
                                          residual
                                    : 0;
      };
      uint32_t best = keyframes[i];
      double most = gain(best) * kWorthwhile;
      for (uint32_t f = 0; f < taken.size(); f++) {
        const double g = taken[f] ? 0 : gain(f);
        if (g > most) {
          best = f;
          most = g;
        }
      }
      if (best != keyframes[i]) {
        const double residual = projection.residual(best, best) + lost[best] * lost[best];
        const VectorXd caught =
            (projection.residual.col(best) + lost[best] * lost) / std::sqrt(residual);
        taken[keyframes[i]] = false;
        taken[best] = true;
        keyframes[i] = best;
        projection.exchange(gram, keyframes, lost, caught);
      }
    }
  }
}

}  // namespace anicodec
