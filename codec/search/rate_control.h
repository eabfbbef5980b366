// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_RATE_CONTROL_H_
#define ANICODEC_CODEC_SEARCH_RATE_CONTROL_H_

#include "codec/file/encode_options.h"
#include "codec/search/coded_part.h"
#include "codec/search/encoder_input.h"
#include "codec/search/keyframe_coder.h"
#include "codec/search/linear_coder.h"
#include "codec/search/segment_coder.h"

#include <functional>
#include <optional>
#include <vector>

namespace anicodec {

/// The target with lengths in scene units. Throws Error(kUsage) for values that make no sense.
Target in_scene_units(Target target, double diagonal);

/// A way to code the clip.
struct Solution {
  std::vector<CodedPart> parts;
  size_t bytes = 0;  ///< of the file

  std::vector<const EncodedSegment*> segments() const;
  double squared_error() const;
  double max_error() const;
};

/// Searches for the smallest file that keeps to the target: every trial is opened and measured as a
/// decoder sees it.
class RateControl {
 public:
  RateControl(const EncoderInput& input, const EncodeOptions& options, const Target& target,
              double diagonal);

  /// Throws Error(kUsage) when the target cannot be reached; the text says what can.
  Solution solve();

  /// Throws Error(kInternal) when measured errors are not within the target.
  void require_kept(double kg, double rmse, double max_error, size_t bytes) const;

  /// About how many trials of the coders solve() makes.
  double expected_trials() const;

  const std::vector<Trial>& trials() const { return trials_; }

 private:
  Solution search();
  std::optional<Solution> at_rmse(SegmentCoder& coder, double rmse);
  std::optional<Solution> at_max_error(SegmentCoder& coder, double bound);
  std::optional<Solution> at_bytes(SegmentCoder& coder, size_t bytes);
  std::optional<Solution> reach(SegmentCoder& coder);
  bool better(const Solution& a, const Solution& b) const;
  [[noreturn]] void fail() const;
  [[noreturn]] void fail(KeyframeCoder& keyframes);
  Solution finished(std::vector<CodedPart> parts);
  std::optional<Solution> cut_in_time(const Solution& whole, const LinearCoder& coder);
  bool beats_keyframes(const Solution& solution) const;
  double smallest_bound() const;
  double typical_rmse() const;
  double rmse_of_kg(double kg) const;

  const EncoderInput& input_;
  const EncodeOptions& options_;
  Target target_;
  std::optional<double> cap_;  ///< maximum error beside another target, scene units
  double diagonal_;
  std::vector<Trial> trials_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_RATE_CONTROL_H_
