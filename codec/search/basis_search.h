// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_BASIS_SEARCH_H_
#define ANICODEC_CODEC_SEARCH_BASIS_SEARCH_H_

#include "codec/plan/encode_options.h"
#include "codec/search/encoder_input.h"
#include "codec/search/keyframe_search.h"
#include "codec/search/linear_search.h"
#include "codec/search/solution.h"
#include "codec/search/target_search.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

/// Searches all ways of coding for the smallest file that keeps to the target: every trial is
/// opened and measured as a decoder sees it.
class BasisSearch {
 public:
  /// `input` and `options` must outlive this object.
  BasisSearch(const EncoderInput& input, const SearchOptions& options, const Bound& bound)
      : input_(input), options_(options), bound_(bound), search_(input, options, bound) {}

  /// Throws Error(kUsage) when the target cannot be reached; the text says what can.
  Solution solve();

  /// The same for another size of the file, with the settings that were chosen before.
  Solution solve_within(double bytes);

  const std::vector<Trial>& trials() const { return search_.files().trials(); }

  /// A kind of basis that was left alone, and why.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  using LinearSearches = std::vector<std::unique_ptr<LinearSearch>>;

  std::optional<Solution> of_all_clips();
  std::optional<Solution> clip_by_clip();
  std::optional<Solution> by_keyframes_alone();
  std::optional<Solution> by_linear_bases();
  LinearSearches linear_searches(const LinearAnalysis& analysis);
  void add_keyframe_search(Reconstruction reconstruction);
  bool tries_keyframes(bool of_any_clip) const;
  bool allows_msgi() const;
  void try_msgi(Solution* best);
  void note(const std::string& reason);
  void offer(SegmentSearch& search, std::optional<Solution>* best);
  void offer_keyframes(std::optional<Solution>* best);
  bool may_be_simple();
  std::optional<Solution> cut_in_time(const Solution& whole, const LinearSearch& search);
  bool beats_keyframes(const Solution& solution) const;
  [[noreturn]] void fail() const;
  [[noreturn]] void fail(KeyframeSearch& keyframes) const;

  const EncoderInput& input_;
  const SearchOptions& options_;
  Bound bound_;
  TargetSearch search_;
  std::optional<LinearAnalysis> analysis_;
  LinearSearches linear_searches_;  ///< of the analysis
  std::vector<std::unique_ptr<KeyframeSearch>> keyframe_searches_;
  std::unique_ptr<KeyframeSearch> msgi_search_;
  std::vector<std::string> notes_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_BASIS_SEARCH_H_
