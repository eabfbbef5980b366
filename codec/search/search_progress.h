// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_
#define ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_

#include "codec/sequence/progress.h"

#include <atomic>
#include <cmath>
#include <thread>

namespace anicodec {

/// Tells how far a search is whose length is known only roughly: the part done never falls, and
/// creeps towards 1 when more trials are made than were expected. Trials may be made in any thread; only that of the
/// constructor is told of them.
class SearchProgress {
 public:
  SearchProgress(const Progress& progress, double expected_trials)
      : progress_(progress), expected_(expected_trials) {}

  /// One more trial is about to begin.
  void trial() {
    const int before = trials_++;
    if (progress_ && std::this_thread::get_id() == owner_)
      progress_("encoding", part(before / expected_));
  }

 private:
  static double part(double x) { return x < 0.8 ? x : 1 - 0.2 * std::exp(-(x - 0.8) / 0.2); }

  const Progress& progress_;
  double expected_;
  std::atomic<int> trials_ = 0;
  std::thread::id owner_ = std::this_thread::get_id();
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_SEARCH_PROGRESS_H_
