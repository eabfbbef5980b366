// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/basis_search.h"

#include "codec/motion/motion_products.h"
#include "codec/parallel/parallel.h"
#include "codec/search/time_segmentation.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <string>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kLayers = 3;
// Times the bytes of the other kind, above which a kind is not searched before settings are chosen. Flag at --kg 0.5 and 1
// takes 13 and 15 % more with 1.08.
constexpr double kFarBehind = 1.15;
// The same of eigentrajectories and eigenshapes after some are chosen. Joint rounding takes 2 to 10 % off trajectories and
// 5 to 14 % off shapes.
constexpr double kBehind[] = {1.04, 1.16};
// The same by one trial each. It is within 8 % of what further ones show: `encode` of dance, horse, chicken, flag and
// face, by default and with --kg 0.1% and 1%.
constexpr double kHopeless = 1.3;

// Files that decoders may refuse have to be clearly smaller.
constexpr double kClearly = 0.9;
// Key-frames of helix, the clip of the corpus that MSGI suits, take 2.8 bits per coordinate at --kg 0.1%; the
// fewer are believed, the more key-frames are tried.
constexpr double kBitsOfMsgi = 2;
constexpr size_t kMostMsgiKeyframes = 48;
// An object that moves so simply that few key-frames and bytes do is not searched further, as scenes have thousands of
// them: what is left to save are single bytes.
constexpr size_t kMostOfSimple = 1 << 14;  // positions of all frames
constexpr size_t kKeyframesOfSimple = 4, kBytesOfSimple = 96;
// A file of fewer bytes cannot save enough for what MSGI costs a decoder.
constexpr size_t kFewestBytesOfMsgi = 1024;
// The most that weights and a choice of key-frames win on evenly spread ones.
constexpr double kHopelessMsgi = 8;

size_t bytes_of_segments(const Solution& solution) {
  size_t bytes = 0;
  for (const CodedSegment& segment : solution.segments)
    bytes += segment.encoded.bytes();
  return bytes;
}

}  // namespace

Solution BasisSearch::solve() {
  notes_.clear();
  constexpr double kProbes = 8;
  TrialsLeft all = search_.expected(options_.basis == BasisChoice::kAuto ? 2 : 1, false);
  all.plain += kProbes;
  input_.expect(all);
  std::optional<Solution> best;
  const bool apart = input_.bounds_differ();
  try {
    best = of_all_clips();
  } catch (const Error& error) {
    if (!apart || error.kind() != ErrorKind::kUsage)
      throw;
  }
  if (apart)
    search_.keep_better(clip_by_clip(), &best);
  if (!best)
    fail();
  if (!is_size(bound_.metric)) {  // nobody asks again
    linear_searches_.clear();
    keyframe_searches_.clear();
    analysis_.reset();
  }
  for (CodedSegment& segment : best->segments) {
    if (!segment.encoded.corrections.empty())  // added after it was opened: its hash covers them
      segment.opened = open_encoded(segment.encoded, input_.layout);
  }
  return std::move(*best);
}

/// Each clip by a basis of its own, which may be as fine as it needs.
std::optional<Solution> BasisSearch::clip_by_clip() {
  std::vector<CodedSegment> segments;
  for (size_t c = 0; c < input_.clips.size(); ++c) {
    const EncoderInput clip(input_, c);
    Bound own = bound_;
    if (own.metric != ErrorMetric::kKg)
      own.value *= input_.clips[c].tolerance;
    for (CodedSegment& segment : BasisSearch(clip, options_, own).solve().segments) {
      segment.encoded.sizes.first_frame += input_.clips[c].frames.first;
      segments.push_back(std::move(segment));
    }
  }
  return search_.files().put_together(std::move(segments));
}

std::optional<Solution> BasisSearch::of_all_clips() {
  std::optional<Solution> best;
  if (options_.basis == BasisChoice::kKeyframes || options_.keyframes) {
    best = by_keyframes_alone();
  } else {
    if (may_be_simple()) {
      offer_keyframes(&best);
      if (best && bytes_of_segments(*best) <= kBytesOfSimple)
        return best;
      best.reset();
    }
    best = by_linear_bases();
    // In a long clip only if nothing else keeps the target.
    if (tries_keyframes(!best) && !(best && beats_keyframes(*best)))
      offer_keyframes(&best);
    if (best && allows_msgi())
      try_msgi(&*best);
    if (options_.basis == BasisChoice::kAuto && keyframe_searches_.empty() &&
        input_.sequence.frame_count > kMostMultiplied)
      notes_.push_back("key-frames are not tried: the clip has more than " +
                       std::to_string(kMostMultiplied) + " frames");
  }
  return best;
}

Solution BasisSearch::solve_within(double bytes) {
  bound_ = {ErrorMetric::kSize, bytes};
  search_.ask_size(bytes);
  return solve();
}

void BasisSearch::add_keyframe_search(Reconstruction reconstruction) {
  input_.begin(SearchStep::kAnalysis);
  keyframe_searches_.push_back(std::make_unique<KeyframeSearch>(
      input_, options_.select, options_.keyframes, options_.keyframe_poses, reconstruction));
}

void BasisSearch::offer(SegmentSearch& search, std::optional<Solution>* best) {
  search_.keep_better(search_.reach(search, best->has_value() ? &**best : nullptr), best);
}

void BasisSearch::offer_keyframes(std::optional<Solution>* best) {
  if (keyframe_searches_.empty())
    add_keyframe_search(Reconstruction::kLinear);
  if (*best && search_.rmse_asked())
    keyframe_searches_[0]->give_up_above(kHopeless * static_cast<double>((*best)->bytes));
  offer(*keyframe_searches_[0], best);
}

bool BasisSearch::may_be_simple() {
  if (!tries_keyframes(false) || options_.effort == Effort::kBest || is_size(bound_.metric) ||
      size_t{input_.layout.sizes.coded_vertices} * input_.sequence.frame_count > kMostOfSimple)
    return false;
  if (keyframe_searches_.empty())
    add_keyframe_search(Reconstruction::kLinear);
  KeyframeSearch& search = *keyframe_searches_[0];
  return search.count_at(search_.typical_rmse(search)) <= kKeyframesOfSimple;
}

bool BasisSearch::tries_keyframes(bool of_any_clip) const {
  return options_.basis == BasisChoice::kAuto && !input_.pose &&
         (of_any_clip || input_.sequence.frame_count <= kMostMultiplied);
}

bool BasisSearch::allows_msgi() const {
  return tries_keyframes(false) && options_.effort > Effort::kFirst &&
         options_.interpolation.value_or(InterpolationChoice::kAuto) !=
             InterpolationChoice::kLinear &&
         input_.layout.sizes.triangles > 0;
}

void BasisSearch::try_msgi(Solution* best) {
  if (!options_.interpolation && best->bytes < kFewestBytesOfMsgi)
    return note("the positions take " + std::to_string(best->bytes) + " bytes, too few to save on");
  const double rmse = input_.rmse(best->squared_error());
  const double keyframe = kBitsOfMsgi / 8 * 3 * input_.layout.sizes.coded_vertices;
  const auto most = static_cast<size_t>(kClearly * static_cast<double>(best->bytes) / keyframe);
  const size_t count =
      std::min({most, kMostMsgiKeyframes, size_t{input_.sequence.frame_count} / 2});
  if (count < 2)
    return note("the file has not the bytes of two key-frames");
  const std::optional<double> left =
      msgi_error_between(input_.frames(), input_.layout.topology.triangles, count);
  if (!left)
    return note("the mesh is not for it");
  if (*left > kHopelessMsgi * rmse)
    return note("halfway between " + std::to_string(count) +
                " key-frames, which take as many bytes, an RMSE of " + four_digits(*left) +
                " is left");
  if (!msgi_search_)
    msgi_search_ = std::make_unique<KeyframeSearch>(input_, options_.select, std::nullopt,
                                                    options_.keyframe_poses, Reconstruction::kMsgi);
  msgi_search_->take_at_most(count);
  std::optional<Solution> solution;
  try {
    solution = search_.reach(*msgi_search_, best);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInternal)
      throw;
    return note(error.what());
  }
  const bool wins =
      solution && (is_size(bound_.metric) ? input_.rmse(solution->squared_error()) < kClearly * rmse
                                          : static_cast<double>(solution->bytes) <
                                                kClearly * static_cast<double>(best->bytes));
  if (wins)
    *best = std::move(*solution);
  else
    note("the file is not a tenth smaller");
}

void BasisSearch::note(const std::string& reason) {
  notes_.push_back("key-frames by MSGI are not taken: " + reason);
}

std::optional<Solution> BasisSearch::by_keyframes_alone() {
  const bool is_first = keyframe_searches_.empty();
  if (is_first &&
      options_.interpolation.value_or(InterpolationChoice::kLinear) != InterpolationChoice::kMsgi)
    add_keyframe_search(Reconstruction::kLinear);
  if (is_first &&
      options_.interpolation.value_or(InterpolationChoice::kLinear) != InterpolationChoice::kLinear)
    add_keyframe_search(Reconstruction::kMsgi);
  std::optional<Solution> best;
  for (std::unique_ptr<KeyframeSearch>& search : keyframe_searches_) {
    if (bound_.metric != ErrorMetric::kNone) {
      offer(*search, &best);
      continue;
    }
    // All take about the same bytes: what counts is the error.
    std::vector<CodedSegment> segments;
    segments.push_back(search->at_count());
    Solution solution = search_.files().put_together(std::move(segments));
    if (!best || solution.squared_error() < best->squared_error())
      best = std::move(solution);
  }
  if (!best)
    fail(*keyframe_searches_[0]);
  return best;
}

BasisSearch::LinearSearches BasisSearch::linear_searches(const LinearAnalysis& analysis) {
  LinearSearches searches;
  for (BasisKind kind : {BasisKind::kEigentrajectories, BasisKind::kEigenshapes}) {
    BasisChoice choice = kind == BasisKind::kEigenshapes ? BasisChoice::kEigenshapes
                                                         : BasisChoice::kEigentrajectories;
    const bool wanted =
        options_.basis == BasisChoice::kAuto
            ? options_.effort > Effort::kFirst || kind == BasisKind::kEigentrajectories
            : options_.basis == choice;
    if (wanted)
      searches.push_back(std::make_unique<LinearSearch>(input_, analysis, kind, options_.effort,
                                                        kLayers, options_.smallest));
  }
  for (std::unique_ptr<LinearSearch>& search : searches) {
    if (input_.pose)
      search->share_pose(input_.pose);
  }
  if (searches.size() == 2) {
    // The smaller kind comes first. One that a trial shows to be far behind is not searched.
    double rmse = search_.typical_rmse(*searches[0]);
    std::vector<double> bytes(2);
    const auto probe = [&](const auto& bytes_of) {
      parallel_tasks(searches.size(), [&](size_t i) { bytes[i] = bytes_of(*searches[i]); });
      if (searches.size() == 2 && bytes[1] < bytes[0]) {
        std::swap(searches[0], searches[1]);
        std::swap(bytes[0], bytes[1]);
      }
    };
    probe([&](LinearSearch& search) { return search.probe_once(rmse); });
    if (bytes[1] > kHopeless * bytes[0] && !searches[1]->tries_regions())
      searches.pop_back();
    probe([&](LinearSearch& search) { return search.probe(rmse); });
    const auto is_behind = [&](double factor) {
      return searches.size() == 2 && bytes[1] > factor * bytes[0];
    };
    if (is_behind(kFarBehind))
      searches.pop_back();
    input_.expect(search_.expected(searches.size(), false));
    for (const LinearSearch::Steps steps : {LinearSearch::Steps::kFew, LinearSearch::Steps::kAll}) {
      probe([&](LinearSearch& search) { return search.choose_settings(rmse, steps); });
      if (is_behind(kBehind[searches.back()->kind() == BasisKind::kEigenshapes]))
        searches.pop_back();
    }
    searches[0]->choose_settings(rmse, LinearSearch::Steps::kOpening);
    if (searches.size() == 2)
      searches[1]->open_like(*searches[0]);
  }
  return searches;
}

std::optional<Solution> BasisSearch::by_linear_bases() {
  if (!analysis_) {
    analysis_.emplace(input_.frames());
    linear_searches_ = linear_searches(*analysis_);
    input_.expect(search_.expected(linear_searches_.size(), options_.basis == BasisChoice::kAuto));
  }
  std::vector<LinearSearch*> searches;
  for (const std::unique_ptr<LinearSearch>& search : linear_searches_)
    searches.push_back(search.get());
  std::optional<Solution> best = search_.best_of(searches);
  input_.expect(search_.expected(0, true));
  if (!best || options_.effort == Effort::kFirst)
    return best;
  const BasisKind kind = best->segments[0].encoded.sizes.kind;
  const auto used = std::ranges::find_if(
      linear_searches_, [&](const auto& search) { return search->kind() == kind; });
  std::optional<Solution> cut = cut_in_time(*best, **used);
  return cut && search_.better(*cut, *best) && search_.keeps_motion(*cut) ? std::move(cut)
                                                                          : std::move(best);
}

std::optional<Solution> BasisSearch::cut_in_time(const Solution& whole,
                                                 const LinearSearch& search) {
  double rmse = whole.segments[0].asked;
  TimeSegmentation segmentation(input_, search, whole.segments[0].encoded.reference, rmse);
  std::vector<FrameRun> runs = segmentation.find();
  if (runs.size() < 2)
    return std::nullopt;
  std::vector<CodedSegment> segments;
  for (const FrameRun& run : runs) {
    std::optional<CodedSegment> segment = segmentation.coded(run);
    if (!segment)
      return std::nullopt;
    segment->encoded.sizes.first_frame = run.first;
    segments.push_back(std::move(*segment));
  }
  return search_.files().put_together(std::move(segments));
}

bool BasisSearch::beats_keyframes(const Solution& solution) const {
  // No fewer key-frames than principal components can do, each at a bit per coordinate and a quarter
  // of a bit per frame at least.
  constexpr double kBits = 1, kBitsOfWeight = 0.25;
  const auto k = static_cast<double>(analysis_->fewest_fields(solution.squared_error()));
  return k *
             (kBits * 3 * input_.layout.sizes.coded_vertices +
              kBitsOfWeight * input_.sequence.frame_count) /
             8 >
         static_cast<double>(solution.bytes);
}

void BasisSearch::fail() const {
  std::string text = "the target cannot be reached";
  if (is_size(bound_.metric)) {
    auto smallest = std::ranges::min_element(trials(), {}, &Trial::bytes);
    if (smallest != trials().end())
      text += "; the smallest file found takes " + std::to_string(smallest->bytes) + " bytes";
  }
  throw Error(ErrorKind::kUsage, text);
}

void BasisSearch::fail(KeyframeSearch& keyframes) const {
  std::string text = "the target cannot be reached";
  if (options_.keyframes) {
    double rmse = input_.rmse(keyframes.at_count().error.squared);
    text +=
        " with " + std::to_string(*options_.keyframes) + " key-frames; the best is a KG error of " +
        four_digits(100 * rmse / input_.rmse_of_kg(100)) + " %, an RMSE of " + four_digits(rmse);
  }
  throw Error(ErrorKind::kUsage, text);
}

}  // namespace anicodec
