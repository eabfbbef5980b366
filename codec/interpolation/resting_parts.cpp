// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/resting_parts.h"

#include "codec/algebra/rigid_motion.h"
#include "sdk/msgi/face_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anicodec {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A vertex rests if it moves by less than this share of the diagonal of all inputs, as rounding to
/// float32 does.
constexpr double kTolerance = 1e-6;

/// How much a vertex that moves counts against one that rests: enough to decide what these leave open.
constexpr double kMovingWeight = 1e-6;

Vector3d vector_at(std::span<const float> values, size_t vertex) {
  return Eigen::Map<const Eigen::Vector3f>(&values[3 * vertex]).cast<double>();
}

double diagonal_of(std::span<const std::span<const float>> inputs) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Vector3d low = Vector3d::Constant(kFar), high = -low;
  for (const std::span<const float> x : inputs) {
    for (size_t v = 0; v < x.size() / 3; ++v) {
      low = low.cwiseMin(vector_at(x, v));
      high = high.cwiseMax(vector_at(x, v));
    }
  }
  return (high - low).norm();
}

}  // namespace

RestingParts::RestingParts(std::span<const uint32_t> triangles, uint32_t vertex_count,
                           std::span<const std::span<const float>> inputs) {
  const FaceGraph graph = make_face_graph(triangles.data(), triangles.size() / 3, vertex_count);
  component_.assign(graph.vertex_component.begin(), graph.vertex_component.end());
  component_count_ = graph.component_count;
  const double most = kTolerance * diagonal_of(inputs);
  for (uint32_t v = 0; v < vertex_count; ++v) {
    const Vector3d first = vector_at(inputs[0], v);
    const bool rests =
        component_[v] != kNoIndex && std::ranges::all_of(inputs, [&](std::span<const float> x) {
          return (vector_at(x, v) - first).norm() <= most;
        });
    if (rests)
      places_.push_back({v, {inputs[0][3 * v], inputs[0][3 * v + 1], inputs[0][3 * v + 2]}});
  }
}

void RestingParts::anchor(std::span<float> positions) const {
  struct Fit {
    double weight = 0;
    Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
    Matrix3d products = Matrix3d::Zero();
    bool rests = false;
  };

  std::vector<Fit> fits(component_count_);
  for (const Place& place : places_)
    fits[component_[place.vertex]].rests = true;
  // Twice over all vertices: weighted means first, then products about them.
  const auto for_pairs = [&](auto body) {
    auto place = places_.begin();
    for (uint32_t v = 0; v < component_.size(); ++v) {
      const Vector3d x = vector_at(positions, v);
      if (place != places_.end() && place->vertex == v) {
        body(fits[component_[v]], 1.0, x,
             Eigen::Map<const Eigen::Vector3f>(place->at).cast<double>());
        ++place;
      } else if (component_[v] != kNoIndex && fits[component_[v]].rests) {
        body(fits[component_[v]], kMovingWeight, x, x);
      }
    }
  };
  for_pairs([](Fit& fit, double weight, const Vector3d& from, const Vector3d& to) {
    fit.weight += weight;
    fit.from += weight * from;
    fit.to += weight * to;
  });
  for_pairs([](Fit& fit, double weight, const Vector3d& from, const Vector3d& to) {
    fit.products +=
        weight * (to - fit.to / fit.weight) * (from - fit.from / fit.weight).transpose();
  });
  std::vector<RigidMotion> motions(fits.size());
  for (size_t c = 0; c < fits.size(); ++c) {
    if (!fits[c].rests)
      continue;
    motions[c].rotation = best_rotation(fits[c].products);
    motions[c].translation =
        fits[c].to / fits[c].weight - motions[c].rotation * (fits[c].from / fits[c].weight);
  }
  for (uint32_t v = 0; v < component_.size(); ++v) {
    if (component_[v] == kNoIndex || !fits[component_[v]].rests)
      continue;
    const RigidMotion& m = motions[component_[v]];
    const Eigen::Vector3f moved =
        (m.rotation * vector_at(positions, v) + m.translation).cast<float>();
    std::copy_n(moved.data(), 3, &positions[3 * size_t{v}]);
  }
}

}  // namespace anicodec
