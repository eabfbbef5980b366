// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/denoise.h"

#include "codec/massage/normal_fit.h"
#include "codec/massage/patch_filter.h"
#include "codec/massage/sequence_filter.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/frame_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kFewestFrames = 8, kMostFrames = 512;
constexpr uint32_t kSamples = 8;
constexpr double kLeastPatchLevel = -4, kMostPatchLevel = 6;  // powers of two
constexpr int kLevelHalvings = 8;      // of the interval of levels of the filter of whole frames
constexpr double kLeastLevel = 0.001;  // of the smallest variance
constexpr int kHeightRounds = 2;

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

/// The mean distance of the vertices from the smooth surface.
double mean_distance(const Surface& surface, const Positions& v) {
  double sum = 0;
  size_t count = 0;
  for (uint32_t i = 0; i < surface.topology().vertex_count; ++i) {
    const auto star = surface.topology().star[i];
    if (star.empty())
      continue;
    const SurfacePoint point = surface.walk(row(v, i), star[0]);
    sum += std::abs(surface.normal(point).dot(row(v, i) - surface.curved(point)));
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Frames that are settled together.
class DenoiseRun {
 public:
  DenoiseRun(const MeshSequence& source, const WeldedSurface& clip,
             const std::vector<uint8_t>& freedom, uint32_t first, uint32_t count,
             MeshSequence* massaged)
      : source_(source),
        clip_(clip),
        freedom_(freedom),
        first_(first),
        count_(count),
        massaged_(*massaged) {
    parallel_for(uint32_t{0}, kSamples, [&](uint32_t k) {
      samples_[k].emplace(clip_.topology, clip_.frame(source_.frame(first_ + sampled(k))));
    });
  }

  DenoiseReport settle(const PatchFilter& filter, const DenoiseOptions& options) {
    DenoiseReport report;
    report.sagitta = sample_mean([&](uint32_t k) { return sagitta(*samples_[k]); });
    for (int round = 0; round < options.rounds; ++round) {
      run_patches(filter, options.slide_level);
      for_frames([&](const Surface& surface, Positions* v) {
        put_on(surface, true, v);
        if (round + 1 == options.rounds)
          fit_normals(surface, kHeightRounds, v);
      });
    }
    report.fitted = report.moved = moved();
    filter_patches(filter, options.patch_allowance * report.sagitta, &report);
    filter_whole(options.frame_allowance * report.sagitta, &report);
    return report;
  }

 private:
  /// Calls with the surface of every frame and its vertices as they are now.
  template <class Visit>
  void for_frames(const Visit& visit) {
    parallel_for(first_, first_ + count_, [&](uint32_t f) {
      const Surface surface(clip_.topology, clip_.frame(source_.frame(f)));
      Positions v = clip_.frame(std::as_const(massaged_).frame(f));
      visit(surface, &v);
      clip_.store(v, massaged_.frame(f));
    });
  }

  /// Puts vertices on the surface, or those alone that are not free on it.
  void put_on(const Surface& surface, bool free_ones, Positions* v) const {
    for (uint32_t i = 0; i < clip_.topology.vertex_count; ++i) {
      const Vector3d q = row(*v, i);
      Vector3d to = q;
      if (freedom_[i] == 0) {
        to = row(surface.positions(), i);
      } else if (freedom_[i] == 1) {
        uint32_t start = i;
        Vector3d direction;
        to = surface.walk_boundary(q, &start, &direction).position;
      } else if (free_ones) {
        to = surface.curved(surface.walk(q, clip_.topology.star[i][0]));
      }
      v->row(static_cast<Index>(i)) = to.transpose();
    }
  }

  /// Filters the frames as they are now. Returns the components left of a patch, in the mean.
  double run_patches(const PatchFilter& filter, double level) {
    return filter.run(level, clip_.weld.representative, first_, count_, &massaged_);
  }

  uint32_t sampled(uint32_t k) const { return (2 * k + 1) * count_ / (2 * kSamples); }

  /// Filters patches as strongly as takes the vertices further from their surfaces by no more than
  /// is allowed.
  void filter_patches(const PatchFilter& filter, double allowance, DenoiseReport* report) {
    const FrameView run = FrameView(massaged_).frames(first_, count_);
    const std::vector<float> before(run.positions,
                                    run.positions + run.frame_count * run.frame_stride);
    const double most = report->moved + allowance;
    auto filter_at = [&](double level) {
      std::copy(before.begin(), before.end(), massaged_.frame(first_).begin());
      report->components = run_patches(filter, std::exp2(level));
      for_frames([&](const Surface& surface, Positions* v) { put_on(surface, false, v); });
      report->moved = moved();
    };
    double low = kLeastPatchLevel, high = kMostPatchLevel, at = high;
    while (high - low > 1) {
      at = (low + high) / 2;
      filter_at(at);
      (report->moved <= most ? low : high) = at;
    }
    if (at != low)
      filter_at(low);
  }

  /// Filters whole frames likewise.
  void filter_whole(double allowance, DenoiseReport* report) {
    const FrameView run = FrameView(massaged_).frames(first_, count_);
    const SequenceFilter filter(run);
    const Eigen::VectorXd& variances = filter.variances();
    if (variances.size() == 0)
      return;
    const double most = report->moved + allowance;
    double low = std::log(kLeastLevel * variances[variances.size() - 1]);
    double high = std::log(variances[0]);
    bool within = false;
    for (int k = 0; k < kLevelHalvings; ++k) {
      const double middle = (low + high) / 2;
      const Eigen::MatrixXd weights = filter.weights(std::exp(middle));
      const double distance = sample_mean([&](uint32_t s) {
        const std::vector<float> x = combination(run, weights.row(Index{sampled(s)}));
        return mean_distance(*samples_[s], clip_.frame(x));
      });
      (distance <= most ? low : high) = middle;
      within = within || distance <= most;
    }
    if (!within)
      return;
    play_frames(filter.weights(std::exp(low)), first_, &massaged_);
    for_frames([&](const Surface& surface, Positions* v) { put_on(surface, false, v); });
    report->moved = moved();
  }

  /// The mean distance of the vertices, as they are now, from their surfaces.
  double moved() const {
    return sample_mean([&](uint32_t k) {
      const std::span<const float> frame = std::as_const(massaged_).frame(first_ + sampled(k));
      return mean_distance(*samples_[k], clip_.frame(frame));
    });
  }

  /// The mean of what a sample frame has, by its number among them.
  template <class Value>
  static double sample_mean(const Value& value) {
    double values[kSamples];
    parallel_for(uint32_t{0}, kSamples, [&](uint32_t k) { values[k] = value(k); });
    return std::accumulate(values, values + kSamples, 0.0) / kSamples;
  }

  const MeshSequence& source_;
  const WeldedSurface& clip_;
  const std::vector<uint8_t>& freedom_;
  uint32_t first_, count_;
  MeshSequence& massaged_;
  std::optional<Surface> samples_[kSamples];  ///< of `source`
};

}  // namespace

bool can_denoise(const MeshSequence& sequence) {
  return sequence.frame_count >= kFewestFrames;
}

DenoiseReport denoise(const MeshSequence& source, const WeldedSurface& clip,
                      const std::vector<uint8_t>& freedom, const DenoiseOptions& options,
                      MeshSequence* massaged) {
  DenoiseReport report;
  if (!can_denoise(source))
    return report;
  const PatchFilter filter(clip.topology);
  const uint32_t count = source.frame_count, runs = (count + kMostFrames - 1) / kMostFrames;
  for (uint32_t r = 0; r < runs; ++r) {
    const auto first = static_cast<uint32_t>(uint64_t{count} * r / runs);
    const auto end = static_cast<uint32_t>(uint64_t{count} * (r + 1) / runs);
    const DenoiseReport one =
        DenoiseRun(source, clip, freedom, first, end - first, massaged).settle(filter, options);
    report.sagitta += one.sagitta / runs;
    report.fitted += one.fitted / runs;
    report.moved += one.moved / runs;
    report.components += one.components / runs;
  }
  return report;
}

}  // namespace anicodec
