// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/keyframe_search.h"

#include "codec/connectivity/draco_encode.h"
#include "codec/keyframes/keyframe_count.h"
#include "codec/segment/keyframe_segment_encode.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace anicodec {
namespace {

constexpr KeyframeWeights kWeights[] = {KeyframeWeights::kLinear, KeyframeWeights::kSumToOne,
                                        KeyframeWeights::kRigid};
constexpr const char* kWeightNames[] = {"free weights", "weights of sum one", "rigid motion"};
constexpr int kTargetRounds = 8;

ErrorTarget rmse_target(double rmse) {
  return {std::numeric_limits<double>::infinity(), rmse};
}

/// Evenly spread, with the first and the last frame: all others lie between two.
std::vector<uint32_t> spread_frames(size_t frames, size_t count) {
  std::vector<uint32_t> chosen;
  for (size_t j = 0; j < count; ++j)
    chosen.push_back(static_cast<uint32_t>(j * (frames - 1) / (count - 1)));
  return chosen;
}

}  // namespace

KeyframeSearch::KeyframeSearch(const EncoderInput& input, KeyframeMethod method,
                               std::optional<uint32_t> count, KeyframePoses poses,
                               Reconstruction reconstruction)
    : input_(input),
      fitter_(input.frames()),
      method_(method),
      count_(count),
      poses_(poses),
      reconstruction_(reconstruction) {
  if (reconstruction == Reconstruction::kMsgi) {
    weights_ = KeyframeWeights::kRigid;
    return;
  }
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

const MsgiFit& KeyframeSearch::interpolated(size_t count) {
  auto [found, is_new] = interpolated_.try_emplace(count);
  if (is_new) {
    std::vector<KeyframeFit> fits{fitter_.fit(count, method_, weights_)};
    if (count > 1)
      fits.push_back(fitter_.fit(spread_frames(input_.frames().frame_count, count), weights_));
    found->second = fit_msgi_weights(input_.frames(), input_.layout.topology.triangles, fits);
  }
  return found->second;
}

const MsgiFit& KeyframeSearch::fit(double rmse) {
  if (reconstruction_ == Reconstruction::kLinear) {
    fit_ = {count_ ? fitter_.fit(*count_, method_, weights_)
                   : fewest_keyframes(fitter_, rmse_target(rmse), method_, weights_),
            0};
    return fit_;
  }
  if (count_)
    return interpolated(*count_);
  // About as many as straight lines need, then fewer.
  const size_t frames = std::min(input_.frames().frame_count, most_keyframes_);
  size_t few = 0;
  size_t enough = std::min(
      frames, fewest_keyframes(fitter_, rmse_target(rmse), method_, weights_).keyframes.size());
  while (enough < frames && fitter_.rmse(interpolated(enough).fit) > rmse) {
    few = enough;
    enough = std::min(frames, enough + enough / 4 + 1);
  }
  while (enough - few > 1 + enough / 16) {
    const size_t middle = (few + enough) / 2;
    (fitter_.rmse(interpolated(middle).fit) <= rmse ? enough : few) = middle;
  }
  return interpolated(enough);
}

std::optional<CodedSegment> KeyframeSearch::coded(const MsgiFit& fit, double rounding_rms) {
  input_.begin(SearchStep::kTrial);
  const size_t count = fit.fit.keyframes.size();
  const double finest = input_.largest_coordinate * 0x1p-21;
  const double step = std::max(
      {step_for_rounding_error(fit.fit, rounding_rms), finest, std::numeric_limits<double>::min()});
  const MemoryShare memory = input_.take_memory(
      input_.sequence.frame_count, "the key-frames that the error takes",
      [&](const EncodingMemory& m) {
        // Differences of two poses.
        const double span =
            poses_ == KeyframePoses::kNative ? 0 : 4 * input_.largest_coordinate / step;
        return m.basis(BasisKind::kKeyframes, static_cast<double>(count), Effort::kNormal) +
               draco_symbol_bytes(m.vertices, count, span);
      });
  std::optional<EncodedSegment> encoded =
      encode_keyframes(input_.frames(), fit.fit, weights_, fitter_.gram().mean_position(), step,
                       input_.layout, poses_, fit.leaf_faces);
  if (!encoded)
    return std::nullopt;
  CodedSegment segment;
  segment.encoded = std::move(*encoded);
  segment.opened = open_encoded(segment.encoded, input_.layout);
  segment.error = measure(segment.opened, input_.frames(), input_.copies);
  segment.what = std::to_string(count) + " key-frames, " +
                 kWeightNames[static_cast<int>(weights_)] + (fit.leaf_faces > 0 ? ", MSGI" : "");
  return segment;
}

std::optional<CodedSegment> KeyframeSearch::at_rmse(double rmse) {
  std::optional<CodedSegment> best;
  size_t best_bytes = 0;
  // More key-frames leave more room for rounding: what is cheapest is measured.
  for (double share : {0.6, 0.85}) {
    double exact_target = share * rmse;
    double rounding = 0;
    for (int round = 0; round < kTargetRounds; ++round) {
      const MsgiFit& exact = fit(exact_target);
      double left = rmse * rmse - std::pow(fitter_.rmse(exact.fit), 2);
      if (left <= 0)
        break;
      if (rounding == 0 || rounding > std::sqrt(left))
        rounding = std::sqrt(left);
      std::optional<CodedSegment> segment = coded(exact, rounding);
      if (!segment)
        return best;
      if (static_cast<double>(segment->encoded.bytes()) > most_bytes_)
        return best;
      double measured = input_.rmse(segment->error.squared);
      if (measured <= rmse) {
        const size_t bytes = segment->encoded.bytes();
        if (!best || bytes < best_bytes) {
          best = std::move(segment);
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

CodedSegment KeyframeSearch::at_count() {
  const MsgiFit& exact = fit(0);
  double floor = input_.largest_coordinate * 1e-6;
  double rms = fitter_.rmse(exact.fit);
  double allowed = std::max(1.1 * rms, floor);
  double rounding = std::sqrt(std::max(0.8 * (allowed * allowed - rms * rms), 0.0));
  std::optional<CodedSegment> segment = coded(exact, rounding);
  for (int round = 0;
       segment && round < kTargetRounds && input_.rmse(segment->error.squared) > allowed; ++round)
    segment = coded(exact, rounding *= 0.7);
  if (!segment)
    throw Error(ErrorKind::kUsage,
                "the key-frames cannot be stored as finely as the other frames need them: ask for "
                "fewer, or for other ones (--keyframe-selection)");
  return std::move(*segment);
}

}  // namespace anicodec
