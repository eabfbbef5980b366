// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/secant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anicodec {
namespace {

// Logarithms of the ratio of two settings:
constexpr double kApart = 0.01;    // that tell an exponent despite the scatter
constexpr double kFurthest = 2.8;  // of a trial and the next
constexpr double kOther = 0.002;   // that are not the same trial again

}  // namespace

void Secant::add(double setting, double outcome) {
  trials_.push_back({std::log(setting), std::log(outcome)});
}

double Secant::next(double aim, double bound) {
  const double log_aim = std::log(aim), log_bound = std::log(bound);
  std::ranges::stable_sort(trials_, {},
                           [&](const Trial& t) { return std::abs(t.outcome - log_aim); });
  const Trial& nearest = trials_[0];
  const auto other = std::ranges::find_if(
      trials_, [&](const Trial& t) { return std::abs(t.setting - nearest.setting) > kApart; });
  if (other != trials_.end())
    exponent_.usual =
        std::clamp((other->outcome - nearest.outcome) / (other->setting - nearest.setting),
                   exponent_.least, exponent_.most);
  double setting = nearest.setting +
                   std::clamp((log_aim - nearest.outcome) / exponent_.usual, -kFurthest, kFurthest);
  double inside = -std::numeric_limits<double>::infinity(), outside = -inside;
  for (const Trial& t : trials_) {
    if (t.outcome <= log_bound)
      inside = std::max(inside, t.setting);
    else
      outside = std::min(outside, t.setting);
  }
  // The scatter may mix them: then the line alone leads.
  if (std::isfinite(inside) && std::isfinite(outside) && inside < outside &&
      !(setting > inside && setting < outside))
    return std::exp(0.5 * (inside + outside));
  while (std::ranges::any_of(
      trials_, [&](const Trial& t) { return std::abs(t.setting - setting) < kOther / 2; }))
    setting += nearest.outcome < log_aim ? kOther : -kOther;
  return std::exp(setting);
}

}  // namespace anicodec
