// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/target_search.h"

#include "codec/parallel/parallel.h"
#include "codec/search/clip_bounds.h"
#include "codec/search/linear_steps.h"
#include "codec/search/motion_error.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace anicodec {
namespace {

// Compared at the ratio of errors that is best for the rival. Kinds of face are 14 % apart there, those of horse 5 %.
constexpr double kBehindAtRatio = 1.06;

/// The exponent of bytes over 1 / RMSE; the flatter, the more of the file is mesh.
constexpr Secant::Exponent kOfSizes{0.5, 0.05, 2};

struct Lowest {
  double ratio = 0, price = std::numeric_limits<double>::infinity();
};

/// The minimum of the parabola through the smallest price and its neighbours, ratios by their
/// logarithms; none if the smallest is the first or the last.
Lowest lowest_of(const std::map<double, double>& prices) {
  const auto smallest =
      std::ranges::min_element(prices, {}, &std::pair<const double, double>::second);
  if (smallest == prices.begin() || smallest == prices.end() || std::next(smallest) == prices.end())
    return {};
  const auto [a, fa] = *std::prev(smallest);
  const auto [b, fb] = *smallest;
  const auto [c, fc] = *std::next(smallest);
  const double left = std::log(b / a), right = std::log(c / b);
  const double down = (fa - fb) / left, up = (fc - fb) / right;  // not below 0
  if (!(down + up > 0))
    return {};
  const double shift = 0.5 * (right * down - left * up) / (down + up);
  const double curvature = (down + up) / (left + right);
  return {b * std::exp(shift), fb - curvature * shift * shift};
}

}  // namespace

std::optional<Solution> TargetSearch::at_rmse(SegmentSearch& search, double rmse) {
  return listed(within_bounds(search, input_, 0, rmse));
}

std::optional<Solution> TargetSearch::listed(std::optional<CodedSegment> segment) {
  if (!segment)
    return std::nullopt;
  std::vector<CodedSegment> segments;
  segments.push_back(std::move(*segment));
  return files_.put_together(std::move(segments));
}

std::optional<Solution> TargetSearch::at_max_error(SegmentSearch& search, double bound,
                                                   const Solution* rival) {
  if (bound == 0) {  // per cent of nothing: all vertices are one point that stands still
    for (const double share : {1.0, 0x1p-4, 0x1p-12}) {
      std::optional<Solution> trial = at_rmse(search, share * input_.smallest_bound());
      if (trial && trial->max_error() == 0)
        return trial;
    }
    return std::nullopt;
  }
  // Corrections take care of the outliers: how many are worth having is measured, going from a
  // usual ratio of maximum to mean error in the direction that pays. Horse, dance, flag and a
  // captured face do best with 2.5 to 3.8.
  constexpr double kUsual = 3.3, kFactor = 1.3;
  // Dance by the second, `encode --live --effort fast`: 102.6 kB with it, 127.6 kB with kUsual, 102.2 kB by a search.
  constexpr double kOfPieces = 2.3;
  constexpr double kLeastGain = 0.003;
  std::optional<Solution> best;
  std::map<double, double> prices;  // by the ratio
  const auto trial_is_better = [&](double ratio) {
    std::optional<Solution> trial = at_rmse(search, bound / ratio);
    if (trial)
      prices[ratio] = trial->price();
    if (!trial || (best && trial->price() >= best->price()))
      return false;
    best = std::move(trial);
    return true;
  };
  if (effort_ == Effort::kFirst && trial_is_better(kOfPieces))
    return best;
  const double asked_of_rival = rival ? rival->segments[0].asked : 0;
  const double first = asked_of_rival > 0 ? bound / asked_of_rival : kUsual;
  trial_is_better(first);
  if (rival && (!best || best->price() > kBehindAtRatio * rival->price()))
    return best;
  double ratio = first / kFactor, factor = 1 / kFactor;
  bool better = trial_is_better(ratio);
  if (!better) {
    factor = kFactor;
    better = trial_is_better(ratio = first * kFactor);
  }
  for (int round = 0; round < 3 && better; ++round)
    better = trial_is_better(ratio *= factor);
  const Lowest lowest = lowest_of(prices);
  if (best && lowest.price < (1 - kLeastGain) * best->price())
    trial_is_better(lowest.ratio);
  return best;
}

std::optional<Solution> TargetSearch::at_motion_error(SegmentSearch& search, double bound) {
  // In proportion to the mean error, nearly: a few steps do.
  constexpr int kRounds = 8;
  constexpr double kClose = 0.97, kAim = 0.985, kMostGrowth = 16;
  std::optional<Solution> best;
  double rmse = typical_rmse(search);
  for (int round = 0; round < kRounds && rmse >= input_.smallest_bound() / 2; ++round) {
    std::optional<Solution> trial = at_rmse(search, rmse);
    if (!trial)
      break;
    const double error = motion_error(bound_.metric, trial->segments, input_);
    const bool kept = error <= bound, close = error >= kClose * bound;
    if (kept && (!best || trial->price() < best->price()))
      best = std::move(trial);
    if (kept && close)
      break;
    rmse *= std::min(kAim * bound / std::max(error, 1e-300), kMostGrowth);
  }
  return best;
}

bool TargetSearch::keeps_motion(const Solution& solution) const {
  return !is_motion(bound_.metric) ||
         motion_error(bound_.metric, solution.segments, input_) <= bound_.value;
}

double TargetSearch::bytes_asked() const {
  return *allowed_bytes(bound_, input_.sequence.vertex_count, input_.sequence.frame_count);
}

/// By quick trials, which take somewhat more bytes than what at_rmse() ends with.
double TargetSearch::rmse_of_size(SegmentSearch& search) {
  constexpr int kRounds = 5;
  constexpr double kNear = 0.2;  // of the size
  const double bytes = bytes_asked();
  double rmse = coarsest_rmse() / 1000;
  Secant secant(kOfSizes);
  for (int round = 0; round < kRounds; ++round) {
    std::optional<CodedSegment> segment = search.near_rmse(rmse);
    if (!segment || !(segment->error.squared > 0))
      break;
    std::vector<CodedSegment> segments;
    segments.push_back(std::move(*segment));
    const Solution trial = files_.unlisted(std::move(segments));
    const auto size = static_cast<double>(trial.bytes);
    secant.add(1 / input_.rmse(trial.squared_error()), size);
    rmse = std::clamp(1 / secant.next(bytes, bytes), input_.smallest_bound(), coarsest_rmse());
    if (std::abs(size / bytes - 1) < kNear)
      break;
  }
  return rmse;
}

/// The error at which a file keeps nothing of the motion.
double TargetSearch::coarsest_rmse() const {
  return std::max(input_.rmse_of_kg(100), 2 * input_.smallest_bound());
}

std::optional<Solution> TargetSearch::at_bytes(SegmentSearch& search, const Solution* rival) {
  constexpr int kRounds = 12;
  constexpr double kClose = 0.995, kAim = 0.9975, kFarBehind = 1.15, kNarrow = 0.004;
  const double bytes = bytes_asked(), coarsest = coarsest_rmse();
  double finest = input_.smallest_bound(), rmse_of_best = 0;
  Secant& secant = secants_.try_emplace(&search, kOfSizes).first->second;
  double rmse = !secant.empty() ? 1 / secant.next(kAim * bytes, bytes)
                : rival         ? input_.rmse(rival->squared_error())
                                : typical_rmse(search);
  std::optional<Solution> best;
  for (int round = 0; round < kRounds; ++round) {
    rmse = std::clamp(rmse, finest, coarsest);
    std::optional<Solution> trial = at_rmse(search, rmse);
    if (rival && round == 0 && (!trial || static_cast<double>(trial->bytes) > kFarBehind * bytes))
      return std::nullopt;
    if (!trial) {  // finer than what the search can do
      finest = rmse;
      rmse = std::sqrt(rmse * coarsest);
      continue;
    }
    const auto size = static_cast<double>(trial->bytes);
    secant.add(1 / rmse, size);
    if (size <= bytes && (!best || trial->squared_error() < best->squared_error())) {
      best = std::move(trial);
      rmse_of_best = rmse;
    }
    if (size <= bytes ? size >= kClose * bytes || rmse == finest : rmse == coarsest)
      break;
    rmse = 1 / secant.next(kAim * bytes, bytes);
    if (best && std::abs(rmse / rmse_of_best - 1) < kNarrow)
      break;
  }
  return best ? finer(search, std::move(*best)) : best;
}

/// Sizes vary by some thousandths from one error to the next: somewhat finer ones may fit, too.
std::optional<Solution> TargetSearch::finer(SegmentSearch& search, Solution best) {
  constexpr int kMostMisses = 2;  // in a row
  constexpr double kFiner = 0.008;
  for (int missed = 0; missed < kMostMisses;) {
    const double rmse = (1 - (missed + 1) * kFiner) * input_.rmse(best.squared_error());
    std::optional<Solution> trial = at_rmse(search, rmse);
    const bool fits = trial && static_cast<double>(trial->bytes) <= bytes_asked();
    missed = fits ? 0 : missed + 1;
    if (fits)
      best = std::move(*trial);
  }
  return best;
}

std::optional<Solution> TargetSearch::reach(SegmentSearch& search, const Solution* rival) {
  if (const std::optional<double> rmse = rmse_asked())
    return at_rmse(search, *rmse);
  switch (bound_.metric) {
    case ErrorMetric::kMaxError:
      return at_max_error(search, bound_.value, rival);
    case ErrorMetric::kDisplacement:
    case ErrorMetric::kSted:
      return at_motion_error(search, bound_.value);
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      return at_bytes(search, rival);
    default:
      return std::nullopt;
  }
}

std::optional<Solution> TargetSearch::best_of(std::span<LinearSearch* const> searches) {
  // A first trial tells sizes to about 2 %. At a largest error the ratio that is best for the rival need not be so for the other.
  const double far_behind = bound_.metric == ErrorMetric::kMaxError ? kBehindAtRatio : 1.005;
  std::vector<LinearSearch*> order(searches.begin(), searches.end());
  const std::optional<double> rmse = rmse_asked();
  if (rmse && !input_.bounds_clips()) {
    std::map<const LinearSearch*, double> bytes;
    for (LinearSearch* search : searches)
      bytes[search] = 0;
    parallel_tasks(searches.size(),
                   [&](size_t i) { bytes.at(searches[i]) = searches[i]->prepare(*rmse); });
    std::ranges::stable_sort(order, {},
                             [&](const LinearSearch* search) { return bytes.at(search); });
  }
  std::optional<Solution> best;
  size_t left = searches.size();
  for (LinearSearch* search : order) {
    input_.expect(expected(left--, true));
    if (best && (rmse || bound_.metric == ErrorMetric::kMaxError))
      search->give_up_above(far_behind * search->bytes(best->segments[0]));
    keep_better(rmse ? at_rmse(*search, *rmse) : reach(*search, best ? &*best : nullptr), &best);
  }
  return best;
}

std::optional<double> TargetSearch::rmse_asked() const {
  switch (bound_.metric) {
    case ErrorMetric::kKg:
      return input_.rmse_of_kg(bound_.value);
    case ErrorMetric::kRmse:
      return bound_.value;
    default:
      return std::nullopt;
  }
}

bool TargetSearch::better(const Solution& a, const Solution& b) const {
  if (is_size(bound_.metric))
    return a.squared_error() < b.squared_error();
  return a.price() < b.price();
}

void TargetSearch::keep_better(std::optional<Solution> solution,
                               std::optional<Solution>* best) const {
  if (solution && (!*best || better(*solution, **best)))
    *best = std::move(solution);
}

double TargetSearch::typical_rmse(SegmentSearch& search) {
  if (const std::optional<double> rmse = rmse_asked())
    return *rmse;
  switch (bound_.metric) {
    case ErrorMetric::kMaxError:
      return std::max(bound_.value, input_.smallest_bound()) / 4;
    case ErrorMetric::kDisplacement:
      return bound_.value / 8;
    case ErrorMetric::kSted:
      return input_.rmse_of_kg(5 * bound_.value);  // that of characters, about
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      return rmse_of_size(search);
    default:
      return input_.rmse_of_kg(0.1);
  }
}

TrialsLeft TargetSearch::expected(size_t searches, bool are_chosen) const {
  // From searches of dance, horse, chicken, face and flag, default effort (tests/codec/search/recorded_searches.h): of the first
  // kind and of each other one. Cuts in time and key-frames come last.
  constexpr double kOfOneError = 3, kOfSeveral = 10, kOfSize = 25, kOfOther = 1, kSteps = 13,
                   kLast = 7, kWithoutEffort = 3;
  if (effort_ == Effort::kFirst)
    return {kWithoutEffort, 0};
  double trials = kOfOneError;
  switch (bound_.metric) {
    case ErrorMetric::kMaxError:
    case ErrorMetric::kDisplacement:
    case ErrorMetric::kSted:
      trials = kOfSeveral;
      break;
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      trials = kOfSize;
      break;
    default:
      break;
  }
  const auto of_all = static_cast<double>(searches);
  const double of_errors = searches == 0 ? 0 : trials + kOfOther * (of_all - 1);
  if (effort_ == Effort::kFast)  // nothing is thorough, and no steps are tried
    return {of_errors + kLast, 0};
  return {(are_chosen ? 0 : kSteps * of_all) + kLast, of_errors};
}

}  // namespace anicodec
