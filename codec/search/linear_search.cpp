// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/linear_search.h"

#include "codec/parallel/parallel.h"
#include "codec/parallel/thread_count.h"
#include "codec/search/opening_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

namespace anicodec {
namespace {

constexpr int kStepRounds = 8;
constexpr double kRateSlope = 0.5;  // the size goes about as error^-kRateSlope
constexpr double kNear = 0.04;      // of the error asked for: sizes can be compared
// Relative doubt of a size from one trial: with 0.01, quad_box at --kg 0.1 grew by more effort.
constexpr double kDoubt = 0.03;
constexpr size_t kFirstComponents = 48;  // found at first; twice as many whenever all are of use
constexpr size_t kFewComponents = 16;    // of regions: steps of what is found at first
// The part of the whole's components is regions^this or less: on chicken, dance, horse and flag 0.5 to 0.7 in 2 and 4, 0.3 to 0.7 in 8.
constexpr double kComponentsOfRegions = -0.3;
constexpr size_t kRichComponents = 24;   // of clips whose surface is
constexpr size_t kFewestVertices = 200;  // of a region, on average
// Ratios to the bytes of the whole. By expectation, which ranks cuts badly, all below are tried;
// and to the best, by a trial that missed the error.
constexpr double kWorthTrying = 1.05, kFarFromBest = 1.06;
// Errors of first trials are above the estimate by 1.06 to 1.25, 1.2 to 1.44 and 1.36 to 1.9 in 2, 4 and 8 regions.
constexpr double kAimOfRegions = -0.24;

/// How near to the error asked for is near enough, at first and after a few trials, and where to aim,
/// as parts of it.
struct Nearness {
  double close, enough, aim;
};

// For Effort::kFirst. `anicodec_bench live` of dance, chicken, face, flag and horse took up to 3 % fewer bytes by this than by 0.93 and
// 0.97, and 1 to 16 % fewer by the lambda of pieces and weights that are fitted to what was decoded, all in as much time.
constexpr Nearness kFirst{0.97, 0.97, 0.985};
constexpr double kPieceLambda = 0.17;  // of pieces of live streams
constexpr Nearness kPlain{0.997, 0.994, 0.9985};
constexpr Nearness kThorough{0.991, 0.99, 0.996};  // errors vary by some thousandths
// Trials until `enough` is enough. On horse, face, chicken, dance and Fox, `encode` at its default, two trials took 0.84
// of the time of three for 0.5 % more bytes.
constexpr int kPatience = 3;
// Joint rounding raises the error by 1 to 7 %.
constexpr double kJointStep = 0.965;
// Settings whose first thorough trial shows more bytes than so many times those of the best found are not searched further: by
// the best effort, and by others.
constexpr double kWorthOfBest = 1.03, kWorthSearching = 0.99;
constexpr size_t kMostApproaches = 2;  // of all but the best effort
constexpr size_t kFewSteps = 4;        // before kinds are compared for the first time
constexpr size_t kMostFailures = 5;  // steps in a row that do not help end the search, but the best

size_t most_components(const LinearSettings& settings) {
  return settings.components.empty() ? 0 : std::ranges::max(settings.components);
}

/// Vertices of a region of a basis, or of the whole.
size_t vertices_of(const LinearBasis& basis, size_t region) {
  return basis.regions.empty() ? static_cast<size_t>(basis.pose.rows())
                               : basis.clips->vertices(region).size();
}

}  // namespace

LinearSearch::LinearSearch(const EncoderInput& input, const LinearAnalysis& analysis,
                           BasisKind kind, Effort effort, uint32_t layers, bool smallest,
                           uint32_t first_frame)
    : input_(input),
      analysis_(analysis),
      smallest_(smallest),
      first_frame_(first_frame),
      runs_(input.runs(first_frame, static_cast<uint32_t>(analysis.clip().frame_count))),
      kind_(kind),
      effort_(effort),
      bases_(std::make_unique<LinearBases>(input, analysis, kind, effort, smallest)) {
  const bool shapes = kind == BasisKind::kEigenshapes;
  choice_.pose = shapes ? ReferencePose::kMean : ReferencePose::kRankThree;
  choice_.base = shapes ? Base::kPose : Base::kAffine;
  choice_.settings.layers = layers;
  thorough_ = effort > Effort::kFast;
  for (uint32_t p = 0; p < kWeightPredictors; ++p) {
    const char* mean = mean_of(static_cast<WeightPredictor>(p));
    if (mean && !input.allows(mean))
      choice_.settings.weight_predictors &= ~(1U << p);
  }
  if (!shapes) {
    // Trajectories are many: half the time that prediction takes, for two bytes in a hundred.
    choice_.settings.neighbours = 12;
  }
  if (effort_ == Effort::kFirst || input.learning.hands_on) {
    choice_.settings.lambda = kPieceLambda;
    choice_.settings.refit_weights = input.allows(kRefittedWeightsMean);
  }
}

void LinearSearch::share_pose(std::shared_ptr<const EncodedPose> pose) {
  bases_->share_pose(std::move(pose));
  choice_.pose = ReferencePose::kGiven;
  choice_.base = Base::kAffine;
  chosen_ = true;
}

/// The choice with a step and a number of components that should meet the error.
LinearChoice LinearSearch::started(LinearChoice choice, double rmse) {
  rmse *= choice.aim;
  size_t first = kFirstComponents;
  if (choice.regions > 1) {
    const double some = choice.components_of_whole * std::pow(choice.regions, kComponentsOfRegions);
    first = (static_cast<size_t>(some) / kFewComponents + 1) * kFewComponents;
  }
  for (size_t wanted = first;; wanted *= 2) {
    choice.components_made = wanted;
    const LinearBasis& b = bases_->basis(choice);
    set_step(b, rmse, choice.settings);
    if (wanted >= LinearBases::kMostComponents || b.most_components() < wanted ||
        most_components(choice.settings) < wanted)
      return choice;
  }
}

/// The step and the components of a basis that should meet the error.
void LinearSearch::set_step(const LinearBasis& b, double rmse, LinearSettings& settings) const {
  const FrameView clip = analysis_.clip();
  const double budget = rmse * rmse * static_cast<double>(clip.vertex_count * clip.frame_count);
  // Bisection: the error of rounding and of what is left out grows with the step.
  // Without components the step is that of the pose, tied to the number of frames.
  double low = rmse * 1e-6;
  double high = 3 * rmse * std::sqrt(static_cast<double>(clip.frame_count));
  for (int round = 0; round < 60; ++round) {
    settings.components.clear();
    settings.step = std::sqrt(low * high);
    settings.components = component_counts(b, settings, clip.vertex_count, clip.frame_count);
    double unexplained = b.base_energy, coefficients = 0;
    for (size_t r = 0; r < settings.components.size(); ++r) {
      const LinearBasis& of_region = b.regions.empty() ? b : b.regions[r];
      const size_t k = settings.components[r];
      unexplained -= of_region.energies.head(static_cast<Eigen::Index>(k)).sum();
      coefficients += static_cast<double>(k * vertices_of(b, r) * traits_of(kind_).channels);
    }
    const double error =
        std::max(unexplained, 0.0) + 0.12 * coefficients * settings.step * settings.step;
    (error > budget ? high : low) = settings.step;
  }
}

void LinearSearch::begin(const LinearChoice& choice) const {
  const bool all_means = choice.settings.joint_lambda > 0 || choice.settings.refit_weights;
  input_.begin(all_means ? SearchStep::kThoroughTrial : SearchStep::kTrial);
}

LinearSearch::Measured LinearSearch::measured(const LinearChoice& choice, double rmse) {
  begin(choice);
  return trial(choice, rmse);
}

std::vector<LinearSearch::Measured> LinearSearch::measured(const std::vector<LinearChoice>& choices,
                                                           double rmse) {
  std::vector<Measured> trials(choices.size());
  for (const LinearChoice& choice : choices)
    begin(choice);
  parallel_tasks(choices.size(), [&](size_t i) { trials[i] = trial(choices[i], rmse); });
  return trials;
}

LinearSearch::Measured LinearSearch::trial(const LinearChoice& choice, double rmse) {
  Measured m;
  std::optional<EncodedSegment> encoded = encode_linear(
      analysis_.clip(), bases_->basis(choice), choice.settings, input_.layout,
      bases_->coded_pose(choice), runs_, bases_->shared_pose() ? input_.learning : Learning());
  if (!encoded) {
    m.rmse = m.bytes = std::numeric_limits<double>::infinity();
    return m;
  }
  m.segment.encoded = std::move(*encoded);
  m.segment.opened = open_encoded(m.segment.encoded, input_.layout);
  m.segment.error = measure(m.segment.opened, analysis_.clip(), input_.copies);
  m.segment.what = std::to_string(m.segment.encoded.sizes.components) +
                   (kind_ == BasisKind::kEigenshapes ? " eigenshapes" : " eigentrajectories");
  if (choice.regions > 1)
    m.segment.what += " in " + std::to_string(choice.regions) + " regions";
  for (const char* step : choice.steps)
    m.segment.what += std::string(", ") + step;
  char text[32];  // what trials of the same settings differ in
  std::snprintf(text, sizeof text, ", step %.3g", choice.settings.step);
  m.segment.what += text;
  m.rmse = input_.rmse(m.segment.error.squared, analysis_.clip().frame_count);
  if (input_.bounds_clips()) {
    m.excesses = input_.excesses(m.segment.error, first_frame_, rmse);
    m.rmse = rmse * std::ranges::max(m.excesses);
  }
  m.segment.opening =
      bytes_per_nanosecond(smallest_) * opening_nanoseconds(choice.settings, m.segment.encoded,
                                                            input_.layout.topology.coded_vertices);
  m.bytes = bytes(m.segment) * std::pow(std::max(m.rmse, rmse * 1e-3) / rmse, kRateSlope);
  return m;
}

/// Clips that are further below their bound than the worst can do with coarser weights.
void LinearSearch::even_out(const Measured& trial, LinearChoice& choice) {
  constexpr double kMost = 32, kPart = 0.8;  // in eighths of an octave; of the distance at a time
  const double worst = trial.excesses.empty() ? 0 : std::ranges::max(trial.excesses);
  if (trial.excesses.size() < 2 || !(worst > 0) || std::isinf(trial.rmse))
    return;
  std::vector<uint8_t>& steps = choice.settings.run_steps;
  steps.resize(trial.excesses.size(), 0);
  std::vector<double> wanted;
  for (size_t r = 0; r < steps.size(); ++r)
    wanted.push_back(steps[r] + kPart * 8 * std::log2(worst / std::max(trial.excesses[r], 1e-3)));
  const double least = std::ranges::min(wanted);
  for (size_t r = 0; r < steps.size(); ++r)
    steps[r] = static_cast<uint8_t>(std::lround(std::min(wanted[r] - least, kMost)));
}

/// A trial of a started choice tells how far its estimate was off, and what a bit saves of the
/// squared error along the curve of rates.
void LinearSearch::learn(const Measured& trial, double rmse, LinearChoice& choice) {
  if (!(trial.rmse > 0) || std::isinf(trial.rmse))
    return;
  choice.aim = std::clamp(choice.aim * kPlain.aim * rmse / trial.rmse, 0.2, 5.0);
  const double step = choice.settings.step, bits = 8 * std::max(trial.bytes, 1.0);
  choice.price = trial.segment.error.squared / (step * step) / (kRateSlope / 2 * bits);
  even_out(trial, choice);
}

double LinearSearch::probe_once(double rmse) {
  choice_ = started(choice_, rmse);
  const Measured trial = measured(choice_, rmse);
  probed_ = probed(trial, rmse);
  learn(trial, rmse, choice_);
  return probed_.bytes;
}

double LinearSearch::probe(double rmse) {
  constexpr int kMostTrials = 3;
  if (probed_.rmse != rmse)
    probe_once(rmse);
  for (int round = 1; round < kMostTrials && !probed_.is_near; ++round)
    probe_once(rmse);
  if (tries_regions())
    try_regions(rmse);
  return probed_.bytes;
}

void LinearSearch::open_like(const LinearSearch& other) {
  std::erase_if(opening_steps_, [&](const LinearStep& step) {
    return std::ranges::find(other.choice_.steps, step.name) == other.choice_.steps.end();
  });
}

bool LinearSearch::tries_regions() const {
  return !bases_->shared_pose() && effort_ > Effort::kFast &&
         kind_ == BasisKind::kEigentrajectories && input_.allows(kRegionsMean);
}

LinearSearch::Probed LinearSearch::probed(const Measured& trial, double rmse) {
  Probed result{rmse, trial.bytes, std::abs(trial.rmse / rmse - 1) < kNear};
  const EncodedSegment& encoded = trial.segment.encoded;
  result.weights = static_cast<double>(encoded.weights.size());
  for (const Bytes& layer : encoded.layers)
    result.weights += static_cast<double>(layer.size());
  result.coefficients = static_cast<double>(encoded.coefficient_bytes);
  result.weights -= result.coefficients;
  return result;
}

/// Estimates the bytes of weights and coefficients of a started choice with regions from the bytes
/// of the whole: coefficients of a region are fewer and dearer, for they have more of the motion.
double LinearSearch::expected_bytes(const LinearChoice& choice) {
  constexpr double kOfWeight = 0.9, kOfCoefficient = 1.5;  // measured on pcow, crane, jumping
  const LinearBasis& b = bases_->basis(choice);
  const auto whole = static_cast<double>(most_components(choice_.settings));
  double weights = 0, coefficients = 0;
  for (size_t r = 0; r < choice.settings.components.size(); ++r) {
    const auto k = static_cast<double>(choice.settings.components[r]);
    weights += k / whole;
    coefficients += k / whole * static_cast<double>(vertices_of(b, r)) /
                    static_cast<double>(analysis_.clip().vertex_count);
  }
  return kOfWeight * weights * probed_.weights +
         kOfCoefficient * coefficients * probed_.coefficients;
}

/// Cuts the surface where the clip takes many components, memory allows it, and that is smaller.
void LinearSearch::try_regions(double rmse) {
  if (tried_regions_ || most_components(choice_.settings) < kRichComponents)
    return;
  tried_regions_ = true;
  const double whole = probed_.weights + probed_.coefficients;
  std::vector<LinearChoice> possible, cuts;
  for (uint32_t regions : {2U, 4U, 8U}) {
    if (analysis_.clip().vertex_count < size_t{regions} * kFewestVertices)
      continue;
    LinearChoice cut = choice_;
    cut.regions = regions;
    cut.components_of_whole = static_cast<double>(most_components(choice_.settings));
    cut.aim *= std::pow(regions, kAimOfRegions);
    try {
      bases_->reserve(cut);
      possible.push_back(std::move(cut));
    } catch (const OverMemory&) {  // fewer regions may do, and one does
    }
  }
  bases_->analyse(possible);
  for (const LinearChoice& cut : possible) {
    input_.begin(SearchStep::kAnalysis);
    try {
      LinearChoice begun = started(cut, rmse);
      if (expected_bytes(begun) < kWorthTrying * whole)
        cuts.push_back(std::move(begun));
    } catch (const OverMemory&) {  // of its bases
    }
  }
  if (cuts.empty())
    return;
  std::vector<Measured> trials = measured(cuts, rmse);
  const double least = std::ranges::min(trials, {}, &Measured::bytes).bytes;
  parallel_tasks(cuts.size(), [&](size_t i) {
    LinearChoice& cut = cuts[i];
    Measured& trial = trials[i];
    learn(trial, rmse, cut);
    if (std::abs(trial.rmse / rmse - 1) > kNear &&
        trial.bytes < kFarFromBest * std::min(least, probed_.bytes)) {
      cut = started(cut, rmse);
      trial = measured(cut, rmse);
      learn(trial, rmse, cut);
    }
  });
  for (size_t i = 0; i < cuts.size(); ++i) {
    LinearChoice& cut = cuts[i];
    const Measured& trial = trials[i];
    if (!(trial.bytes < probed_.bytes))
      continue;
    if (choice_.regions == 1)
      earlier_.push_back({choice_, probed_.bytes});
    probed_ = probed(trial, rmse);
    choice_ = std::move(cut);
  }
}

double LinearSearch::choose_settings(double rmse, Steps wanted) {
  if (chosen_ || effort_ == Effort::kFirst)
    return least_;
  if (steps_done_ == 0) {
    least_rmse_ = rmse;
    least_ = probe(rmse);
  }
  if (effort_ > Effort::kFast) {
    const std::vector<LinearStep>& all = linear_steps();
    const auto normal = static_cast<size_t>(
        std::ranges::find(all, Effort::kBest, &LinearStep::least) - all.begin());
    for (const size_t end : {kFewSteps, normal, effort_ == Effort::kBest ? all.size() : normal}) {
      std::vector<LinearStep> steps;
      for (; steps_done_ < end; ++steps_done_) {
        if (input_.allows(all[steps_done_].name))
          steps.push_back(all[steps_done_]);
      }
      Candidate before{choice_, least_};
      if (try_steps(steps, rmse))
        earlier_.push_back(std::move(before));
      if (wanted == Steps::kFew)
        return least_;
    }
    if (wanted == Steps::kAll)
      return least_;
    failures_ = 0;
    if (!smallest_)
      try_steps(opening_steps_, rmse);
  }
  chosen_ = true;
  return least_;
}

/// Tries each step on top of the kept ones and keeps it if it helps. One step per thread at a
/// time; after a success the later ones are tried again.
bool LinearSearch::try_steps(std::span<const LinearStep> steps, double rmse) {
  const auto threads = thread_count();
  const size_t most_failures = effort_ == Effort::kBest ? steps.size() + failures_ : kMostFailures;
  bool changes = false;
  std::vector<LinearStep> left(steps.begin(), steps.end());
  while (!left.empty() && failures_ < most_failures) {
    std::vector<LinearChoice> changed;
    for (const LinearStep& step :
         std::span(left).first(std::min({threads, left.size(), most_failures - failures_}))) {
      LinearChoice& choice = changed.emplace_back(choice_);
      step.change(choice, kind_);
      try {
        choice = started(choice, rmse);
      } catch (const OverMemory&) {  // of a basis that the step needs
        choice = choice_;
      }
    }
    const std::vector<Measured> trials = measured(changed, rmse);
    const auto helps =
        std::ranges::find_if(trials, [&](const Measured& trial) { return trial.bytes < least_; });
    const auto at = static_cast<size_t>(helps - trials.begin());
    const size_t done = std::min(at + 1, changed.size());
    if (helps != trials.end()) {
      least_ = helps->bytes;
      choice_ = changed[at];
      choice_.steps.push_back(meaning_of(left[at], choice_));
      learn(*helps, rmse, choice_);
      changes = true;
    }
    failures_ = helps != trials.end() ? 0 : failures_ + done;
    // A change that did not help does not help again.
    const auto failed = helps != trials.end() ? nullptr : left[done - 1].change;
    left.erase(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(done));
    while (!left.empty() && failed && left[0].change == failed)
      left.erase(left.begin());
  }
  return changes;
}

double LinearSearch::prepare(double rmse) {
  choose_settings(rmse, Steps::kOpening);
  approaches_.clear();
  approaches_.emplace_back(choice_);
  // One trial tells a size but roughly: what fewer steps end with may be smaller yet.
  std::ranges::reverse(earlier_);
  for (Candidate& earlier : earlier_) {
    const bool may_be_smaller =
        approaches_.size() < kMostApproaches && earlier.bytes * (1 - kDoubt) <= least_;
    if (may_be_smaller || effort_ == Effort::kBest)
      approaches_.emplace_back(std::move(earlier.choice));
  }
  earlier_.clear();
  asked_ = rmse;
  parallel_tasks(approaches_.size(), [&](size_t i) { advance(approaches_[i]); });
  std::ranges::stable_sort(approaches_, {}, &Approach::expected);
  return approaches_[0].expected;
}

std::optional<CodedSegment> LinearSearch::at_rmse(double rmse) {
  if (!(rmse > 0))
    return std::nullopt;
  if (approaches_.empty() || asked_ != rmse)
    prepare(rmse);
  std::optional<CodedSegment> best;
  double worth = std::exchange(most_bytes_, kNoLimit);
  for (Approach& approach : approaches_) {
    if (approach.expected > worth)
      continue;
    std::optional<CodedSegment> segment = reached(approach);
    if (!segment || (best && bytes(*segment) >= bytes(*best)))
      continue;
    best = std::move(segment);
    choice_ = std::move(approach.choice);
    worth =
        std::min(worth, (effort_ == Effort::kBest ? kWorthOfBest : kWorthSearching) * bytes(*best));
  }
  approaches_.clear();
  if (thorough_ && best && least_ > 0 &&
      bytes(*best) > least_ * std::pow(least_rmse_ / rmse, kRateSlope))
    turn_down(rmse, *best);
  least_ = 0;
  return best;
}

std::optional<CodedSegment> LinearSearch::near_rmse(double rmse) {
  if (!(rmse > 0))
    return std::nullopt;
  Measured trial = measured(started(choice_, rmse), rmse);
  if (std::isinf(trial.rmse))
    return std::nullopt;
  return std::move(trial.segment);
}

/// Does without the means that take longer where that is smaller.
void LinearSearch::turn_down(double rmse, CodedSegment& best) {
  thorough_ = false;
  Approach approach(choice_);
  approach.choice.step_factor = 0;
  asked_ = rmse;
  std::optional<CodedSegment> plain = reached(approach);
  thorough_ = !plain || bytes(*plain) >= bytes(best);
  if (thorough_)
    return;
  best = std::move(*plain);
  choice_ = std::move(approach.choice);
}

/// One more trial on the way to the error asked for.
void LinearSearch::advance(Approach& a) {
  const Nearness& near = thorough_ ? kThorough : effort_ > Effort::kFirst ? kPlain : kFirst;
  LinearChoice& tried = a.tried;
  if (a.round == 0) {
    tried = started(a.choice, asked_);
    a.estimated = tried.settings.step;
    tried.settings.step *= a.choice.step_factor > 0 ? a.choice.step_factor
                           : thorough_              ? kJointStep
                                                    : 1;
  } else {
    tried.settings.step = a.secant.next(near.aim, 1);
  }
  if (thorough_) {
    tried.settings.joint_lambda = input_.allows(kJointRoundingMean) ? tried.price : 0;
    tried.settings.refit_weights = input_.allows(kRefittedWeightsMean);
  }
  Measured trial = measured(tried, asked_);
  if (a.round == 0)
    a.expected = trial.bytes;
  if (std::isinf(trial.rmse)) {
    a.ended = true;
    return;
  }
  if (tried.price == 0)
    learn(trial, asked_, tried);
  else if (a.round < kStepRounds / 2)
    even_out(trial, tried);
  const double ratio = std::max(trial.rmse / asked_, 1e-9), step = tried.settings.step;
  if (ratio <= 1) {
    a.closest = std::max(a.closest, ratio);
    if (!a.best || bytes(trial.segment) < bytes(*a.best)) {
      a.best = std::move(trial.segment);
      a.choice.step_factor = step / a.estimated;
    }
  }
  a.ended =
      a.closest >= (a.round < kPatience ? near.close : near.enough) || a.round + 1 == kStepRounds;
  if (a.round >= kPatience && !a.best) {
    // The components left out alone take most of the error: more of them.
    for (size_t& k : tried.settings.components)
      k += k / 16 + 1;
    a.secant = Secant({a.secant.exponent(), kLeastExponent, kMostExponent});
  }
  a.secant.add(step, ratio);
  ++a.round;
}

/// Meets the error. The choice keeps what helps to meet the next one sooner.
std::optional<CodedSegment> LinearSearch::reached(Approach& approach) {
  while (!approach.ended)
    advance(approach);
  approach.choice.exponent = approach.secant.exponent();
  if (approach.best)
    approach.best->asked = asked_;
  return std::move(approach.best);
}

/// The bytes that the segment takes in the file, and the price of its opening.
double LinearSearch::bytes(const CodedSegment& segment) const {
  const size_t pose = bases_->shared_pose() ? 0 : segment.encoded.reference->stream.size();
  return static_cast<double>(segment.encoded.bytes() + pose) + segment.opening;
}

}  // namespace anicodec
