// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_fit.h"

#include "codec/keyframes/keyframe_weights.h"
#include "codec/keyframes/rigid_weights.h"

#include <algorithm>
#include <utility>

namespace anicodec {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

// Columns of cross products kept between fits: 9 frames doubles each.
constexpr size_t kKeptBytes = size_t{256} << 20;
// Fits kept in all. Searches for a largest error ask for the same ones again and again.
constexpr size_t kFitBytes = size_t{1} << 18;

Matrix3Xd positions(const FrameView& clip, size_t f) {
  const auto count = static_cast<Index>(clip.vertex_count);
  return Eigen::Map<const Eigen::Matrix3Xf>(clip.frame(f), 3, count).cast<double>();
}

std::vector<float> to_floats(const Matrix3Xd& points) {
  std::vector<float> floats(static_cast<size_t>(points.size()));
  Eigen::Map<Eigen::Matrix3Xf>(floats.data(), 3, points.cols()) = points.cast<float>();
  return floats;
}

/// Weights of near repeats are large and opposite: `encode --basis keyframes --keyframes 24
/// --keyframe-selection uniform` of a galloping horse has a gain of 1e6. Gains of 100 are worth their
/// finer key-frames: without them corpus clip waves at --kg 1 takes 20 % more bytes.
constexpr double kMostGain = 1000;
/// Squared rounding error of a key-frame, in parts of the mean squared error of the frames.
constexpr double kFitNoise = 0.2;

/// A fit for exact key-frames or, if that enlarges their rounding, for rounded ones.
template <class Fit>
KeyframeFit robust(const Fit& fit) {
  KeyframeFit exact = fit(0.0);
  if (exact.noise_gain() <= kMostGain)
    return exact;
  return fit(kFitNoise * exact.squared_error() / static_cast<double>(exact.squared_errors.size()));
}

size_t bytes_of(const KeyframeFit& fit) {
  return sizeof fit +
         static_cast<size_t>(fit.weights.size() + fit.squared_errors.size()) * sizeof(double) +
         fit.motions.size() * sizeof(RigidMotion) + fit.keyframes.size() * sizeof(uint32_t);
}

KeyframeFit better(KeyframeFit a, KeyframeFit b) {
  return b.squared_error() < a.squared_error() ? b : a;
}

Matrix3Xd turned_back(const FrameView& clip, size_t f, const RigidMotion& motion) {
  return motion.rotation.transpose() * (positions(clip, f).colwise() - motion.translation);
}

}  // namespace

KeyframeFitter::KeyframeFitter(const FrameView& clip)
    : clip_(clip), gram_(frame_gram(clip)), centred_(gram_.clip_centred()) {}

void KeyframeFitter::align() {
  if (rotations_.empty()) {
    rotations_ = align_frames(clip_, gram_.centroids);
    aligned_ = frame_gram(clip_, rotations_).shape;
    cross_.emplace(clip_, gram_.centroids);
  }
}

const MatrixXd& KeyframeFitter::products(KeyframeWeights kind) {
  if (kind != KeyframeWeights::kRigid) {
    return centred_;
  }
  align();
  return aligned_;
}

KeyframeFit KeyframeFitter::fit(size_t count, KeyframeMethod method, KeyframeWeights kind) {
  const std::tuple key(count, method, kind);
  if (const auto known = kept_.find(key); known != kept_.end())
    return known->second;
  KeyframeFit made = chosen_fit(count, method, kind);
  const size_t bytes = bytes_of(made);
  if (kept_bytes_ + bytes <= kFitBytes) {
    kept_bytes_ += bytes;
    kept_.emplace(key, made);
  }
  return made;
}

KeyframeFit KeyframeFitter::chosen_fit(size_t count, KeyframeMethod method, KeyframeWeights kind) {
  if (kind == KeyframeWeights::kLinear) {
    return fit(select_keyframes(centred_, count, method, KeyframeSpan::kLinear), kind);
  }
  if (kind == KeyframeWeights::kSumToOne) {
    return fit(select_keyframes(centred_, count, method, KeyframeSpan::kAffine), kind);
  }
  align();
  const auto chosen = [&](const MatrixXd& gram, const std::vector<Matrix3d>& rotations) {
    const auto keyframes = select_keyframes(gram, count, method, KeyframeSpan::kAffine);
    return robust([&](double noise) { return fit_rigid(keyframes, rotations, noise); });
  };
  return better(chosen(aligned_, rotations_), chosen(gram_.shape, unturned()));
}

KeyframeFit KeyframeFitter::fit(std::vector<uint32_t> keyframes, KeyframeWeights kind) {
  if (kind == KeyframeWeights::kRigid) {
    align();
    const auto turned = [&](const std::vector<Matrix3d>& rotations) {
      return robust([&](double noise) { return fit_rigid(keyframes, rotations, noise); });
    };
    return better(turned(rotations_), turned(unturned()));
  }
  const auto constraint =
      kind == KeyframeWeights::kLinear ? WeightConstraint::kNone : WeightConstraint::kSumToOne;
  return robust([&](double noise) -> KeyframeFit {
    FrameWeights fitted = fit_weights(centred_, keyframes, constraint, noise);
    return {keyframes, std::move(fitted.weights), std::move(fitted.squared_errors), {}};
  });
}

std::vector<Matrix3d> KeyframeFitter::unturned() const {
  return std::vector<Matrix3d>(clip_.frame_count, Matrix3d::Identity());
}

KeyframeFit KeyframeFitter::fit_rigid(const std::vector<uint32_t>& keyframes,
                                      const std::vector<Matrix3d>& rotations, double noise) {
  cross_->require(keyframes,
                  std::max<size_t>(1, kKeptBytes / (9 * sizeof(double) * clip_.frame_count)));
  RigidWeights fitted = fit_rigid_weights(*cross_, keyframes, rotations, gram_.shape,
                                          WeightConstraint::kSumToOne, noise);
  KeyframeFit result{keyframes, std::move(fitted.weights), std::move(fitted.squared_errors), {}};
  for (size_t f = 0; f < clip_.frame_count; f++) {
    result.motions.push_back(
        {fitted.rotations[f], gram_.centroids.row(static_cast<Index>(f)).transpose()});
  }
  return result;
}

double KeyframeFitter::kg(const KeyframeFit& fit) const {
  return kg_error(fit.squared_error(), gram_.kg_reference());
}

double KeyframeFitter::rmse(const KeyframeFit& fit) const {
  return anicodec::rmse(fit.squared_error(), clip_.vertex_count, clip_.frame_count);
}

std::vector<float> aligned_frame(const FrameView& clip, size_t f, const RigidMotion& motion) {
  return to_floats(turned_back(clip, f, motion));
}

}  // namespace anicodec
