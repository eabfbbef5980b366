// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_TARGET_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_TARGET_SEARCH_H_

#include "codec/plan/encode_options.h"
#include "codec/search/encoder_input.h"
#include "codec/search/linear_search.h"
#include "codec/search/secant.h"
#include "codec/search/segment_search.h"
#include "codec/search/solution.h"
#include "codec/search/trial_files.h"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace anicodec {

/// Finds the segment that one kind of basis makes for a target: an error is met directly, a maximum error with
/// corrections of outliers, a size and an error of the motion by the mean error that leads to it.
class TargetSearch {
 public:
  /// `target`: of clips whose own differ (EncoderInput::bound_clips()) the largest.
  TargetSearch(const EncoderInput& input, const SearchOptions& options, const Bound& bound)
      : input_(input), bound_(bound), effort_(options.effort), files_(input) {}

  /// The best file of a search that keeps to the target; nothing when there is none. It need not be the
  /// best if it is far behind `rival`, which another search made: null for none.
  std::optional<Solution> reach(SegmentSearch& search, const Solution* rival = nullptr);

  /// The best of some kinds of basis. Targets that are an error let them choose their settings at the same time.
  std::optional<Solution> best_of(std::span<LinearSearch* const> searches);

  /// The root mean square error that the target is; nothing for a target that only leads to one.
  std::optional<double> rmse_asked() const;

  /// Whether a is the better of two files that keep to the target.
  bool better(const Solution& a, const Solution& b) const;

  /// Replaces the best file by a better one.
  void keep_better(std::optional<Solution> solution, std::optional<Solution>* best) const;

  /// Whether a file that was put together otherwise keeps to a target that is about motion; true for
  /// other targets.
  bool keeps_motion(const Solution& solution) const;

  /// About the root mean square error of a file that keeps to the target; for a size, as quick
  /// trials of the search tell.
  double typical_rmse(SegmentSearch& search);

  /// Asks for another size. Knowledge learnt about the searches stays valid.
  void ask_size(double bytes) { bound_ = {ErrorMetric::kSize, bytes}; }

  /// About how many trials are left with so many kinds of basis yet to search, whose settings are chosen or not.
  TrialsLeft expected(size_t searches, bool are_chosen) const;

  TrialFiles& files() { return files_; }

  const TrialFiles& files() const { return files_; }

 private:
  std::optional<Solution> at_rmse(SegmentSearch& search, double rmse);
  std::optional<Solution> listed(std::optional<CodedSegment> segment);
  std::optional<Solution> at_max_error(SegmentSearch& search, double bound, const Solution* rival);
  std::optional<Solution> at_motion_error(SegmentSearch& search, double bound);
  std::optional<Solution> at_bytes(SegmentSearch& search, const Solution* rival);
  std::optional<Solution> finer(SegmentSearch& search, Solution best);
  double rmse_of_size(SegmentSearch& search);
  double coarsest_rmse() const;
  double bytes_asked() const;

  const EncoderInput& input_;
  Bound bound_;
  Effort effort_;
  TrialFiles files_;
  std::map<const SegmentSearch*, Secant> secants_;  ///< of sizes, by 1 / RMSE
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_TARGET_SEARCH_H_
