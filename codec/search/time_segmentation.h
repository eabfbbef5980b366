// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_TIME_SEGMENTATION_H_
#define ANICODEC_CODEC_SEARCH_TIME_SEGMENTATION_H_

#include "codec/search/coded_segment.h"
#include "codec/search/encoder_input.h"
#include "codec/search/linear_search.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace anicodec {

/// Cuts a sequence in time where that makes it smaller: between clips, at hard cuts, and long ranges
/// in the middle. All segments share one reference pose; whether a cut pays is measured by coding
/// both sides.
class TimeSegmentation {
 public:
  /// `whole` coded the whole clip, with `pose`, to the error `rmse`. It must outlive this object, and so must
  /// its analysis.
  TimeSegmentation(const EncoderInput& input, const LinearSearch& whole,
                   std::shared_ptr<const EncodedPose> pose, double rmse);

  /// The ranges, in order; one when no cut pays. Clips that follow one another share a range, and
  /// so a basis, where that is smaller. Cost: about one trial of the whole per level of cutting, and
  /// one of each range for every clip in it.
  std::vector<FrameRun> find();

  /// A range coded to the error.
  std::optional<CodedSegment> coded(const FrameRun& range) const;

 private:
  std::vector<FrameRun> of_clips();
  void split(const FrameRun& range, double bytes, const LinearSearch& like,
             std::vector<FrameRun>* out) const;
  std::optional<uint32_t> candidate(const FrameRun& range) const;
  /// The bytes of a range by the settings of another search.
  double probed(const FrameRun& range, const LinearSearch& like) const;
  LinearAnalysis analysis(const FrameRun& range) const;
  LinearSearch search(const LinearAnalysis& analysis, const FrameRun& range,
                      const LinearSearch& like) const;

  const EncoderInput& input_;
  const LinearSearch& whole_;
  std::shared_ptr<const EncodedPose> pose_;
  double rmse_;
  std::vector<double> motion_;  ///< squared distance of each frame from the one before
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_TIME_SEGMENTATION_H_
