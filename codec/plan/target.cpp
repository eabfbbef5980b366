// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/plan/target.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anicodec {

Bound bound_of(const Target& target, double diagonal) {
  if (target.metric == ErrorMetric::kNone || is_lossless(target))
    return {target.metric, target.value};
  if (!(std::isfinite(target.value) && target.value > 0))
    throw Error(ErrorKind::kUsage, "the target must be greater than 0");
  return {target.metric, target.percent ? target.value * (diagonal / 100) : target.value};
}

std::vector<ClipGoal> clip_goals(const Target& target, const std::optional<Target>& cap,
                                 const std::vector<double>& diagonals, double whole) {
  double smallest = 0;
  for (double d : diagonals) {
    if (d > 0 && (smallest == 0 || d < smallest))
      smallest = d;
  }
  if (smallest == 0)
    smallest = whole;
  std::vector<ClipGoal> goals;
  for (double d : diagonals) {
    const double length = d > 0 ? d : smallest;
    ClipGoal& goal = goals.emplace_back();
    goal.bound = bound_of(target, length);
    if (cap)
      goal.cap = bound_of(*cap, length).value;
    goal.diagonal = d;
  }
  return goals;
}

void limit_goal(double length, ClipGoal* goal) {
  constexpr double kMost = 1e6;
  double& value = goal->bound.value;
  switch (goal->bound.metric) {
    case ErrorMetric::kMaxError:
    case ErrorMetric::kRmse:
    case ErrorMetric::kDisplacement:
      value = std::min(value, kMost * length);
      break;
    case ErrorMetric::kKg:
    case ErrorMetric::kSted:
      value = std::min(value, kMost);
      break;
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
    case ErrorMetric::kNone:
      break;
  }
  if (goal->cap)
    goal->cap = std::min(*goal->cap, kMost * length);
}

const Bound& largest_bound(const std::vector<ClipGoal>& goals) {
  return std::ranges::max_element(goals, {}, [](const ClipGoal& goal) { return goal.bound.value; })
      ->bound;
}

std::optional<double> allowed_bytes(const Bound& bound, uint32_t vertices, uint32_t frames) {
  if (bound.metric == ErrorMetric::kSize)
    return bound.value;
  if (bound.metric == ErrorMetric::kBpfv)
    return bound.value / 8 * vertices * frames;
  return std::nullopt;
}

bool is_kept(const ClipGoal& goal, const FileMeasures& file) {
  const Bound& bound = goal.bound;
  if (goal.cap && bound.metric != ErrorMetric::kMaxError && !(file.max_error <= *goal.cap))
    return false;
  switch (bound.metric) {
    case ErrorMetric::kKg:
      return file.kg <= bound.value;
    case ErrorMetric::kRmse:
      return file.rmse <= bound.value;
    case ErrorMetric::kMaxError:
      return file.max_error <= bound.value;
    case ErrorMetric::kDisplacement:
      return file.max_displacement_error <= bound.value;
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      return static_cast<double>(file.bytes) <= *allowed_bytes(bound, file.vertices, file.frames);
    case ErrorMetric::kSted:
    case ErrorMetric::kNone:
      break;
  }
  return true;
}

std::string four_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

}  // namespace anicodec
