// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/time_segmentation.h"

#include "codec/parallel/parallel.h"
#include "codec/search/clip_bounds.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint32_t kShortest = 8;  // frames of a segment
constexpr uint32_t kLong = 128;    // frames from which the middle is a candidate
// Frames of clips that share a basis: each more is a trial of all.
constexpr uint32_t kMostShared = 1500;
constexpr double kHardCut = 30;    // times the usual squared motion around it
constexpr double kChunks = 160;    // bytes a segment costs in tables and records
constexpr double kWorthIt = 0.99;  // a cut must save a hundredth

}  // namespace

TimeSegmentation::TimeSegmentation(const EncoderInput& input, const LinearSearch& whole,
                                   std::shared_ptr<const EncodedPose> pose, double rmse)
    : input_(input), whole_(whole), pose_(std::move(pose)), rmse_(rmse) {
  FrameView frames = input.frames();
  motion_.assign(frames.frame_count, 0);
  for (size_t f = 1; f < frames.frame_count; ++f) {
    const float *a = frames.frame(f - 1), *b = frames.frame(f);
    for (size_t i = 0; i < 3 * frames.vertex_count; ++i) {
      double d = static_cast<double>(b[i]) - static_cast<double>(a[i]);
      motion_[f] += d * d;
    }
  }
}

LinearSearch TimeSegmentation::search(const LinearAnalysis& analysis, const FrameRun& range,
                                      const LinearSearch& like) const {
  LinearSearch search(input_, analysis, whole_.kind(), Effort::kFast, 1, whole_.smallest(),
                      range.first);
  search.settings_of(like);
  search.share_pose(pose_);
  return search;
}

LinearAnalysis TimeSegmentation::analysis(const FrameRun& range) const {
  return {whole_.analysis(), range.first, range.count};
}

double TimeSegmentation::probed(const FrameRun& range, const LinearSearch& like) const {
  const LinearAnalysis of_range = analysis(range);
  return search(of_range, range, like).probe(rmse_) + kChunks;
}

std::optional<CodedSegment> TimeSegmentation::coded(const FrameRun& range) const {
  const LinearAnalysis of_range = analysis(range);
  LinearSearch search_of_range = search(of_range, range, whole_);
  return within_bounds(search_of_range, input_, range.first, rmse_);
}

std::optional<uint32_t> TimeSegmentation::candidate(const FrameRun& range) const {
  uint32_t low = range.first + kShortest, high = range.first + range.count - kShortest;
  if (range.count < 2 * kShortest || low >= high)
    return std::nullopt;
  std::vector<double> sorted(motion_.begin() + range.first + 1,
                             motion_.begin() + range.first + range.count);
  auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  auto hardest = std::max_element(motion_.begin() + low, motion_.begin() + high);
  if (*hardest > kHardCut * *middle && *hardest > 0)
    return static_cast<uint32_t>(hardest - motion_.begin());
  if (range.count >= kLong)
    return range.first + range.count / 2;
  return std::nullopt;
}

void TimeSegmentation::split(const FrameRun& range, double bytes, const LinearSearch& like,
                             std::vector<FrameRun>* out) const {
  if (std::optional<uint32_t> cut = candidate(range)) {
    FrameRun left{range.first, *cut - range.first};
    FrameRun right{*cut, range.first + range.count - *cut};
    double of_left = 0, of_right = 0;
    parallel_invoke([&] { of_left = probed(left, like); }, [&] { of_right = probed(right, like); });
    if (of_left + of_right < kWorthIt * bytes) {
      split(left, of_left, like, out);
      split(right, of_right, like, out);
      return;
    }
  }
  out->push_back(range);
}

std::vector<FrameRun> TimeSegmentation::of_clips() {
  std::vector<FrameRun> ranges;
  double bytes = 0;  // of the last range
  for (const InputClip& clip : input_.clips) {
    const double alone = probed(clip.frames, whole_);
    if (!ranges.empty() && ranges.back().count + clip.frames.count <= kMostShared) {
      const FrameRun both{ranges.back().first, ranges.back().count + clip.frames.count};
      const double shared = probed(both, whole_);
      if (shared < bytes + alone) {
        ranges.back() = both;
        bytes = shared;
        continue;
      }
    }
    ranges.push_back(clip.frames);
    bytes = alone;
  }
  return ranges;
}

std::vector<FrameRun> TimeSegmentation::find() {
  if (input_.clips.size() > 1)
    return of_clips();
  FrameRun all{0, input_.sequence.frame_count};
  std::vector<FrameRun> ranges;
  if (!candidate(all))
    return {all};
  // Parts begin near the error asked for by what this one has learnt.
  const LinearAnalysis of_all = analysis(all);
  LinearSearch like = search(of_all, all, whole_);
  const double bytes = like.probe(rmse_) + kChunks;
  split(all, bytes, like, &ranges);
  return ranges;
}

}  // namespace anicodec
