// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/sted.h"

#include "codec/metrics/diameter.h"
#include "codec/parallel/task_threads.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint32_t kWindow = 5;
constexpr uint32_t kSpeedFrames = 2 * kWindow;       // those that one local mean is made of
constexpr uint32_t kSpeedErrorFrames = kWindow + 1;  // those that still wait for theirs
constexpr double kTimeStep = 0.0003;
constexpr double kTemporalWeight = 9.144e-5;

double square_distance(const float* p, const float* q) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    double d = double{p[axis]} - double{q[axis]};
    sum += d * d;
  }
  return sum;
}

template <class Body>
void parallel_over(size_t count, const Body& body) {
  for_ranges(task_threads(), count, 2048, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      body(i);
  });
}

/// In the order of the elements, whatever the threads did.
double sum(const std::vector<double>& values) {
  double total = 0;
  for (double v : values)
    total += v;
  return total;
}

}  // namespace

StedMeter::StedMeter(const Polygons& polygons, uint32_t vertex_count)
    : vertices_(vertex_count),
      deviation_(vertex_count),
      speed_(size_t{vertex_count} * kSpeedFrames),
      speed_error_(size_t{vertex_count} * kSpeedErrorFrames) {
  list_edges(polygons);
  list_neighbourhoods();
  length_.resize(edges_.size());
  error_.resize(edges_.size());
}

void StedMeter::list_edges(const Polygons& polygons) {
  edges_.reserve(polygons.corners.size());
  for (size_t p = 0; p < polygons.size(); ++p) {
    auto polygon = polygons[p];
    for (size_t c = 0; c < polygon.size(); ++c) {
      uint32_t a = polygon[c], b = polygon[c + 1 == polygon.size() ? 0 : c + 1];
      if (a != b)
        edges_.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  edges_.shrink_to_fit();
}

void StedMeter::list_neighbourhoods() {
  std::vector<size_t> start(size_t{vertices_} + 1);
  for (auto [a, b] : edges_) {
    ++start[a + 1];
    ++start[b + 1];
  }
  for (size_t v = 0; v < vertices_; ++v)
    start[v + 1] += start[v];
  std::vector<uint32_t> incident(start.back());
  std::vector<size_t> next(start.begin(), start.end() - 1);
  for (uint32_t e = 0; e < edges_.size(); ++e) {
    incident[next[edges_[e].first]++] = e;
    incident[next[edges_[e].second]++] = e;
  }
  std::vector<uint32_t> around;
  first_.push_back(0);
  for (uint32_t v = 0; v < vertices_; ++v) {
    around.clear();
    for (size_t i = start[v]; i < start[v + 1]; ++i) {
      auto [a, b] = edges_[incident[i]];
      uint32_t neighbour = a == v ? b : a;
      for (size_t j = start[neighbour]; j < start[neighbour + 1]; ++j)
        around.push_back(incident[j]);
    }
    std::sort(around.begin(), around.end());
    near_.insert(near_.end(), around.begin(), std::unique(around.begin(), around.end()));
    first_.push_back(near_.size());
  }
}

double StedMeter::add(std::span<const float> original, std::span<const float> decoded) {
  if (frames_ == 0) {
    diameter_ = diameter(original);
    if (diameter_ == 0)
      diameter_ = 1;
  } else {
    measure_speeds(original, decoded);
    if (frames_ > kWindow)
      close_frame(frames_ - kWindow, frames_);
  }
  previous_original_.assign(original.begin(), original.end());
  previous_decoded_.assign(decoded.begin(), decoded.end());
  ++frames_;
  double part = spatial(original, decoded);
  spatial_sum_ += part;
  return part;
}

double StedMeter::spatial(std::span<const float> original, std::span<const float> decoded) {
  parallel_over(edges_.size(), [&](size_t e) {
    size_t a = size_t{3} * edges_[e].first, b = size_t{3} * edges_[e].second;
    length_[e] = std::sqrt(square_distance(&original[a], &original[b]));
    double distorted = std::sqrt(square_distance(&decoded[a], &decoded[b]));
    error_[e] = length_[e] == 0 ? 0 : (length_[e] - distorted) / length_[e];
  });
  parallel_over(vertices_, [&](size_t v) {
    double weight = 0, mean = 0, variance = 0;
    for (size_t i = first_[v]; i < first_[v + 1]; ++i) {
      weight += length_[near_[i]];
      mean += length_[near_[i]] * error_[near_[i]];
    }
    if (weight > 0) {
      mean /= weight;
      for (size_t i = first_[v]; i < first_[v + 1]; ++i) {
        double d = error_[near_[i]] - mean;
        variance += length_[near_[i]] * d * d;
      }
      variance /= weight;
    }
    deviation_[v] = std::sqrt(variance);
  });
  return sum(deviation_) / vertices_;
}

void StedMeter::measure_speeds(std::span<const float> original, std::span<const float> decoded) {
  double* speed = &speed_[size_t{frames_ % kSpeedFrames} * vertices_];
  double* error = &speed_error_[size_t{frames_ % kSpeedErrorFrames} * vertices_];
  auto edge_length = [this](const float* p, const float* q) {
    return std::sqrt(square_distance(p, q) / (diameter_ * diameter_) + kTimeStep * kTimeStep);
  };
  parallel_over(vertices_, [&](size_t v) {
    speed[v] = edge_length(&original[3 * v], &previous_original_[3 * v]);
    error[v] = std::abs(edge_length(&decoded[3 * v], &previous_decoded_[3 * v]) - speed[v]);
  });
}

/// Once the speeds of all frames up to `last` are there: the local mean of a frame takes those from
/// 4 before to 5 after it that exist.
void StedMeter::close_frame(uint32_t frame, uint32_t last) {
  uint32_t begin = frame < kWindow ? 1 : frame - kWindow + 1;
  uint32_t end = std::min(last, frame + kWindow);
  const double* error = &speed_error_[size_t{frame % kSpeedErrorFrames} * vertices_];
  parallel_over(vertices_, [&](size_t v) {
    double total = 0;
    for (uint32_t f = begin; f <= end; ++f)
      total += speed_[size_t{f % kSpeedFrames} * vertices_ + v];
    deviation_[v] = error[v] * (end - begin + 1) / total;
  });
  temporal_sum_ += sum(deviation_);
}

Sted StedMeter::finish() {
  Sted result;
  if (frames_ == 0)
    return result;
  for (uint32_t f = frames_ > kWindow + 1 ? frames_ - kWindow : 1; f < frames_; ++f)
    close_frame(f, frames_ - 1);
  result.spatial = spatial_sum_ / frames_;
  if (frames_ > 1)
    result.temporal = temporal_sum_ / (static_cast<double>(vertices_) * (frames_ - 1));
  result.sted = std::hypot(result.spatial, kTemporalWeight * result.temporal);
  return result;
}

}  // namespace anicodec
