// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/step_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anicodec {
namespace {

constexpr double kLeastSlope = 0.35, kMostSlope = 1.5;
constexpr double kApart = 0.01;    // logarithms of steps that tell a slope despite the scatter
constexpr double kFurthest = 1.4;  // logarithms of the ratio of two steps in a row
constexpr double kOther = 0.002;   // of steps that are not the same trial again

}  // namespace

StepSearch::StepSearch(double aim, double slope) : aim_(std::log(aim)), slope_(slope) {}

double StepSearch::next(double step, double ratio) {
  trials_.push_back({std::log(step), std::log(ratio)});
  std::ranges::stable_sort(trials_, {},
                           [&](const Trial& t) { return std::abs(t.ratio - aim_); });
  const Trial& nearest = trials_[0];
  const auto other = std::ranges::find_if(
      trials_, [&](const Trial& t) { return std::abs(t.step - nearest.step) > kApart; });
  if (other != trials_.end())
    slope_ = std::clamp((other->ratio - nearest.ratio) / (other->step - nearest.step), kLeastSlope,
                        kMostSlope);
  const double by_line = nearest.step + std::clamp((aim_ - nearest.ratio) / slope_, -kFurthest,
                                                   kFurthest);
  return std::exp(within_bracket(by_line));
}

/// Between the steps known to keep to the error and those known not to, unless the scatter mixes them.
double StepSearch::within_bracket(double step) const {
  double inside = -std::numeric_limits<double>::infinity(), outside = -inside;
  for (const Trial& t : trials_) {
    if (t.ratio <= 0)
      inside = std::max(inside, t.step);
    else
      outside = std::min(outside, t.step);
  }
  if (std::isfinite(inside) && std::isfinite(outside) && inside < outside &&
      !(step > inside && step < outside))
    return 0.5 * (inside + outside);
  while (std::ranges::any_of(trials_,
                             [&](const Trial& t) { return std::abs(t.step - step) < kOther / 2; }))
    step += trials_[0].ratio < aim_ ? kOther : -kOther;
  return step;
}

}  // namespace anicodec
