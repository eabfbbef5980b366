// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/target.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anicodec {

Target in_scene_units(Target target, double diagonal) {
  if (target.metric == ErrorMetric::kNone || is_lossless(target))
    return target;
  if (!(std::isfinite(target.value) && target.value > 0))
    throw Error(ErrorKind::kUsage, "the target must be greater than 0");
  if (target.percent) {
    target.value *= diagonal / 100;
    target.percent = false;
  }
  return target;
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
    goal.target = in_scene_units(target, length);
    if (cap)
      goal.cap = in_scene_units(*cap, length).value;
    goal.diagonal = d;
  }
  return goals;
}

void limit_goal(double length, ClipGoal* goal) {
  constexpr double kMost = 1e6;
  double& value = goal->target.value;
  switch (goal->target.metric) {
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

const Target& largest_target(const std::vector<ClipGoal>& goals) {
  return std::ranges::max_element(goals, {}, [](const ClipGoal& goal) { return goal.target.value; })
      ->target;
}

std::optional<double> allowed_bytes(const Target& target, uint32_t vertices, uint32_t frames) {
  if (target.metric == ErrorMetric::kSize)
    return target.value;
  if (target.metric == ErrorMetric::kBpfv)
    return target.value / 8 * vertices * frames;
  return std::nullopt;
}

bool is_kept(const Target& target, std::optional<double> cap, const FileMeasures& file) {
  if (cap && target.metric != ErrorMetric::kMaxError && !(file.max_error <= *cap))
    return false;
  switch (target.metric) {
    case ErrorMetric::kKg:
      return file.kg <= target.value;
    case ErrorMetric::kRmse:
      return file.rmse <= target.value;
    case ErrorMetric::kMaxError:
      return file.max_error <= target.value;
    case ErrorMetric::kDisplacement:
      return file.max_displacement_error <= target.value;
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      return static_cast<double>(file.bytes) <= *allowed_bytes(target, file.vertices, file.frames);
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
