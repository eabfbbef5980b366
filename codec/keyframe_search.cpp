// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframe_search.h"

#include "codec/keyframe_count.h"
#include "codec/keyframe_segment_encode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anicodec {
namespace {

constexpr KeyframeWeights kWeights[] = {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne,
                                        KeyframeWeights::kRigid};
constexpr const char* kWeightNames[] = {"free weights", "weights of sum one", "rigid motion"};
constexpr int kRounds = 8;

ErrorTarget rmse_target(double rmse) {
  return {std::numeric_limits<double>::infinity(), rmse};
}

}  // namespace

KeyframeCoder::KeyframeCoder(const EncoderInput& input, KeyframeMethod method,
                             std::optional<uint32_t> count)
    : input_(input), fitter_(input.frames()), method_(method), count_(count) {
  // The kind of weights that does best with as many key-frames as asked, or a few.
  size_t probe = std::min<size_t>(count.value_or(12), input.frames().frame_count);
  double least = std::numeric_limits<double>::infinity();
  for (KeyframeWeights kind : kWeights) {
    double error = fitter_.rmse(fitter_.fit(probe, method, kind));
    if (error < 0.98 * least) {
      least = error;
      weights_ = kind;
    }
  }
}

KeyframeFit KeyframeCoder::fit(double rmse) {
  return count_ ? fitter_.fit(*count_, method_, weights_)
                : fewest_keyframes(fitter_, rmse_target(rmse), method_, weights_);
}

Part KeyframeCoder::coded(const KeyframeFit& fit, double rounding_rms) {
  input_.begin_trial();
  double finest = input_.largest_coordinate * 0x1p-22;
  double step = std::max(
      {step_for_rounding_error(fit, rounding_rms), finest, std::numeric_limits<double>::min()});
  Part part;
  part.encoded = encode_keyframes(input_.frames(), fit, weights_, fitter_.gram().mean_position(),
                                  step, input_.layout);
  part.opened = open_encoded(part.encoded, input_.layout);
  part.error = measure(part.opened, input_.frames(), input_.copies);
  part.what = std::to_string(fit.keyframes.size()) + " key-frames, " +
              kWeightNames[static_cast<int>(weights_)];
  return part;
}

std::optional<Part> KeyframeCoder::at_rmse(double rmse) {
  std::optional<Part> best;
  size_t best_bytes = 0;
  // More key-frames leave more room for rounding: what is cheapest is measured.
  for (double share : {0.6, 0.85}) {
    double exact_target = share * rmse;
    double rounding = 0;
    for (int round = 0; round < kRounds; ++round) {
      KeyframeFit exact = fit(exact_target);
      double left = rmse * rmse - std::pow(fitter_.rmse(exact), 2);
      if (left <= 0)
        break;
      if (rounding == 0 || rounding > std::sqrt(left))
        rounding = std::sqrt(left);
      Part part = coded(exact, rounding);
      double measured = input_.rmse(part.error.squared);
      if (measured <= rmse) {
        size_t bytes = part.encoded.bytes() +
                       encode_with_poses(input_.layout, part.encoded.draco_poses).size();
        if (!best || bytes < best_bytes) {
          best = std::move(part);
          best_bytes = bytes;
        }
        break;
      }
      rounding *= 0.97 * std::sqrt(left / std::max(measured * measured - rmse * rmse + left, left));
      // Welded vertices count more than once: then even exact key-frames may miss the target.
      if (round >= 3)
        exact_target *= 0.9;
    }
    if (count_)
      break;
  }
  return best;
}

Part KeyframeCoder::at_count() {
  KeyframeFit exact = fit(0);
  std::vector<float> unused;
  double floor = input_.largest_coordinate * 1e-6;
  double rms = fitter_.rmse(exact);
  double allowed = std::max(1.1 * rms, floor);
  double rounding = std::sqrt(std::max(0.8 * (allowed * allowed - rms * rms), 0.0));
  Part part = coded(exact, rounding);
  for (int round = 0; round < kRounds && input_.rmse(part.error.squared) > allowed; ++round)
    part = coded(exact, rounding *= 0.7);
  return part;
}

}  // namespace anicodec
