// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/edge_network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Lengths that an extrapolation may not undercut, against the shortest of the inputs.
constexpr double kShortestShare = 0.1;

/// Triangles below this share of their area count as collapsed.
constexpr double kCollapsedShare = 0.1;

/// Area by Heron's formula; 0 where the sides make no triangle.
double area(double a, double b, double c) {
  const double s = (a + b + c) / 2;
  return std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
}

}  // namespace

EdgeNetwork::EdgeNetwork(std::span<const uint32_t> corners, uint32_t vertices)
    : vertex_count(vertices) {
  FaceGraph graph = make_face_graph(corners.data(), corners.size() / 3, vertices);
  triangles = std::move(graph.corners);
  edges = std::move(graph.edges);
  triangle_edges = std::move(graph.face_edges);
  // The face last seen at an edge, and its corner opposite.
  std::vector<std::pair<uint32_t, uint32_t>> last(edges.size(), {kNoIndex, 0});
  for (size_t side = 0; side < triangle_edges.size(); ++side) {
    const uint32_t e = triangle_edges[side];
    if (e == kNoIndex)
      continue;
    const auto face = static_cast<uint32_t>(side / 3);
    const uint32_t opposite = triangles[3 * size_t{face} + (side + 2) % 3];
    auto [before, corner] = last[e];
    if (before != kNoIndex && before != face && corner != opposite)
      hinges.push_back({edges[e].a, edges[e].b, corner, opposite, before, face, e});
    last[e] = {face, opposite};
  }
}

Points to_points(std::span<const float> positions) {
  return Eigen::Map<const Eigen::Matrix3Xf>(positions.data(), 3,
                                            static_cast<Index>(positions.size() / 3))
      .cast<double>();
}

double dihedral_angle(const Points& x, const Hinge& h) {
  const Vector3d a = x.col(h.a);
  const Vector3d along = x.col(h.b) - a;
  const double length = along.norm();
  if (!(length > 0))
    return 0;
  const Vector3d u = along / length;
  const Vector3d n0 = u.cross(x.col(h.c) - a);
  const Vector3d n1 = (x.col(h.d) - a).cross(u);
  const double sine = u.dot(n0.cross(n1)), cosine = n0.dot(n1);
  return sine == 0 && cosine == 0 ? 0 : std::atan2(sine, cosine);
}

EdgeShape measure_edges(const EdgeNetwork& network, const Points& x) {
  EdgeShape shape;
  shape.lengths.resize(static_cast<Index>(network.edges.size()));
  shape.angles.resize(static_cast<Index>(network.hinges.size()));
  for (size_t e = 0; e < network.edges.size(); ++e)
    shape.lengths[static_cast<Index>(e)] =
        (x.col(network.edges[e].a) - x.col(network.edges[e].b)).norm();
  for (size_t h = 0; h < network.hinges.size(); ++h)
    shape.angles[static_cast<Index>(h)] = dihedral_angle(x, network.hinges[h]);
  return shape;
}

std::vector<EdgeShape> measure_edges(const EdgeNetwork& network, std::span<const Points> inputs) {
  std::vector<EdgeShape> shapes;
  for (const Points& x : inputs) {
    shapes.push_back(measure_edges(network, x));
    Eigen::VectorXd& angles = shapes.back().angles;
    angles.array() += kFullTurn * ((shapes.front().angles - angles).array() / kFullTurn).round();
  }
  return shapes;
}

EdgeShape blend_edges(std::span<const EdgeShape> shapes, std::span<const double> weights) {
  EdgeShape blend{Eigen::VectorXd::Zero(shapes[0].lengths.size()),
                  Eigen::VectorXd::Zero(shapes[0].angles.size())};
  Eigen::VectorXd shortest = shapes[0].lengths;
  for (size_t i = 0; i < shapes.size(); ++i) {
    blend.lengths += weights[i] * shapes[i].lengths;
    blend.angles += weights[i] * shapes[i].angles;
    shortest = shortest.cwiseMin(shapes[i].lengths);
  }
  blend.lengths = blend.lengths.cwiseMax(kShortestShare * shortest);
  return blend;
}

double enclosed_volume(const EdgeNetwork& network, const Points& x) {
  const Vector3d centre = x.rowwise().mean();
  double sum = 0;
  for (size_t t = 0; t < network.triangles.size(); t += 3) {
    const uint32_t* c = &network.triangles[t];
    sum += (x.col(c[0]) - centre).dot((x.col(c[1]) - centre).cross(x.col(c[2]) - centre));
  }
  return sum / 6;
}

EdgeError edge_error(const EdgeNetwork& network, const Points& x, const EdgeShape& target,
                     double target_volume) {
  const EdgeShape shape = measure_edges(network, x);
  EdgeError error;
  if (shape.lengths.size() > 0) {
    // Edges without length in the target would hide all others.
    const double least = std::max(1e-9 * target.lengths.mean(), std::numeric_limits<double>::min());
    const Eigen::ArrayXd lengths =
        (shape.lengths - target.lengths).array().abs() / target.lengths.array().max(least);
    error.length = lengths.mean();
    error.largest_length = lengths.maxCoeff();
  }
  if (shape.angles.size() > 0) {
    const Eigen::ArrayXd turns = (shape.angles - target.angles).array() / kFullTurn;
    const Eigen::ArrayXd off = kFullTurn * (turns - turns.round()).abs();
    error.angle = off.mean();
    error.folded = static_cast<uint32_t>((off > kFullTurn / 4).count());
  }
  for (size_t side = 0; side < network.triangle_edges.size(); side += 3) {
    const uint32_t* e = &network.triangle_edges[side];
    if (std::max({e[0], e[1], e[2]}) == kNoIndex)
      continue;
    auto area_by = [&](const Eigen::VectorXd& l) {
      return area(l[static_cast<Index>(e[0])], l[static_cast<Index>(e[1])],
                  l[static_cast<Index>(e[2])]);
    };
    error.collapsed += area_by(shape.lengths) < kCollapsedShare * area_by(target.lengths);
  }
  if (target_volume != 0)
    error.volume = std::abs(enclosed_volume(network, x) - target_volume) / std::abs(target_volume);
  return error;
}

}  // namespace anicodec
