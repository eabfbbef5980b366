// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/deformation_gradients.h"

#include "codec/sequence/error.h"
#include "sdk/msgi/patch_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Faces per leaf of the order of elimination.
constexpr uint32_t kLeafFaces = 16;

/// Weight of every edge beside the triangles' own, against the mean of those: nothing to see, but
/// what only degenerate triangles hold stays together.
constexpr double kEdgeWeight = 1e-9;

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

}  // namespace

Vector3d nearest_logarithm(const Vector3d& principal, const Vector3d& wanted) {
  const double angle = principal.norm();
  Vector3d axis = Vector3d::UnitX();
  if (angle > 1e-9)
    axis = principal / angle;
  else if (wanted.norm() > 1e-9)
    axis = wanted.normalized();
  return axis * (angle + kFullTurn * std::round((axis.dot(wanted) - angle) / kFullTurn));
}

RotationAndStretch decompose(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  Vector3d values = svd.singularValues();
  if (u.determinant() * svd.matrixV().determinant() < 0) {
    u.col(2) = -u.col(2);
    values[2] = -values[2];
  }
  const Eigen::AngleAxisd turn(Matrix3d(u * svd.matrixV().transpose()));
  return {turn.angle() * turn.axis(),
          svd.matrixV() * values.asDiagonal() * svd.matrixV().transpose()};
}

Matrix3d exponential(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-14)
    return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Vector3d DeformationGradients::normal(const Points& x, size_t t) const {
  const uint32_t* c = &graph_.corners[3 * t];
  const Vector3d a = x.col(column(c[0]));
  return (x.col(column(c[1])) - a).cross(x.col(column(c[2])) - a);
}

/// Two edges and the normal, which grows with the edges.
Matrix3d DeformationGradients::frame(const Points& x, size_t t) const {
  const uint32_t* c = &graph_.corners[3 * t];
  const Vector3d n = normal(x, t);
  const double size = n.norm();
  Matrix3d frame;
  frame.col(0) = x.col(column(c[1])) - x.col(column(c[0]));
  frame.col(1) = x.col(column(c[2])) - x.col(column(c[0]));
  frame.col(2) = size > 0 ? Vector3d(n / std::sqrt(size)) : Vector3d::Zero();
  return frame;
}

DeformationGradients::DeformationGradients(const EdgeNetwork& network, const Points& reference)
    : graph_(make_face_graph(network.triangles.data(), network.triangles.size() / 3,
                             network.vertex_count)),
      reference_(reference) {
  const size_t triangles = graph_.face_count();
  areas_.resize(triangles);
  inverse_frames_.assign(triangles, Matrix3d::Zero());
  hats_.assign(triangles, Matrix3d::Zero());
  double longest = 0;
  for (const FaceGraph::Edge& e : graph_.edges)
    longest = std::max(longest, (reference.col(column(e.a)) - reference.col(column(e.b))).norm());
  Vector<SparseLdlt::Edge> edges;
  for (const FaceGraph::Edge& e : graph_.edges)
    edges.push_back({e.a, e.b, 0});
  double total = 0;
  for (size_t t = 0; t < triangles; ++t) {
    const uint32_t* c = &graph_.corners[3 * t];
    const Vector3d n = normal(reference, t);
    areas_[t] = n.norm() / 2;
    // Thinner than this no gradient is worth having.
    if (!(areas_[t] > 1e-14 * longest * longest)) {
      areas_[t] = 0;
      continue;
    }
    inverse_frames_[t] = frame(reference, t).inverse();
    for (Index k = 0; k < 3; ++k) {
      const Vector3d opposite =
          reference.col(column(c[(k + 2) % 3])) - reference.col(column(c[(k + 1) % 3]));
      hats_[t].col(k) = n.cross(opposite) / n.squaredNorm();
    }
    // The stiffness of two corners is that of the edge between them.
    for (size_t k = 0; k < 3; ++k) {
      const double weight =
          -areas_[t] *
          hats_[t].col(static_cast<Index>(k)).dot(hats_[t].col(static_cast<Index>((k + 1) % 3)));
      edges[graph_.face_edges[3 * t + k]].weight += weight;
      total += std::abs(weight);
    }
  }
  if (!(total > 0))
    throw Error(ErrorKind::kInput, "deformation gradients need a triangle with an area");
  const double held = kEdgeWeight * total / static_cast<double>(edges.size());
  edge_weights_.assign(edges.size(), held);
  for (SparseLdlt::Edge& e : edges)
    e.weight += held;

  Vector<uint32_t> group = make_patch_hierarchy(graph_, kLeafFaces).vertex_node;
  std::vector<char> started(graph_.component_count);
  for (uint32_t v = 0; v < graph_.vertex_count; ++v) {
    const uint32_t part = graph_.vertex_component[v];
    if (part != kNoIndex && !started[part]) {
      started[part] = 1;
      group[v] = SparseLdlt::kFixed;
    }
  }
  if (system_.init(group, edges, SIZE_MAX) != Status::kOk)
    throw Error(ErrorKind::kInput, "the triangles are too thin for deformation gradients");
}

DeformationGradients::Gradients DeformationGradients::measure(const Points& x,
                                                              RotationTracking tracking) const {
  Gradients gradients;
  gradients.turns.assign(triangle_count(), Vector3d::Zero());
  gradients.stretches.assign(triangle_count(), Matrix3d::Identity());
  for (size_t t = 0; t < triangle_count(); ++t) {
    if (areas_[t] == 0)
      continue;
    RotationAndStretch parts = decompose(frame(x, t) * inverse_frames_[t]);
    gradients.turns[t] = parts.turn;
    gradients.stretches[t] = parts.stretch;
  }
  if (tracking != RotationTracking::kNone)
    track(x, tracking, gradients);
  return gradients;
}

void DeformationGradients::track(const Points& x, RotationTracking tracking,
                                 Gradients& gradients) const {
  // Each component starts at the triangle that turns least.
  std::vector<uint32_t> seed(graph_.component_count, kNoIndex);
  for (uint32_t t = 0; t < triangle_count(); ++t) {
    uint32_t& best = seed[graph_.face_component[t]];
    if (best == kNoIndex || gradients.turns[t].norm() < gradients.turns[best].norm())
      best = t;
  }
  std::vector<char> done(triangle_count());
  for (uint32_t s : seed)
    track_component(x, tracking, s, done, gradients);
}

void DeformationGradients::track_component(const Points& x, RotationTracking tracking,
                                           uint32_t seed, std::vector<char>& done,
                                           Gradients& gradients) const {
  std::vector<Vector3d>& turns = gradients.turns;
  auto branch = [&](uint32_t t, uint32_t from) -> Vector3d {
    return areas_[t] == 0 ? turns[from] : nearest_logarithm(turns[t], turns[from]);
  };
  // Key, order of discovery, triangle, where from. Equal keys go first come, first served, which
  // makes breadth first of equal keys.
  using Step = std::tuple<double, uint64_t, uint32_t, uint32_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> queue;
  uint64_t found = 0;
  queue.push({0, found++, seed, kNoIndex});
  while (!queue.empty()) {
    auto [key, order, t, from] = queue.top();
    queue.pop();
    if (done[t])
      continue;
    done[t] = 1;
    if (from != kNoIndex)
      turns[t] = branch(t, from);
    for (uint32_t k = graph_.begin[t]; k < graph_.begin[t + 1]; ++k) {
      const uint32_t next = graph_.neighbours[k];
      if (done[next])
        continue;
      double cost = 0;
      if (tracking != RotationTracking::kBreadthFirst)
        cost = (branch(next, t) - turns[t]).norm();
      if (tracking == RotationTracking::kPrioritizedNormals)
        cost += angle_between(normal(reference_, t).normalized(),
                              normal(reference_, next).normalized()) +
                angle_between(normal(x, t).normalized(), normal(x, next).normalized());
      queue.push({cost, found++, next, t});
    }
  }
}

Points DeformationGradients::solve(std::span<const Matrix3d> gradients, const Points& guide) const {
  Eigen::Matrix3Xd right = Eigen::Matrix3Xd::Zero(3, guide.cols());
  for (size_t t = 0; t < triangle_count(); ++t) {
    if (areas_[t] == 0)
      continue;
    const Matrix3d push = areas_[t] * gradients[t] * hats_[t];
    for (size_t k = 0; k < 3; ++k)
      right.col(column(graph_.corners[3 * t + k])) += push.col(static_cast<Index>(k));
  }
  for (size_t e = 0; e < edge_weights_.size(); ++e) {
    const FaceGraph::Edge& edge = graph_.edges[e];
    const Vector3d pull =
        edge_weights_[e] * (guide.col(column(edge.a)) - guide.col(column(edge.b)));
    right.col(column(edge.a)) += pull;
    right.col(column(edge.b)) -= pull;
  }
  std::vector<double> solution(system_.scratch_size());
  using Lanes = Eigen::Map<Eigen::Matrix<double, SparseLdlt::kLanes, Eigen::Dynamic>>;
  Lanes lanes(solution.data(), SparseLdlt::kLanes, static_cast<Index>(system_.size()));
  for (uint32_t i = 0; i < system_.size(); ++i)
    lanes.col(column(i)).head<3>() = right.col(column(system_.vertices()[i]));
  system_.solve(solution.data(), {});

  Points x = Points::Zero(3, guide.cols());
  for (uint32_t i = 0; i < system_.size(); ++i)
    x.col(column(system_.vertices()[i])) = lanes.col(column(i)).head<3>();
  std::vector<Vector3d> shift(graph_.component_count, Vector3d::Zero());
  std::vector<double> size(graph_.component_count, 0);
  for (uint32_t v = 0; v < graph_.vertex_count; ++v) {
    const uint32_t part = graph_.vertex_component[v];
    if (part == kNoIndex)
      continue;
    shift[part] += guide.col(column(v)) - x.col(column(v));
    size[part] += 1;
  }
  for (uint32_t v = 0; v < graph_.vertex_count; ++v) {
    const uint32_t part = graph_.vertex_component[v];
    if (part == kNoIndex)
      x.col(column(v)) = guide.col(column(v));
    else
      x.col(column(v)) += shift[part] / size[part];
  }
  return x;
}

GradientInterpolation::GradientInterpolation(const EdgeNetwork& network,
                                             std::span<const Points> inputs,
                                             RotationTracking tracking)
    : gradients_(network, inputs[0]), inputs_(inputs.begin(), inputs.end()) {
  for (const Points& x : inputs_)
    measured_.push_back(gradients_.measure(x, tracking));
}

Points GradientInterpolation::evaluate(std::span<const double> weights) const {
  std::vector<Matrix3d> blended(gradients_.triangle_count());
  for (size_t t = 0; t < blended.size(); ++t) {
    Vector3d turn = Vector3d::Zero();
    Matrix3d stretch = Matrix3d::Zero();
    for (size_t i = 0; i < measured_.size(); ++i) {
      turn += weights[i] * measured_[i].turns[t];
      stretch += weights[i] * measured_[i].stretches[t];
    }
    blended[t] = exponential(turn) * stretch;
  }
  Points guide = weights[0] * inputs_[0];
  for (size_t i = 1; i < inputs_.size(); ++i)
    guide += weights[i] * inputs_[i];
  return gradients_.solve(blended, guide);
}

}  // namespace anicodec
