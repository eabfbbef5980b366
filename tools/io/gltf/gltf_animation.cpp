// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/gltf_animation.h"

#include "tools/io/base/frame_rate.h"
#include "tools/io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec::tools {

GltfPose pose_at_rest(const GltfDocument& document) {
  GltfPose pose;
  for (const GltfNode& node : document.nodes) {
    pose.translations.push_back(node.translation);
    pose.rotations.push_back(node.rotation);
    pose.scales.push_back(node.scale);
    pose.visible.push_back(node.visible ? 1 : 0);
    std::vector<double>& weights = pose.weights.emplace_back();
    if (node.mesh == kGltfNone)
      continue;
    const GltfMesh& mesh = document.meshes[node.mesh];
    weights = !node.weights.empty() ? node.weights : mesh.weights;
    weights.resize(mesh.primitives[0].targets.size());
  }
  return pose;
}

GltfClip::GltfClip(const GltfDocument& document, uint32_t animation, uint64_t memory_limit) {
  uint64_t bytes = 0;
  const GltfAnimation& source = document.animations[animation];
  const std::string path = "/animations/" + std::to_string(animation);
  first_time_ = last_time_ = 0;
  for (const GltfChannel& channel : source.channels) {
    const GltfSampler& sampler = source.samplers[channel.sampler];
    const std::string place = path + "/samplers/" + std::to_string(channel.sampler);
    bytes += bytes_as_floats(document, sampler.input) + bytes_as_floats(document, sampler.output);
    if (bytes > memory_limit)
      fail_gltf(document, path,
                "the keys take " + std::to_string(bytes) +
                    " bytes of memory, more "
                    "than the " +
                    std::to_string(memory_limit) + " that are allowed");
    Track track{.node = channel.node,
                .path = channel.path,
                .element = channel.element == kGltfNone ? 0 : channel.element,
                .interpolation = sampler.interpolation,
                .components = 0,
                .times = read_floats(document, sampler.input, place + "/input"),
                .values = read_floats(document, sampler.output, place + "/output")};
    for (size_t k = 0; k < track.times.size(); ++k) {
      if (k > 0 ? track.times[k] < track.times[k - 1] : track.times[k] < 0)
        fail_gltf(document, place + "/input",
                  "the time of key " + std::to_string(k) +
                      (k > 0 ? " is before that of the key before" : " is negative"));
    }
    const size_t values = track.interpolation == GltfInterpolation::kCubicSpline ? 3 : 1;
    track.components = static_cast<uint32_t>(track.values.size() / (track.times.size() * values));
    const auto first = static_cast<double>(track.times.front());
    first_time_ = tracks_.empty() ? first : std::min(first_time_, first);
    last_time_ = std::max(last_time_, static_cast<double>(track.times.back()));
    tracks_.push_back(std::move(track));
  }
}

std::vector<double> GltfClip::key_times() const {
  std::vector<double> times;
  for (const Track& track : tracks_)
    times.insert(times.end(), track.times.begin(), track.times.end());
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::optional<FrameRate> GltfClip::key_grid() const {
  const auto last = static_cast<float>(last_time_);
  const float rounding = last - std::nextafter(last, 0.0F);
  return grid_rate(key_times(), static_cast<double>(rounding));
}

double GltfClip::key_density() const {
  const auto most =
      std::ranges::max_element(tracks_, {}, [](const Track& track) { return track.times.size(); });
  if (most == tracks_.end())
    return 0;
  std::vector<double> gaps;
  for (size_t k = 1; k < most->times.size(); ++k) {
    const double gap =
        static_cast<double>(most->times[k]) - static_cast<double>(most->times[k - 1]);
    if (gap > 0)
      gaps.push_back(gap);
  }
  if (gaps.empty())
    return 0;
  const auto median = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::ranges::nth_element(gaps, median);
  return 1 / *median;
}

bool GltfClip::moves(const std::vector<bool>& nodes) const {
  for (const Track& track : tracks_) {
    if (!nodes[track.node])
      continue;
    const size_t key = track.values.size() / track.times.size();
    for (size_t i = key; i < track.values.size(); ++i) {
      if (track.values[i] != track.values[i - key])
        return true;
    }
  }
  return false;
}

void GltfClip::join(GltfClip other) {
  first_time_ = tracks_.empty() ? other.first_time_ : std::min(first_time_, other.first_time_);
  last_time_ = std::max(last_time_, other.last_time_);
  std::ranges::move(other.tracks_, std::back_inserter(tracks_));
}

/// Appendix C of the specification.
void GltfClip::evaluate(const Track& track, double time, double tolerance, double* out) {
  const size_t n = track.components;
  const bool cubic = track.interpolation == GltfInterpolation::kCubicSpline;
  // A key of a cubic spline has an in-tangent, a value, and an out-tangent.
  auto value = [&](size_t key, size_t part = 1) {
    return track.values.data() + (cubic ? 3 * key + part : key) * n;
  };
  auto take = [&](size_t key) { std::copy_n(value(key), n, out); };
  const auto later =
      std::upper_bound(track.times.begin(), track.times.end(), time,
                       [](double t, float key) { return t < static_cast<double>(key); });
  const auto next = static_cast<size_t>(later - track.times.begin());
  if (next == 0)
    return take(0);
  if (next == track.times.size())
    return take(next - 1);
  const auto t0 = static_cast<double>(track.times[next - 1]);
  const auto t1 = static_cast<double>(track.times[next]);
  if (time - t0 <= tolerance)
    return take(next - 1);
  if (t1 - time <= tolerance) {
    // The last of several keys at one time holds from there on.
    size_t key = next;
    while (key + 1 < track.times.size() && track.times[key + 1] == track.times[key])
      ++key;
    return take(key);
  }
  if (track.interpolation == GltfInterpolation::kStep)
    return take(next - 1);

  const double length = t1 - t0, s = (time - t0) / length;
  const float *a = value(next - 1), *b = value(next);
  if (cubic) {
    const float *leave = value(next - 1, 2), *arrive = value(next, 0);
    const double s2 = s * s, s3 = s2 * s;
    for (size_t i = 0; i < n; ++i)
      out[i] = (2 * s3 - 3 * s2 + 1) * static_cast<double>(a[i]) +
               length * (s3 - 2 * s2 + s) * static_cast<double>(leave[i]) +
               (3 * s2 - 2 * s3) * static_cast<double>(b[i]) +
               length * (s3 - s2) * static_cast<double>(arrive[i]);
  } else if (track.path == GltfPath::kRotation) {
    Eigen::Quaterniond p = Eigen::Map<const Eigen::Quaternionf>(a).cast<double>();
    Eigen::Quaterniond q = Eigen::Map<const Eigen::Quaternionf>(b).cast<double>();
    Eigen::Map<Eigen::Quaterniond> r(out);
    r = p.normalized().slerp(s, q.normalized());
  } else {
    for (size_t i = 0; i < n; ++i)
      out[i] =
          static_cast<double>(a[i]) + s * (static_cast<double>(b[i]) - static_cast<double>(a[i]));
  }
}

void GltfClip::apply(double time, double tolerance, GltfPose& pose) const {
  for (const Track& track : tracks_) {
    double* out = nullptr;
    switch (track.path) {
      case GltfPath::kTranslation:
        out = pose.translations[track.node].data();
        break;
      case GltfPath::kRotation:
        out = pose.rotations[track.node].data();
        break;
      case GltfPath::kScale:
        out = pose.scales[track.node].data();
        break;
      case GltfPath::kWeights:
        out = pose.weights[track.node].data() + track.element;
        break;
      case GltfPath::kVisibility:
        out = &pose.visible[track.node];
        break;
    }
    evaluate(track, time, tolerance, out);
  }
}

}  // namespace anicodec::tools
