// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/frame_noise.h"

#include "codec/sequence_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kFewestFrames = 8, kMostFrames = 512;
constexpr uint32_t kSamples = 8;
constexpr int kHalvings = 12;        // of the interval of levels
constexpr double kLeastLevel = 0.1;  // of the smallest variance

/// The mean height of the smooth surface over the centres of the triangles.
double sagitta(const Surface& surface) {
  const SurfaceTopology& topology = surface.topology();
  double sum = 0, total = 0;
  for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
    SurfacePoint centre;
    centre.triangle = t;
    centre.weights = Vector3d::Constant(1.0 / 3);
    for (uint32_t corner : topology.triangles[t])
      centre.position += row(surface.positions(), corner) / 3;
    const double area = area_normal(surface.positions(), topology.triangles[t]).norm();
    sum += area * (surface.curved(centre) - centre.position).norm();
    total += area;
  }
  return total > 0 ? sum / total : 0;
}

/// A frame on which the filter is judged.
class Sample {
 public:
  Sample(const WeldedClip& clip, std::span<const float> source, std::span<const float> massaged)
      : surface_(clip.topology, clip.frame(source)),
        start_(clip.topology.vertex_count, SurfaceTopology::kNone) {
    surface_.build_index();
    const Positions v = clip.frame(massaged);
    for (uint32_t i = 0; i < start_.size(); ++i) {
      if (!clip.topology.star[i].empty())
        start_[i] = surface_.closest(row(v, i)).triangle;
    }
  }

  double height() const { return sagitta(surface_); }

  /// Of the vertices from the smooth surface.
  double distance(const Positions& v) const {
    double sum = 0;
    size_t count = 0;
    for (uint32_t i = 0; i < start_.size(); ++i) {
      if (start_[i] == SurfaceTopology::kNone)
        continue;
      const SurfacePoint point = surface_.walk(row(v, i), start_[i]);
      sum += std::abs(surface_.normal(point).dot(row(v, i) - surface_.curved(point)));
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

 private:
  Surface surface_;
  std::vector<uint32_t> start_;  ///< where walks start
};

FrameNoiseReport filter_run(const MeshSequence& source, const WeldedClip& clip, double share,
                            const FrameView& run, uint32_t first, MeshSequence* massaged) {
  FrameNoiseReport report;
  const auto frames = static_cast<uint32_t>(run.frame_count);
  const SequenceFilter filter(run);
  const Eigen::VectorXd& variances = filter.variances();
  if (variances.size() == 0)
    return report;
  std::vector<uint32_t> sampled;
  for (uint32_t k = 0; k < kSamples; ++k)
    sampled.push_back((2 * k + 1) * frames / (2 * kSamples));
  std::vector<Sample> samples;
  for (uint32_t f : sampled) {
    samples.emplace_back(clip, source.frame(first + f), std::as_const(*massaged).frame(first + f));
    report.sagitta += samples.back().height() / kSamples;
  }
  auto distance = [&](double level) {
    const Eigen::MatrixXd weights = filter.weights(level);
    std::vector<double> distances(kSamples);
    tbb::parallel_for(size_t{0}, samples.size(), [&](size_t k) {
      const std::vector<float> x = combination(run, weights.row(static_cast<Index>(sampled[k])));
      distances[k] = samples[k].distance(clip.frame(x));
    });
    double sum = 0;
    for (double d : distances)
      sum += d / kSamples;
    return sum;
  };
  double low = std::log(kLeastLevel * variances[variances.size() - 1]);
  double high = std::log(variances[0]);
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (distance(std::exp(middle)) <= share * report.sagitta ? low : high) = middle;
  }
  const Eigen::MatrixXd weights = filter.weights(std::exp(low));
  report.moved = distance(std::exp(low));
  report.components = weights.squaredNorm() - 1;
  combine_frames(weights, first, massaged);
  return report;
}

}  // namespace

FrameNoiseReport remove_frame_noise(const MeshSequence& source, const WeldedClip& clip,
                                    double share, MeshSequence* massaged) {
  FrameNoiseReport report;
  const uint32_t count = source.frame_count;
  if (count < kFewestFrames)
    return report;
  const uint32_t runs = (count + kMostFrames - 1) / kMostFrames;
  for (uint32_t r = 0; r < runs; ++r) {
    const auto first = static_cast<uint32_t>(uint64_t{count} * r / runs);
    const auto end = static_cast<uint32_t>(uint64_t{count} * (r + 1) / runs);
    const FrameNoiseReport one = filter_run(
        source, clip, share, FrameView(*massaged).frames(first, end - first), first, massaged);
    report.sagitta += one.sagitta / runs;
    report.moved += one.moved / runs;
    report.components += one.components;
  }
  return report;
}

}  // namespace anicodec
