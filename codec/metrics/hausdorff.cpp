// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/metrics/hausdorff.h"

#include "codec/parallel/task_threads.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "sdk/mesh/half_edges.h"

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Vector3d;

/// Samples of a mesh that do not depend on its positions: single vertices, pairs (mid-points), triples
/// (centres).
class Sampling {
 public:
  explicit Sampling(const Polygons& polygons) : triangles_(fan_triangles(polygons)) {
    vertices_ = triangles_;
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (size_t c = 0; c < triangles_.size(); ++c)
      edges_.push_back(edge(c));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (size_t c = 0; c < triangles_.size(); ++c) {
      vertex_of_.push_back(rank(vertices_, triangles_[c]));
      edge_of_.push_back(rank(edges_, edge(c)));
    }
  }

  const std::vector<uint32_t>& triangles() const { return triangles_; }

  void check_vertices(std::span<const float> positions) const {
    if (!vertices_.empty() && vertices_.back() >= positions.size() / 3)
      throw Error(ErrorKind::kInput, "a face uses vertex " + std::to_string(vertices_.back()) +
                                         " of " + std::to_string(positions.size() / 3));
  }

  SurfaceDistance distance(std::span<const float> positions, const ClosestPointQuery& target) const;

 private:
  using Edge = std::pair<uint32_t, uint32_t>;

  Edge edge(size_t corner) const {
    return std::minmax(triangles_[corner], triangles_[next_corner(static_cast<uint32_t>(corner))]);
  }

  template <class T>
  static size_t rank(const std::vector<T>& sorted, const T& value) {
    return static_cast<size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                               sorted.begin());
  }

  size_t samples(size_t vertex_count) const {
    return triangles_.empty() ? vertex_count
                              : vertices_.size() + edges_.size() + triangles_.size() / 3;
  }

  Vector3d sample(size_t i, std::span<const float> positions) const;
  std::vector<double> weights(std::span<const float> positions) const;

  std::vector<uint32_t> triangles_;
  std::vector<uint32_t> vertices_;  ///< used ones
  std::vector<Edge> edges_;
  std::vector<size_t> vertex_of_, edge_of_;  ///< of each corner: its vertex, and the edge from it
};

Vector3d at(std::span<const float> positions, uint32_t v) {
  const float* p = &positions[size_t{3} * v];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

Vector3d Sampling::sample(size_t i, std::span<const float> positions) const {
  if (triangles_.empty())
    return at(positions, static_cast<uint32_t>(i));
  if (i < vertices_.size())
    return at(positions, vertices_[i]);
  i -= vertices_.size();
  Vector3d result = Vector3d::Zero();
  auto add = [&](uint32_t v, double share) { result += at(positions, v) * share; };
  if (i < edges_.size()) {
    add(edges_[i].first, 0.5);
    add(edges_[i].second, 0.5);
    return result;
  }
  i -= edges_.size();
  for (size_t c = 0; c < 3; ++c)
    add(triangles_[3 * i + c], 1.0);
  return result / 3;
}

/// Weights of the samples, with sum 1: 1/20, 2/15 and 9/20 of the area of a triangle for each corner, each
/// mid-point and the centre.
std::vector<double> Sampling::weights(std::span<const float> positions) const {
  std::vector<double> result(samples(positions.size() / 3));
  double total = 0;
  for (size_t t = 0; t < triangles_.size() / 3; ++t) {
    const Vector3d a = at(positions, triangles_[3 * t]), b = at(positions, triangles_[3 * t + 1]),
                   c = at(positions, triangles_[3 * t + 2]);
    const Vector3d normal = (b - a).cross(c - a);
    const double area = std::hypot(normal[0], normal[1], normal[2]) / 2;
    total += area;
    for (size_t c3 = 3 * t; c3 < 3 * t + 3; ++c3) {
      result[vertex_of_[c3]] += area / 20;
      result[vertices_.size() + edge_of_[c3]] += area * 2 / 15;
    }
    result[vertices_.size() + edges_.size() + t] = area * 9 / 20;
  }
  if (!(total > 0))
    result.assign(result.size(), 1.0 / static_cast<double>(result.size()));
  else
    for (double& w : result)
      w /= total;
  return result;
}

SurfaceDistance Sampling::distance(std::span<const float> positions,
                                   const ClosestPointQuery& target) const {
  std::vector<double> squares(samples(positions.size() / 3));
  for_ranges(task_threads(), squares.size(), 256, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      squares[i] = target(sample(i, positions)).square_distance;
  });
  std::vector<double> weight = weights(positions);
  SurfaceDistance result;
  double mean_square = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    result.mean += weight[i] * std::sqrt(squares[i]);
    mean_square += weight[i] * squares[i];
    result.max = std::max(result.max, squares[i]);
  }
  result.rms = std::sqrt(mean_square);
  result.max = std::sqrt(result.max);
  return result;
}

HausdorffDistance distances(const Sampling& a, std::span<const float> a_positions,
                            const Sampling& b, std::span<const float> b_positions) {
  a.check_vertices(a_positions);
  b.check_vertices(b_positions);
  ClosestPointQuery to_a(a.triangles(), a_positions), to_b(b.triangles(), b_positions);
  return {a.distance(a_positions, to_b), b.distance(b_positions, to_a)};
}

}  // namespace

HausdorffDistance hausdorff(const Polygons& a, std::span<const float> a_positions,
                            const Polygons& b, std::span<const float> b_positions) {
  return distances(Sampling(a), a_positions, Sampling(b), b_positions);
}

SurfaceComparison compare_surfaces(const Polygons& a, const FrameSource& a_frames,
                                   const Polygons& b, const FrameSource& b_frames,
                                   uint32_t frame_count) {
  if (frame_count == 0)
    throw Error(ErrorKind::kInput, "a clip without frames cannot be compared");
  Sampling a_sampling(a), b_sampling(b);
  SurfaceComparison result;
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  auto gather = [frame_count](SurfaceDistance* total, const SurfaceDistance& frame) {
    total->mean += frame.mean / frame_count;
    total->rms += frame.rms * frame.rms / frame_count;
    total->max = std::max(total->max, frame.max);
  };
  for (uint32_t f = 0; f < frame_count; ++f) {
    std::span<const float> p = a_frames(f), q = b_frames(f);
    HausdorffDistance d = distances(a_sampling, p, b_sampling, q);
    if (d.max() > result.total.max())
      result.max_frame = f;
    gather(&result.total.forward, d.forward);
    gather(&result.total.backward, d.backward);
    result.frames.push_back(d);
    for (size_t i = 0; i < p.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], double{p[i]});
      high[i % 3] = std::max(high[i % 3], double{p[i]});
    }
  }
  result.total.forward.rms = std::sqrt(result.total.forward.rms);
  result.total.backward.rms = std::sqrt(result.total.backward.rms);
  result.diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  return result;
}

SurfaceComparison compare_surfaces(const MeshSequence& a, const MeshSequence& b) {
  if (a.frame_count != b.frame_count)
    throw Error(ErrorKind::kInput, "the clips have " + std::to_string(a.frame_count) + " and " +
                                       std::to_string(b.frame_count) + " frames");
  return compare_surfaces(a.polygons, frames_of(a), b.polygons, frames_of(b), a.frame_count);
}

}  // namespace anicodec
