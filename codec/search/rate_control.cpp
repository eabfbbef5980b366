// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/rate_control.h"

#include "codec/algebra/gram.h"
#include "codec/file/clip_file.h"
#include "codec/search/linear_coder.h"
#include "codec/search/time_segmentation.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace anicodec {
namespace {

constexpr uint32_t kLayers = 3;
constexpr double kFarBehind = 1.15;

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

}  // namespace

Target in_scene_units(Target target, double diagonal) {
  if (target.metric == ErrorMetric::kNone)
    return target;
  bool positive = std::isfinite(target.value) && target.value > 0;
  if (target.metric == ErrorMetric::kMaxError && target.value == 0 && std::isfinite(target.value))
    throw Error(ErrorKind::kUsage,
                "a maximum error of 0 needs a lossless mode, which there is not");
  if (!positive)
    throw Error(ErrorKind::kUsage, "the target must be greater than 0");
  if (target.percent) {
    target.value *= diagonal / 100;
    target.percent = false;
  }
  return target;
}

std::vector<const EncodedSegment*> Solution::segments() const {
  std::vector<const EncodedSegment*> list;
  for (const CodedPart& part : parts)
    list.push_back(&part.encoded);
  return list;
}

double Solution::squared_error() const {
  double sum = 0;
  for (const CodedPart& part : parts)
    sum += part.error.squared;
  return sum;
}

double Solution::max_error() const {
  double largest = 0;
  for (const CodedPart& part : parts)
    largest = std::max(largest, part.error.max);
  return largest;
}

RateControl::RateControl(const EncoderInput& input, const EncodeOptions& options,
                         const Target& target, double diagonal)
    : input_(input), options_(options), target_(target), diagonal_(diagonal) {
  if (options.cap)
    cap_ = in_scene_units(*options.cap, diagonal).value;
  std::optional<double> bound = cap_;
  if (target.metric == ErrorMetric::kMaxError)
    bound = target.value;
  if (bound && *bound < smallest_bound() && *bound > 0)
    throw Error(ErrorKind::kUsage,
                "the maximum error is below what float32 keeps at these coordinates; the smallest "
                "possible is " +
                    number(smallest_bound()));
}

/// A position is rounded a few times on its way: allow four units in the last place.
double RateControl::smallest_bound() const {
  return std::max(input_.largest_coordinate * 0x1p-21, 1e-30);
}

double RateControl::rmse_of_kg(double kg) const {
  return kg / 100 *
         std::sqrt(input_.kg_reference / input_.sequence.vertex_count /
                   input_.sequence.frame_count);
}

Solution RateControl::finished(std::vector<CodedPart> parts) {
  Solution solution;
  solution.parts = std::move(parts);
  std::string what;
  for (CodedPart& part : solution.parts) {
    const Limits::Segment& sizes = part.encoded.sizes;
    FrameView frames = input_.frames(sizes.first_frame, sizes.frames);
    if (cap_) {
      correct(frames, input_.copies, *cap_, part.opened, part.encoded);
      part.error = measure(part.opened, frames, input_.copies);
    }
    what += (what.empty() ? "" : " + ") + part.what;
  }
  ClipRecord record;
  record.name = input_.sequence.name;
  record.encoder = options_.encoder;
  record.times.assign(input_.sequence.times.begin(), input_.sequence.times.end());
  record.order = options_.order;
  solution.bytes = clip_file(record, input_.layout, solution.segments()).size();
  trials_.push_back(
      {what, solution.bytes, input_.rmse(solution.squared_error()), solution.max_error()});
  return solution;
}

std::optional<Solution> RateControl::at_rmse(SegmentCoder& coder, double rmse) {
  std::optional<CodedPart> part;
  try {
    part = coder.at_rmse(rmse);
  } catch (const TooFine&) {
  }
  if (!part)
    return std::nullopt;
  std::vector<CodedPart> parts;
  parts.push_back(std::move(*part));
  return finished(std::move(parts));
}

std::optional<Solution> RateControl::at_max_error(SegmentCoder& coder, double bound) {
  if (bound == 0)  // per cent of nothing: all vertices are one point that stands still
    return at_rmse(coder, smallest_bound());
  // Corrections take care of the outliers: how many are worth having is measured, going from a
  // usual ratio of maximum to mean error in the direction that pays.
  cap_ = bound - smallest_bound() / 4;
  std::optional<Solution> best;
  auto trial_is_better = [&](double ratio) {
    std::optional<Solution> trial = at_rmse(coder, bound / ratio);
    if (!trial || (best && trial->bytes >= best->bytes))
      return false;
    best = std::move(trial);
    return true;
  };
  constexpr double kUsual = 4, kFactor = 1.4;
  trial_is_better(kUsual);
  bool higher = trial_is_better(kUsual * kFactor);
  double factor = higher ? kFactor : 1 / kFactor;
  double ratio = higher ? kUsual * kFactor : kUsual;
  for (int round = 0; round < 3 && trial_is_better(ratio *= factor); ++round) {
  }
  return best;
}

std::optional<Solution> RateControl::at_bytes(SegmentCoder& coder, size_t bytes) {
  // The size falls as the error grows: bisection on its logarithm.
  double low = smallest_bound(), high = std::max(rmse_of_kg(100), 2 * low);
  std::optional<Solution> best;
  for (int round = 0; round < 12 && high / low > 1.01; ++round) {
    double middle = std::sqrt(low * high);
    std::optional<Solution> trial = at_rmse(coder, middle);
    bool fits = trial && trial->bytes <= bytes;
    if (fits && (!best || trial->squared_error() < best->squared_error()))
      best = std::move(trial);
    (fits ? high : low) = middle;
  }
  return best;
}

std::optional<Solution> RateControl::reach(SegmentCoder& coder) {
  switch (target_.metric) {
    case ErrorMetric::kKg:
      return at_rmse(coder, rmse_of_kg(target_.value));
    case ErrorMetric::kRmse:
      return at_rmse(coder, target_.value);
    case ErrorMetric::kMaxError:
      return at_max_error(coder, target_.value);
    case ErrorMetric::kSize:
      return at_bytes(coder, static_cast<size_t>(target_.value));
    case ErrorMetric::kBpfv:
      return at_bytes(coder, static_cast<size_t>(target_.value / 8 * input_.sequence.vertex_count *
                                                 input_.sequence.frame_count));
    case ErrorMetric::kNone:
      break;
  }
  return std::nullopt;
}

Solution RateControl::solve() {
  Solution solution = search();
  for (CodedPart& part : solution.parts) {
    if (!part.encoded.corrections.empty())  // added after it was opened: its hash covers them
      part.opened = open_encoded(part.encoded, input_.layout);
  }
  return solution;
}

Solution RateControl::search() {
  bool keyframes_alone = options_.basis == BasisChoice::kKeyframes || options_.keyframes;
  std::optional<Solution> best;
  auto offer = [&](SegmentCoder& coder) {
    std::optional<Solution> solution = reach(coder);
    if (solution && (!best || better(*solution, *best)))
      best = std::move(solution);
  };
  if (keyframes_alone) {
    std::vector<std::unique_ptr<KeyframeCoder>> ways;
    if (options_.interpolation != InterpolationChoice::kMsgi)
      ways.push_back(std::make_unique<KeyframeCoder>(input_, options_.select, options_.keyframes,
                                                     Reconstruction::kLinear));
    if (options_.interpolation != InterpolationChoice::kLinear)
      ways.push_back(std::make_unique<KeyframeCoder>(input_, options_.select, options_.keyframes,
                                                     Reconstruction::kMsgi));
    for (std::unique_ptr<KeyframeCoder>& keyframes : ways) {
      if (target_.metric != ErrorMetric::kNone) {
        offer(*keyframes);
        continue;
      }
      // As many bytes but for a few: what counts is the error.
      std::vector<CodedPart> parts;
      parts.push_back(keyframes->at_count());
      Solution solution = finished(std::move(parts));
      if (!best || solution.squared_error() < best->squared_error())
        best = std::move(solution);
    }
    if (!best)
      fail(*ways[0]);
    return std::move(*best);
  }
  LinearAnalysis analysis(input_.frames());
  std::vector<std::unique_ptr<LinearCoder>> coders;
  for (BasisKind kind : {BasisKind::kEigentrajectories, BasisKind::kEigenshapes}) {
    BasisChoice choice = kind == BasisKind::kEigenshapes ? BasisChoice::kEigenshapes
                                                         : BasisChoice::kEigentrajectories;
    if (options_.basis == BasisChoice::kAuto || options_.basis == choice)
      coders.push_back(
          std::make_unique<LinearCoder>(input_, analysis, kind, options_.effort, kLayers));
  }
  for (std::unique_ptr<LinearCoder>& coder : coders) {
    if (input_.pose)
      coder->share_pose(input_.pose);
  }
  if (coders.size() == 2) {
    // A kind that one trial shows to be far behind is not searched.
    double rmse = typical_rmse();
    double bytes[2] = {coders[0]->probe(rmse), coders[1]->probe(rmse)};
    if (std::max(bytes[0], bytes[1]) > kFarBehind * std::min(bytes[0], bytes[1]))
      coders.erase(coders.begin() + (bytes[0] < bytes[1] ? 1 : 0));
  }
  for (std::unique_ptr<LinearCoder>& coder : coders)
    offer(*coder);
  if (best) {
    BasisKind kind = best->parts[0].encoded.sizes.kind;
    for (std::unique_ptr<LinearCoder>& coder : coders) {
      if (coder->kind() != kind)
        continue;
      std::optional<Solution> cut = cut_in_time(*best, *coder);
      if (cut && better(*cut, *best))
        best = std::move(cut);
      break;
    }
  }
  if (options_.basis == BasisChoice::kAuto && !input_.pose && !(best && beats_keyframes(*best))) {
    KeyframeCoder keyframes(input_, options_.select, options_.keyframes, Reconstruction::kLinear);
    offer(keyframes);
  }
  if (!best)
    fail();
  return std::move(*best);
}

std::optional<Solution> RateControl::cut_in_time(const Solution& whole, const LinearCoder& coder) {
  double rmse = whole.parts[0].asked;
  TimeSegmentation segmentation(input_, coder, whole.parts[0].encoded.reference, rmse);
  std::vector<FrameRange> ranges = segmentation.find();
  if (ranges.size() < 2)
    return std::nullopt;
  std::vector<CodedPart> parts;
  for (const FrameRange& range : ranges) {
    std::optional<CodedPart> part = segmentation.coded(range);
    if (!part)
      return std::nullopt;
    part->encoded.sizes.first_frame = range.first;
    parts.push_back(std::move(*part));
  }
  return finished(std::move(parts));
}

double RateControl::typical_rmse() const {
  switch (target_.metric) {
    case ErrorMetric::kKg:
      return rmse_of_kg(target_.value);
    case ErrorMetric::kRmse:
      return target_.value;
    case ErrorMetric::kMaxError:
      return std::max(target_.value, smallest_bound()) / 4;
    default:
      return rmse_of_kg(0.1);
  }
}

bool RateControl::beats_keyframes(const Solution& solution) const {
  // No fewer key-frames than principal components can do, each at a bit per coordinate at least.
  std::vector<double> left = principal_errors(frame_gram(input_.frames()).clip_centred());
  size_t k = 0;
  while (k + 1 < left.size() && left[k] > solution.squared_error())
    ++k;
  return static_cast<double>(k) * 3 * input_.layout.sizes.coded_vertices / 8 >
         static_cast<double>(solution.bytes);
}

bool RateControl::better(const Solution& a, const Solution& b) const {
  if (target_.metric == ErrorMetric::kSize || target_.metric == ErrorMetric::kBpfv)
    return a.squared_error() < b.squared_error();
  return a.bytes < b.bytes;
}

void RateControl::fail() const {
  std::string text = "the target cannot be reached";
  if (target_.metric == ErrorMetric::kSize || target_.metric == ErrorMetric::kBpfv) {
    auto smallest = std::ranges::min_element(trials_, {}, &Trial::bytes);
    if (smallest != trials_.end())
      text += "; the smallest file found takes " + std::to_string(smallest->bytes) + " bytes";
  }
  throw Error(ErrorKind::kUsage, text);
}

double RateControl::expected_trials() const {
  constexpr double kOfOneError = 3;  // until an error is met
  double settings = 2 * options_.effort - 3;
  switch (target_.metric) {
    case ErrorMetric::kMaxError:
      return std::max(settings, 0.0) + 4 * kOfOneError;
    case ErrorMetric::kSize:
    case ErrorMetric::kBpfv:
      return std::max(settings, 0.0) + 11 * kOfOneError;
    default:
      return std::max(settings, 0.0) + kOfOneError;
  }
}

void RateControl::fail(KeyframeCoder& keyframes) {
  std::string text = "the target cannot be reached";
  if (options_.keyframes) {
    double rmse = input_.rmse(keyframes.at_count().error.squared);
    text += " with " + std::to_string(*options_.keyframes) +
            " key-frames; the best is a KG error of " + number(100 * rmse / rmse_of_kg(100)) +
            " %, an RMSE of " + number(rmse);
  }
  throw Error(ErrorKind::kUsage, text);
}

void RateControl::require_kept(double kg, double rmse, double max_error, size_t bytes) const {
  double value = target_.value;
  bool kept = true;
  switch (target_.metric) {
    case ErrorMetric::kKg:
      kept = kg <= value;
      break;
    case ErrorMetric::kRmse:
      kept = rmse <= value;
      break;
    case ErrorMetric::kMaxError:
      kept = max_error <= value;
      break;
    case ErrorMetric::kSize:
      kept = static_cast<double>(bytes) <= value;
      break;
    case ErrorMetric::kBpfv:
      kept = 8.0 * static_cast<double>(bytes) <=
             value * input_.sequence.vertex_count * input_.sequence.frame_count;
      break;
    case ErrorMetric::kNone:
      break;
  }
  if (cap_ && target_.metric != ErrorMetric::kMaxError)
    kept &= max_error <= *cap_;
  if (!kept)
    throw Error(ErrorKind::kInternal, "the encoded file does not keep what was asked");
}

}  // namespace anicodec
