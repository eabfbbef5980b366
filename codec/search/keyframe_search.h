// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_KEYFRAME_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_KEYFRAME_SEARCH_H_

#include "codec/keyframes/msgi_weights.h"
#include "codec/search/encoder_input.h"
#include "codec/search/segment_search.h"
#include "codec/segment/keyframe_poses.h"

#include <cstddef>
#include <limits>
#include <map>
#include <optional>

namespace anicodec {

/// Searches how key-frames code a segment (thesis chapter 5): finds how many, which, what kind of weights,
/// and how finely to round them.
class KeyframeSearch : public SegmentSearch {
 public:
  /// `count`: the exact number of key-frames, or as many as the error needs. `poses`: what codes
  /// them. `reconstruction`: how
  /// frames are made from them; MSGI takes weights that sum to one and a rigid motion per frame,
  /// and tries key-frames spread evenly from the first frame to the last, too.
  KeyframeSearch(const EncoderInput& input, KeyframeMethod method, std::optional<uint32_t> count,
                 KeyframePoses poses, Reconstruction reconstruction);

  std::optional<CodedSegment> at_rmse(double rmse) override;

  /// Key-frames that the error needs if they are exact.
  size_t count_at(double rmse) { return fit(rmse).fit.keyframes.size(); }

  /// Takes no more key-frames: what needs more is out of reach.
  void take_at_most(size_t keyframes) { most_keyframes_ = keyframes; }

  /// Ends searches at a trial that takes more.
  void give_up_above(double bytes) { most_bytes_ = bytes; }

  /// The given number of key-frames, rounded so that the error of exact ones grows by at most a
  /// tenth, or by a millionth of the largest coordinate where that is more.
  CodedSegment at_count();

 private:
  /// So many key-frames, or as many as the error needs, with what is needed to code them.
  const MsgiFit& fit(double rmse);
  const MsgiFit& interpolated(size_t count);
  /// Nothing if the format cannot hold a number.
  std::optional<CodedSegment> coded(const MsgiFit& fit, double rounding_rms);

  const EncoderInput& input_;
  KeyframeFitter fitter_;
  KeyframeMethod method_;
  std::optional<uint32_t> count_;
  KeyframePoses poses_;
  Reconstruction reconstruction_;
  size_t most_keyframes_ = std::numeric_limits<size_t>::max();
  double most_bytes_ = std::numeric_limits<double>::infinity();
  KeyframeWeights weights_ = KeyframeWeights::kLinear;
  MsgiFit fit_;                             ///< the last one by straight lines, leaf_faces 0
  std::map<size_t, MsgiFit> interpolated_;  ///< by number of key-frames: they take long
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_KEYFRAME_SEARCH_H_
