// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/geodesic_landmarks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Vector3d;

constexpr size_t kMostAnchors = 40, kFewestAnchors = 4, kMostLandmarks = 120;
constexpr double kUnsure = 0.05;      // of a distance: how well the two graphs agree
constexpr double kMostCost = 3;       // of one anchor
constexpr double kOtherPlace = 0.08;  // of the diagonal from the best place
constexpr double kClearer = 1.25;     // cost of the best other place in that of the best
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The length of the diagonal from p to q of the flattened pair of triangles (p, a, b), (q, b, a);
/// 0 if it does not cross the edge (a, b).
double other_diagonal(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b) {
  const Vector3d side = b - a;
  const double length = side.norm();
  if (!(length > 0))
    return 0;
  const double px = (p - a).dot(side) / length, qx = (q - a).dot(side) / length;
  const double py = (p - a).cross(side).norm() / length, qy = (q - a).cross(side).norm() / length;
  if (!(py + qy > 0))
    return 0;
  const double crossing = (px * qy + qx * py) / (py + qy);
  return crossing > 0 && crossing < length ? std::hypot(px - qx, py + qy) : 0;
}

uint32_t farthest(const std::vector<double>& distances) {
  double most = 0;
  uint32_t place = SurfaceTopology::kNone;
  for (uint32_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > most && distances[i] < kInfinity) {
      most = distances[i];
      place = i;
    }
  }
  return place;
}

void lower(std::vector<double>* least, const std::vector<double>& distances) {
  for (size_t i = 0; i < least->size(); ++i)
    (*least)[i] = std::min((*least)[i], distances[i]);
}

}  // namespace

GeodesicGraph::GeodesicGraph(const SurfaceTopology& topology, const Positions& positions)
    : first_(size_t{topology.vertex_count} + 1, 0) {
  std::vector<std::pair<std::array<uint32_t, 2>, double>> list;
  auto add = [&list](uint32_t a, uint32_t b, double length) {
    list.push_back({{a, b}, length});
    list.push_back({{b, a}, length});
  };
  for (const auto& [a, b] : edges(topology))
    add(a, b, (row(positions, a) - row(positions, b)).norm());
  for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
    const SurfaceTopology::Triangle& corner = topology.triangles[t];
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t beyond = topology.across[t][k];
      if (beyond == SurfaceTopology::kNone || beyond < t)
        continue;
      const uint32_t a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
      uint32_t other = a;
      for (uint32_t v : topology.triangles[beyond]) {
        if (v != a && v != b)
          other = v;
      }
      if (other == a || other == corner[k])
        continue;
      const double length = other_diagonal(row(positions, corner[k]), row(positions, other),
                                           row(positions, a), row(positions, b));
      if (length > 0)
        add(corner[k], other, length);
    }
  }
  std::sort(list.begin(), list.end());
  for (const auto& [ends, length] : list) {
    ++first_[ends[0] + size_t{1}];
    ways_.push_back({ends[1], length});
  }
  for (size_t i = 1; i < first_.size(); ++i)
    first_[i] += first_[i - 1];
}

std::vector<double> GeodesicGraph::distances(uint32_t from) const {
  using Item = std::pair<double, uint32_t>;
  std::vector<double> result(first_.size() - 1, kInfinity);
  std::priority_queue<Item, std::vector<Item>, std::greater<>> next;
  result[from] = 0;
  next.push({0, from});
  while (!next.empty()) {
    const auto [length, i] = next.top();
    next.pop();
    if (length > result[i])
      continue;
    for (size_t w = first_[i]; w < first_[size_t{i} + 1]; ++w) {
      const double there = length + ways_[w].length;
      if (there < result[ways_[w].end]) {
        result[ways_[w].end] = there;
        next.push({there, ways_[w].end});
      }
    }
  }
  return result;
}

std::vector<Landmark> geodesic_landmarks(const GeodesicGraph& mesh,
                                         const std::vector<Anchor>& anchors,
                                         const GeodesicGraph& surface_graph,
                                         const Surface& surface) {
  if (anchors.size() < kFewestAnchors)
    return {};
  // Anchors far from each other, with the distances from them over both.
  std::vector<std::vector<double>> on_mesh, on_surface;
  std::vector<double> least;
  Anchor anchor = anchors[0];
  for (;;) {
    on_mesh.push_back(mesh.distances(anchor.vertex));
    on_surface.push_back(surface_graph.distances(anchor.on_surface));
    if (least.empty())
      least = on_mesh[0];
    lower(&least, on_mesh.back());
    if (on_mesh.size() == kMostAnchors)
      break;
    double most = 0;
    for (const Anchor& other : anchors) {
      if (least[other.vertex] > most && least[other.vertex] < kInfinity) {
        most = least[other.vertex];
        anchor = other;
      }
    }
    if (!(most > 0))
      break;
  }
  std::vector<uint32_t> vertices;
  while (vertices.size() < kMostLandmarks) {
    const uint32_t i = farthest(least);
    if (i == SurfaceTopology::kNone)
      break;
    vertices.push_back(i);
    lower(&least, mesh.distances(i));
  }
  const Positions& places = surface.positions();
  const double edge = mean_edge(surface.topology(), places);
  const double apart =
      kOtherPlace * (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
  std::vector<uint32_t> match(vertices.size(), SurfaceTopology::kNone);
  tbb::parallel_for(size_t{0}, vertices.size(), [&](size_t k) {
    std::vector<double> cost(surface.topology().vertex_count, 0);
    for (size_t a = 0; a < on_mesh.size(); ++a) {
      const double length = on_mesh[a][vertices[k]];
      if (!(length < kInfinity))
        continue;
      for (size_t j = 0; j < cost.size(); ++j)
        cost[j] +=
            std::min(kMostCost, std::abs(on_surface[a][j] - length) / (kUnsure * length + edge));
    }
    const auto best =
        static_cast<uint32_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
    for (uint32_t j = 0; j < cost.size(); ++j) {
      if (cost[j] < kClearer * cost[best] && (row(places, j) - row(places, best)).norm() > apart)
        return;
    }
    match[k] = best;
  });
  std::vector<Landmark> landmarks;
  for (size_t k = 0; k < vertices.size(); ++k) {
    if (match[k] != SurfaceTopology::kNone)
      landmarks.push_back({vertices[k], row(places, match[k])});
  }
  return landmarks;
}

}  // namespace anicodec
