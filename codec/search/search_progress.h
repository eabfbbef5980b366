// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_
#define ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_

#include "codec/sequence/progress.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace anicodec {

/// A step of a search.
enum class SearchStep : uint8_t {
  kTrial,          ///< of settings, or of key-frames
  kThoroughTrial,  ///< with joint rounding and refitted weights
  kAnalysis        ///< what is no trial and takes as long as some
};

/// Trials that a search expects to make yet.
struct TrialsLeft {
  double plain = 0, thorough = 0;
};

/// Tells how far a search is: the time it has taken, over that and the time of the trials to come, each of which is
/// expected to take the median of those of its kind so far. The part never falls. Safe for threads; only that of the
/// constructor tells.
class SearchProgress {
 public:
  using Clock = std::function<double()>;  ///< seconds since any moment

  /// `progress` must outlive the object.
  explicit SearchProgress(const Progress& progress);
  SearchProgress(const Progress& progress, Clock clock);

  /// The trials from now on, the step at work not counted.
  void expect(const TrialsLeft& left);

  /// The step before, if there is one, has ended.
  void begin(SearchStep step);

 private:
  static constexpr size_t kKinds = 2;  ///< of trials

  void tell();
  double part(double now) const;

  const Progress& progress_;
  Clock clock_;
  std::thread::id owner_ = std::this_thread::get_id();
  std::mutex mutex_;
  double start_, step_start_;
  SearchStep step_ = SearchStep::kAnalysis;
  double left_[kKinds] = {};
  std::vector<double> seconds_[kKinds];  ///< of each trial so far
  double part_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_
