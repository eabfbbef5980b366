// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/transfer/geodesic_landmarks.h"

#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Vector3d;

constexpr size_t kMostAnchors = 40, kFewestAnchors = 4, kMostLandmarks = 120;
constexpr double kUnsure = 0.05;      // of a distance: how well the two graphs agree
constexpr double kMostCost = 3;       // of one anchor
constexpr double kOtherPlace = 0.08;  // of the diagonal from the best place
// By `anicodec massage transfer` of three poses of a horse, decimated to 50, 35 and 25 % by three programs: below a
// disagreement of 1, or where a place had to be clearer, whole legs were left without landmarks.
constexpr double kClearer = 1.05;          // cost of the best other place in that of the best
constexpr double kMostDisagreement = 1.2;  // of a place with the others, on average
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

namespace {

/// How badly a length over the mesh and one over the surface agree.
double disagreement(double on_mesh, double on_surface, double edge) {
  if (!(on_mesh < kInfinity) || !(on_surface < kInfinity))
    return on_mesh < kInfinity || on_surface < kInfinity ? kMostCost : 0;
  return std::min(kMostCost, std::abs(on_surface - on_mesh) / (kUnsure * on_mesh + edge));
}

/// Drops, one after the other, whichever disagrees most with those that are left, until none does
/// by more than kMostDisagreement on average. `pairs`: disagreements, symmetric.
std::vector<bool> agreeing(const std::vector<std::vector<double>>& pairs) {
  const size_t n = pairs.size();
  std::vector<bool> kept(n, true);
  std::vector<double> sums(n, 0);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j)
      sums[i] += pairs[i][j];
  for (size_t left = n; left > kFewestAnchors; --left) {
    size_t worst = n;
    for (size_t i = 0; i < n; ++i) {
      if (kept[i] && (worst == n || sums[i] > sums[worst]))
        worst = i;
    }
    if (sums[worst] <= kMostDisagreement * static_cast<double>(left - 1))
      break;
    kept[worst] = false;
    for (size_t j = 0; j < n; ++j)
      sums[j] -= pairs[worst][j];
  }
  return kept;
}

using Lengths = std::vector<double>;

/// Places that are known or supposed, with the distances from them over the mesh and over the surface.
struct Places {
  std::vector<Anchor> anchors;
  std::vector<Lengths> on_mesh, on_surface;

  size_t size() const { return anchors.size(); }

  void add(Anchor anchor, Lengths mesh, Lengths surface) {
    anchors.push_back(anchor);
    on_mesh.push_back(std::move(mesh));
    on_surface.push_back(std::move(surface));
  }
};

/// The places that agree with each other.
Places consistent(Places places, double edge) {
  const size_t n = places.size();
  std::vector<std::vector<double>> pairs(n, std::vector<double>(n, 0));
  for (size_t a = 0; a < n; ++a) {
    for (size_t b = 0; b < n; ++b) {
      const double d = disagreement(places.on_mesh[a][places.anchors[b].vertex],
                                    places.on_surface[a][places.anchors[b].on_surface], edge);
      pairs[a][b] += d / 2;
      pairs[b][a] += d / 2;
    }
  }
  const std::vector<bool> kept = agreeing(pairs);
  Places result;
  for (size_t k = 0; k < n; ++k) {
    if (kept[k])
      result.add(places.anchors[k], std::move(places.on_mesh[k]), std::move(places.on_surface[k]));
  }
  return result;
}

/// The vertex of the surface that is as far from all places as one of the mesh is; none if two are.
uint32_t find_place(uint32_t vertex, const Places& places, const Positions& v, double edge,
                    double apart) {
  std::vector<double> cost(static_cast<size_t>(v.rows()), 0);
  for (size_t a = 0; a < places.size(); ++a) {
    const double length = places.on_mesh[a][vertex];
    if (places.anchors[a].vertex == vertex || !(length < kInfinity))
      continue;
    for (size_t j = 0; j < cost.size(); ++j)
      cost[j] += disagreement(length, places.on_surface[a][j], edge);
  }
  const auto best = static_cast<uint32_t>(std::ranges::min_element(cost) - cost.begin());
  for (uint32_t j = 0; j < cost.size(); ++j) {
    if (cost[j] < kClearer * cost[best] && (row(v, j) - row(v, best)).norm() > apart)
      return SurfaceTopology::kNone;
  }
  return best;
}

}  // namespace

std::vector<Landmark> geodesic_landmarks(const GeodesicGraph& mesh,
                                         const std::vector<Anchor>& anchors,
                                         const GeodesicGraph& surface_graph, const Surface& surface,
                                         int rounds) {
  if (anchors.size() < kFewestAnchors)
    return {};
  const Positions& v = surface.positions();
  const double edge = mean_edge(surface.topology(), v);
  const double apart = kOtherPlace * (v.colwise().maxCoeff() - v.colwise().minCoeff()).norm();
  // Anchors far from each other, then vertices far from them and each other.
  Places places;
  Lengths least;
  Anchor anchor = anchors[0];
  for (;;) {
    places.add(anchor, mesh.distances(anchor.vertex), surface_graph.distances(anchor.on_surface));
    if (places.size() == 1)
      least = places.on_mesh[0];
    lower(&least, places.on_mesh.back());
    if (places.size() == kMostAnchors)
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
  std::vector<Lengths> from_vertices;
  while (vertices.size() < kMostLandmarks) {
    const uint32_t i = farthest(least);
    if (i == SurfaceTopology::kNone)
      break;
    vertices.push_back(i);
    from_vertices.push_back(mesh.distances(i));
    lower(&least, from_vertices.back());
  }
  places = consistent(std::move(places), edge);
  for (int round = 0; round < rounds; ++round) {
    std::vector<uint32_t> found(vertices.size());
    parallel_for(size_t{0}, vertices.size(),
                 [&](size_t k) { found[k] = find_place(vertices[k], places, v, edge, apart); });
    places = {};
    for (size_t k = 0; k < vertices.size(); ++k) {
      if (found[k] != SurfaceTopology::kNone)
        places.add({vertices[k], found[k]}, from_vertices[k], surface_graph.distances(found[k]));
    }
    places = consistent(std::move(places), edge);
  }
  std::vector<Landmark> landmarks;
  for (const Anchor& place : places.anchors)
    landmarks.push_back({place.vertex, row(v, place.on_surface)});
  return landmarks;
}

}  // namespace anicodec
