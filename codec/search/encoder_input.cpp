// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/encoder_input.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace anicodec {
namespace {

/// A position is rounded a few times on its way: four units in the last place.
double smallest_bound_at(double coordinate) {
  return std::max(coordinate * 0x1p-21, 1e-30);
}

}  // namespace

EncoderInput::EncoderInput(MeshSequence source, const std::optional<FrameRun>& part,
                           const MeshLayout* laid_out)
    : sequence(std::move(source)), layout(laid_out ? *laid_out : lay_out_mesh(sequence)) {
  const size_t n = layout.sizes.coded_vertices;
  copies.assign(n, 0);
  for (uint32_t c : layout.source_coded)
    ++copies[c];
  for (uint32_t v : layout.coded_source) {
    const float* position = sequence.positions.data() + size_t{3} * v;
    first_pose.insert(first_pose.end(), position, position + 3);
  }
  const FrameRun kept = part.value_or(FrameRun{0, sequence.frame_count});
  if (part || sequence.clips.empty()) {
    clips.emplace_back(FrameRun{0, kept.count});
  } else {
    uint32_t first = 0;
    for (const ClipTiming& clip : sequence.clips) {
      clips.emplace_back(FrameRun{first, clip.frame_count});
      first += clip.frame_count;
    }
  }
  auto clip = clips.begin();
  std::vector<float> frame(size_t{3} * sequence.vertex_count);
  float* to = sequence.positions.data();  // never ahead of what is yet to be read
  for (size_t f = kept.first; f < size_t{kept.first} + kept.count; ++f) {
    std::ranges::copy(sequence.frame(f), frame.begin());
    double mean[3] = {0, 0, 0}, squares = 0, largest = 0;
    for (size_t v = 0; v < sequence.vertex_count; ++v) {
      for (size_t c = 0; c < 3; ++c)
        mean[c] += static_cast<double>(frame[3 * v + c]) / sequence.vertex_count;
    }
    for (size_t v = 0; v < sequence.vertex_count; ++v) {
      for (size_t c = 0; c < 3; ++c) {
        double x = static_cast<double>(frame[3 * v + c]);
        squares += (x - mean[c]) * (x - mean[c]);
        largest = std::max(largest, std::abs(x));
      }
    }
    kg_reference += squares;
    largest_coordinate = std::max(largest_coordinate, largest);
    if (f - kept.first == size_t{clip->frames.first} + clip->frames.count)
      ++clip;
    clip->kg_reference += squares;
    clip->largest_coordinate = std::max(clip->largest_coordinate, largest);
    for (uint32_t v : layout.coded_source)
      to = std::copy_n(frame.begin() + ptrdiff_t{3} * v, 3, to);
  }
  first_frame = kept.first;
  sequence.frame_count = kept.count;
  coded = std::move(sequence.positions);
  coded.resize(3 * n * sequence.frame_count);
  sequence.positions.clear();
  if (kg_reference == 0)
    kg_reference = 1;
}

EncoderInput::EncoderInput(const EncoderInput& all, size_t number)
    : layout(all.layout),
      clips{all.clips[number]},
      copies(all.copies),
      largest_coordinate(clips[0].largest_coordinate),
      first_pose(all.first_pose),
      pose(all.pose),
      described(all.described),
      without(all.without),
      memory(all.memory),
      progress(all.progress) {
  InputClip& clip = clips[0];
  const FrameView frames = all.frames(clip.frames.first, clip.frames.count);
  coded.assign(frames.frame(0), frames.frame(0) + size_t{3} * copies.size() * clip.frames.count);
  sequence.polygons = all.sequence.polygons;
  sequence.vertex_count = all.sequence.vertex_count;
  sequence.frame_count = clip.frames.count;
  kg_reference = clip.kg_reference > 0 ? clip.kg_reference : 1;
  clip.frames.first = 0;
  clip.tolerance = 0;
}

EncoderInput::EncoderInput(const EncoderInput& clip_input, const Topology& surface,
                           FrameArray trajectories)
    : layout(clip_input.layout),
      coded(std::move(trajectories)),
      clips(clip_input.clips),
      copies(surface.coded_vertices, 0),
      described(clip_input.described),
      memory(clip_input.memory),
      progress(clip_input.progress) {
  layout.topology = surface;
  layout.source_coded.assign(surface.vertex_coded.begin(), surface.vertex_coded.end());
  layout.sizes.source_vertices = static_cast<uint32_t>(surface.vertex_coded.size());
  layout.sizes.coded_vertices = surface.coded_vertices;
  layout.sizes.triangles = static_cast<uint32_t>(surface.triangles.size() / 3);
  for (uint32_t entry : surface.vertex_coded)
    ++copies[entry];
  sequence.vertex_count = layout.sizes.source_vertices;
  sequence.frame_count = clip_input.sequence.frame_count;
  for (InputClip& clip : clips) {
    clip.tolerance = 0;
    clip.cap.reset();
  }
  for (float x : coded) {
    const auto value = static_cast<double>(x);
    kg_reference += value * value;
    largest_coordinate = std::max(largest_coordinate, std::abs(value));
  }
  for (InputClip& clip : clips)
    clip.largest_coordinate = largest_coordinate;
  if (kg_reference == 0)
    kg_reference = 1;
}

void EncoderInput::keep_whole(const FrameArray& positions) {
  whole.reserve(coded.size());
  for (size_t f = 0; f < sequence.frame_count; ++f) {
    for (uint32_t v : layout.coded_source) {
      const auto at =
          positions.begin() + ptrdiff_t{3} * static_cast<ptrdiff_t>(f * sequence.vertex_count + v);
      whole.insert(whole.end(), at, at + 3);
    }
  }
  const size_t row = size_t{3} * layout.sizes.coded_vertices;
  for (InputClip& clip : clips) {
    for (size_t i = row * clip.frames.first; i < row * (clip.frames.first + clip.frames.count); ++i)
      clip.largest_coordinate =
          std::max(clip.largest_coordinate, std::abs(static_cast<double>(whole[i])));
    largest_coordinate = std::max(largest_coordinate, clip.largest_coordinate);
  }
}

Eigen::MatrixXd EncoderInput::centred_first_pose(Eigen::Vector3d* origin) const {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(first_pose.size() / 3);
  Eigen::MatrixXd centred = Eigen::Map<const Rows>(first_pose.data(), rows, 3).cast<double>();
  *origin = centred.colwise().mean();
  centred.rowwise() -= origin->transpose();
  return centred;
}

double EncoderInput::rmse(double squared, size_t frames) const {
  return std::sqrt(squared / sequence.vertex_count / static_cast<double>(frames));
}

double EncoderInput::rmse_of_kg(double kg) const {
  return kg / 100 * std::sqrt(kg_reference / sequence.vertex_count / sequence.frame_count);
}

Vector<uint32_t> EncoderInput::runs(uint32_t first, uint32_t count) const {
  Limits limits;
  for (const InputClip& clip : clips)
    limits.clip_frames.push_back(clip.frames.count);
  return limits.runs(first, count);
}

void EncoderInput::bound_clips(const std::vector<ClipGoal>& goals) {
  const ErrorMetric metric = goals[0].bound.metric;
  const bool bounds_mean = metric == ErrorMetric::kKg || metric == ErrorMetric::kRmse;
  const double mean = kg_reference / sequence.frame_count, most = largest_bound(goals).value;
  const bool differ =
      std::ranges::any_of(goals, [&](const ClipGoal& goal) { return goal.bound.value != most; });
  for (size_t c = 0; c < clips.size(); ++c) {
    InputClip& clip = clips[c];
    const double own = clip.kg_reference / clip.frames.count, value = goals[c].bound.value;
    if (bounds_mean || differ)
      clip.tolerance =
          metric == ErrorMetric::kKg ? (own > 0 ? std::sqrt(own / mean) : 1) : value / most;
    const bool is_cap = metric == ErrorMetric::kMaxError;
    clip.cap = is_cap ? value : goals[c].cap;
    if (clip.cap == 0)  // per cent of nothing: all vertices are one point that stands still
      clip.cap.reset();
    if (clip.cap && *clip.cap < clip.smallest_bound())
      throw Error(ErrorKind::kUsage,
                  (sequence.clips.empty() ? "" : "clip '" + sequence.clips[c].name + "': ") +
                      "the maximum error is below what float32 keeps at these coordinates; the "
                      "smallest possible is " +
                      four_digits(clip.smallest_bound()));
    if (clip.cap && is_cap)
      *clip.cap -= clip.smallest_bound() / 4;  // room for rounding
  }
}

std::vector<double> EncoderInput::caps(uint32_t first, uint32_t count) const {
  std::vector<double> result;
  for (const InputClip& clip : clips) {
    for (uint32_t f = 0; f < clip.frames.count; ++f) {
      if (clip.frames.first + f >= first && result.size() < count)
        result.push_back(*clip.cap);
    }
  }
  return result;
}

std::vector<double> EncoderInput::excesses(const SegmentError& error, uint32_t first,
                                           double rmse_of_all) const {
  std::vector<double> result;
  for (const InputClip& clip : clips) {
    double squared = 0;
    size_t frames = 0;
    for (size_t f = 0; f < error.squared_by_frame.size(); ++f) {
      if (first + f >= clip.frames.first && first + f - clip.frames.first < clip.frames.count) {
        squared += error.squared_by_frame[f];
        ++frames;
      }
    }
    if (frames > 0)
      result.push_back(rmse(squared, frames) / (rmse_of_all * clip.tolerance));
  }
  return result;
}

bool EncoderInput::bounds_differ() const {
  constexpr double kMost = 16;
  const auto [least, most] = std::ranges::minmax(clips, {}, &InputClip::tolerance);
  return most.tolerance > kMost * least.tolerance;
}

double EncoderInput::smallest_bound() const {
  return smallest_bound_at(largest_coordinate);
}

double InputClip::smallest_bound() const {
  return smallest_bound_at(largest_coordinate);
}

}  // namespace anicodec
