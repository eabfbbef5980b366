// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/search_progress.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace anicodec {
namespace {

// Assumed until a thorough trial was made: 1.6 to 3 on dance, horse, chicken and face.
constexpr double kThoroughOverPlain = 2.5;
// The part of the time so far that is left at least, though more trials are made than were expected.
constexpr double kLeastLeft = 0.05;

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// 0 of none.
double median(std::vector<double> values) {
  if (values.empty())
    return 0;
  const auto middle = values.begin() + static_cast<ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

SearchProgress::SearchProgress(const Progress& progress)
    : SearchProgress(progress, steady_seconds) {}

SearchProgress::SearchProgress(const Progress& progress, Clock clock)
    : progress_(progress), clock_(std::move(clock)), start_(clock_()), step_start_(start_) {}

void SearchProgress::expect(const TrialsLeft& left) {
  {
    const std::scoped_lock lock(mutex_);
    left_[0] = left.plain;
    left_[1] = left.thorough;
    if (step_ != SearchStep::kAnalysis)  // it is taken off when it ends
      ++left_[static_cast<size_t>(step_)];
  }
  tell();
}

void SearchProgress::begin(SearchStep step) {
  {
    const std::scoped_lock lock(mutex_);
    const double now = clock_();
    if (step_ != SearchStep::kAnalysis) {
      const auto kind = static_cast<size_t>(step_);
      seconds_[kind].push_back(now - step_start_);
      left_[kind] = std::max(0.0, left_[kind] - 1);
    }
    step_ = step;
    step_start_ = now;
  }
  tell();
}

void SearchProgress::tell() {
  double part_done = 0;
  {
    const std::scoped_lock lock(mutex_);
    part_done = part_ = std::max(part_, part(clock_()));
  }
  if (progress_ && std::this_thread::get_id() == owner_)
    progress_("encoding", part_done);
}

double SearchProgress::part(double now) const {
  const double plain =
      !seconds_[0].empty() ? median(seconds_[0]) : median(seconds_[1]) / kThoroughOverPlain;
  if (!(plain > 0))
    return 0;
  const double thorough = !seconds_[1].empty() ? median(seconds_[1]) : kThoroughOverPlain * plain;
  const double spent = now - start_;
  return spent / (spent + std::max(left_[0] * plain + left_[1] * thorough, kLeastLeft * spent));
}

}  // namespace anicodec
