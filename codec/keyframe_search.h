// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_KEYFRAME_SEARCH_H_
#define ANICODEC_CODEC_KEYFRAME_SEARCH_H_

#include "codec/keyframe_fit.h"
#include "codec/segment_coder.h"

#include <optional>

namespace anicodec {

/// Codes a segment by key-frames (thesis chapter 5): finds how many, which, what kind of weights,
/// and how finely to round them.
class KeyframeCoder : public SegmentCoder {
 public:
  /// `count`: the exact number of key-frames, or as many as the error needs.
  KeyframeCoder(const EncoderInput& input, KeyframeMethod method, std::optional<uint32_t> count);

  std::optional<Part> at_rmse(double rmse) override;

  /// The given number of key-frames, rounded so that the error of exact ones grows by at most a
  /// tenth, or by a millionth of the largest coordinate where that is more.
  Part at_count();

 private:
  KeyframeFit fit(double rmse);
  Part coded(const KeyframeFit& fit, double rounding_rms);

  const EncoderInput& input_;
  KeyframeFitter fitter_;
  KeyframeMethod method_;
  std::optional<uint32_t> count_;
  KeyframeWeights weights_ = KeyframeWeights::kLinear;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_KEYFRAME_SEARCH_H_
