// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/msgi_weights.h"

#include "codec/algebra/symmetric_solve.h"
#include "codec/interpolation/interpolation.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/error.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSteps = 4;
constexpr int kHalvings = 3;
constexpr size_t kMostDirections = 8;

/// Frames by which choices of key-frames are compared.
constexpr size_t kTried = 24;

/// How far a derivative looks, as a change of weight.
constexpr double kDifference = 0.02;

/// Steps that lower the error by less than this share are the last.
constexpr double kWorthwhileRound = 0.02;

/// Keeps steps short along what makes no difference.
constexpr double kRidge = 1e-6;

/// Interpolates for one frame and moves the result onto it.
class FrameFit {
 public:
  FrameFit(const Msgi& msgi, const FrameView& clip, size_t frame)
      : msgi_(msgi),
        scratch_((msgi.scratch_bytes() + 7) / 8),
        shape_(3 * clip.vertex_count),
        target_(clip.frame(frame), 3 * clip.vertex_count) {}

  /// The frame's residual; infinite for weights so large that rounding keeps their sum from being one.
  VectorXd residual(const VectorXd& weights) {
    if (msgi_.evaluate(weights.data(), nullptr, scratch_.data(), shape_.data()) != Status::kOk)
      return VectorXd::Constant(static_cast<Index>(shape_.size()),
                                std::numeric_limits<double>::infinity());
    motion_ = fit_rigid_motion(shape_, target_);
    VectorXd left(static_cast<Index>(shape_.size()));
    for (size_t i = 0; i < shape_.size(); i += 3) {
      const Eigen::Vector3d x(shape_[i], shape_[i + 1], shape_[i + 2]);
      const Eigen::Vector3d wanted(target_[i], target_[i + 1], target_[i + 2]);
      left.segment<3>(static_cast<Index>(i)) =
          wanted - (motion_.rotation * x + motion_.translation);
    }
    return left;
  }

  /// Result of the last call.
  const RigidMotion& motion() const { return motion_; }

 private:
  const Msgi& msgi_;
  std::vector<double> scratch_;
  std::vector<float> shape_;
  std::span<const float> target_;
  RigidMotion motion_;
};

/// Weights with a share of key-frame j mixed in; they still sum to one.
VectorXd mixed(const VectorXd& weights, Index j, double share) {
  VectorXd w = (1 - share) * weights;
  w[j] += share;
  return w;
}

/// The key-frames of largest weight.
std::vector<Index> directions(const VectorXd& weights) {
  std::vector<Index> order(static_cast<size_t>(weights.size()));
  for (size_t j = 0; j < order.size(); ++j)
    order[j] = static_cast<Index>(j);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(weights[a]) > std::abs(weights[b]); });
  order.resize(std::min(order.size(), kMostDirections));
  return order;
}

/// Weights by time between the key-frames before and after a frame.
VectorXd by_time(const std::vector<uint32_t>& keyframes, size_t frame) {
  VectorXd w = VectorXd::Zero(static_cast<Index>(keyframes.size()));
  const auto after = std::lower_bound(keyframes.begin(), keyframes.end(), frame);
  const auto j = static_cast<Index>(after - keyframes.begin());
  if (j == 0 || after == keyframes.end()) {
    w[std::min(j, w.size() - 1)] = 1;
    return w;
  }
  w[j] = (static_cast<double>(frame) - after[-1]) / static_cast<double>(*after - after[-1]);
  w[j - 1] = 1 - w[j];
  return w;
}

/// Improves the weights of one frame, starting from these or others, whichever do better; returns
/// its squared error.
double improve(FrameFit& frame, const VectorXd& others, VectorXd& weights, RigidMotion& motion) {
  VectorXd left = frame.residual(weights);
  motion = frame.motion();
  double error = left.squaredNorm();
  VectorXd other_left = frame.residual(others);
  if (other_left.squaredNorm() < error) {
    left = std::move(other_left);
    weights = others;
    motion = frame.motion();
    error = left.squaredNorm();
  }
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<Index> along = directions(weights);
    MatrixXd derivatives(left.size(), static_cast<Index>(along.size()));
    for (size_t k = 0; k < along.size(); ++k)
      derivatives.col(static_cast<Index>(k)) =
          (left - frame.residual(mixed(weights, along[k], kDifference))) / kDifference;
    MatrixXd normal = derivatives.transpose() * derivatives;
    normal.diagonal().array() += kRidge * normal.trace() + 1e-300;
    VectorXd move = solve_symmetric(normal, VectorXd(derivatives.transpose() * left));
    if (!move.allFinite())
      break;
    bool better = false;
    const double before = error;
    for (int k = 0; k < kHalvings && !better; ++k, move /= 2) {
      VectorXd moved = (1 - move.sum()) * weights;
      for (size_t d = 0; d < along.size(); ++d)
        moved[along[d]] += move[static_cast<Index>(d)];
      moved[0] += 1 - moved.sum();
      VectorXd then = frame.residual(moved);
      if (then.squaredNorm() < error) {
        better = true;
        error = then.squaredNorm();
        left = std::move(then);
        weights = std::move(moved);
        motion = frame.motion();
      }
    }
    if (!better || error > (1 - kWorthwhileRound) * before)
      break;
  }
  return error;
}

/// An interpolation between the key-frames of a fit.
class KeyframeMsgi {
 public:
  KeyframeMsgi(const FrameView& clip, std::span<const uint32_t> triangles, const KeyframeFit& fit)
      : clip_(clip), fit_(fit) {
    std::vector<std::vector<float>> keyframes;
    std::vector<std::span<const float>> inputs;
    std::vector<const float*> pointers;
    for (uint32_t f : fit.keyframes)
      keyframes.push_back(aligned_frame(clip, f, fit.motions[f]));
    for (const std::vector<float>& x : keyframes) {
      inputs.emplace_back(x);
      pointers.push_back(x.data());
    }
    const auto vertices = static_cast<uint32_t>(clip.vertex_count);
    auto set_up = [&] {
      Msgi::Options options;
      options.leaf_faces = leaf_faces_;
      const Status status = msgi_.init(triangles.data(), triangles.size() / 3, vertices,
                                       pointers.data(), pointers.size(), options);
      if (status != Status::kOk)
        throw Error(ErrorKind::kInput, std::string("the clip cannot be interpolated by MSGI: ") +
                                           status_string(status));
    };
    set_up();
    if (msgi_.largest_turn() > std::numbers::pi / 2) {
      leaf_faces_ = choose_leaf_faces(triangles, vertices, inputs);
      set_up();
    }
  }

  uint32_t leaf_faces() const { return leaf_faces_; }

  /// Squared error of some frames before any step.
  double start_error() const {
    const size_t count = std::min(clip_.frame_count, kTried);
    std::vector<double> errors(count);
    parallel_for(size_t{0}, count, [&](size_t i) {
      const size_t f = i * clip_.frame_count / count;
      FrameFit frame(msgi_, clip_, f);
      errors[i] = std::min(frame.residual(weights(f)).squaredNorm(),
                           frame.residual(by_time(fit_.keyframes, f)).squaredNorm());
    });
    double sum = 0;
    for (double e : errors)
      sum += e;
    return sum;
  }

  /// Weights, motions and errors of all frames.
  void improve_into(KeyframeFit& result) const {
    parallel_for(size_t{0}, clip_.frame_count, [&](size_t f) {
      const auto row = static_cast<Index>(f);
      FrameFit frame(msgi_, clip_, f);
      VectorXd w = weights(f);
      if (std::binary_search(fit_.keyframes.begin(), fit_.keyframes.end(), f)) {
        const double error = frame.residual(w).squaredNorm();
        if (std::isfinite(error)) {
          result.squared_errors[row] = error;
          result.motions[f] = frame.motion();
          return;
        }
      }
      result.squared_errors[row] = improve(frame, by_time(fit_.keyframes, f), w, result.motions[f]);
      result.weights.row(row) = w;
    });
  }

 private:
  /// Weights for straight lines; they sum to one exactly.
  VectorXd weights(size_t frame) const {
    VectorXd w = fit_.weights.row(static_cast<Index>(frame));
    w[0] += 1 - w.sum();
    return w;
  }

  const FrameView& clip_;
  const KeyframeFit& fit_;
  uint32_t leaf_faces_ = 8;
  Msgi msgi_;
};

}  // namespace

MsgiFit fit_msgi_weights(const FrameView& clip, std::span<const uint32_t> triangles,
                         std::span<const KeyframeFit> rigid_fits) {
  const KeyframeFit* best = nullptr;
  std::unique_ptr<KeyframeMsgi> interpolation;
  double least = std::numeric_limits<double>::infinity();
  for (const KeyframeFit& fit : rigid_fits) {
    auto trial = std::make_unique<KeyframeMsgi>(clip, triangles, fit);
    const double error = rigid_fits.size() > 1 ? trial->start_error() : 0;
    if (!best || error < least) {
      least = error;
      best = &fit;
      interpolation = std::move(trial);
    }
  }
  MsgiFit result{*best, interpolation->leaf_faces()};
  interpolation->improve_into(result.fit);
  return result;
}

std::optional<double> msgi_error_between(const FrameView& clip, std::span<const uint32_t> triangles,
                                         size_t count) {
  std::vector<uint32_t> keyframes;
  std::vector<const float*> inputs;
  for (size_t j = 0; j < count; ++j) {
    keyframes.push_back(static_cast<uint32_t>(j * (clip.frame_count - 1) / (count - 1)));
    inputs.push_back(clip.frame(keyframes.back()));
  }
  std::vector<uint32_t> between;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    if (!std::ranges::binary_search(keyframes, f))
      between.push_back(f);
  }
  Msgi msgi;
  if (between.empty() ||
      msgi.init(triangles.data(), triangles.size() / 3, static_cast<uint32_t>(clip.vertex_count),
                inputs.data(), inputs.size(), {}) != Status::kOk)
    return std::nullopt;
  std::vector<double> errors(std::min(between.size(), kTried));
  parallel_for(size_t{0}, errors.size(), [&](size_t i) {
    const uint32_t f = between[(2 * i + 1) * between.size() / (2 * errors.size())];
    errors[i] = FrameFit(msgi, clip, f).residual(by_time(keyframes, f)).squaredNorm();
  });
  return std::sqrt(std::accumulate(errors.begin(), errors.end(), 0.0) /
                   static_cast<double>(errors.size() * clip.vertex_count));
}

}  // namespace anicodec
