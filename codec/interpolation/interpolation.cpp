// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/interpolation.h"

#include "codec/algebra/rigid_motion.h"
#include "codec/interpolation/deformation_gradients.h"
#include "codec/interpolation/edge_refinement.h"
#include "codec/interpolation/resting_parts.h"
#include "codec/interpolation/vertex_blending.h"
#include "codec/parallel/task_threads.h"
#include "codec/sequence/error.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace anicodec {
namespace {

constexpr uint32_t kMostLeafFaces = 8;

/// Patches may be as large as leaves the error within this share of the least.
constexpr double kWorthwhile = 0.25;

/// Weights may miss a sum of one by this much.
constexpr double kSumTolerance = 1e-5;

void check_weights(std::span<const double> weights, size_t inputs) {
  double sum = 0;
  for (double w : weights)
    sum += w;
  if (weights.size() != inputs)
    throw Error(ErrorKind::kUsage, std::to_string(weights.size()) + " weights for " +
                                       std::to_string(inputs) + " meshes");
  if (!(std::abs(sum - 1) <= kSumTolerance))
    throw Error(ErrorKind::kUsage, "the weights sum to " + std::to_string(sum) + ", not to 1");
}

std::vector<Points> all_points(std::span<const std::span<const float>> inputs) {
  std::vector<Points> points;
  for (std::span<const float> x : inputs)
    points.push_back(to_points(x));
  return points;
}

/// Methods that compute in double.
class PointInterpolation : public Interpolation {
 public:
  std::span<const float> evaluate(std::span<const double> weights,
                                  std::span<const float> /*pins*/) final {
    check_weights(weights, inputs_);
    const Points x = at(weights);
    out_.resize(static_cast<size_t>(x.size()));
    Eigen::Map<Eigen::Matrix3Xf>(out_.data(), 3, x.cols()) = x.cast<float>();
    return out_;
  }

 protected:
  explicit PointInterpolation(size_t inputs) : inputs_(inputs) {}

  virtual Points at(std::span<const double> weights) = 0;

 private:
  size_t inputs_;
  std::vector<float> out_;
};

class Linear : public PointInterpolation {
 public:
  explicit Linear(std::vector<Points> inputs)
      : PointInterpolation(inputs.size()), points_(std::move(inputs)) {}

 private:
  Points at(std::span<const double> weights) override {
    Points x = weights[0] * points_[0];
    for (size_t i = 1; i < points_.size(); ++i)
      x += weights[i] * points_[i];
    return x;
  }

  std::vector<Points> points_;
};

class Gradients : public PointInterpolation {
 public:
  Gradients(const EdgeNetwork& network, std::span<const Points> inputs, RotationTracking tracking)
      : PointInterpolation(inputs.size()), gradients_(network, inputs, tracking) {}

 private:
  Points at(std::span<const double> weights) override { return gradients_.evaluate(weights); }

  GradientInterpolation gradients_;
};

class Vertices : public PointInterpolation {
 public:
  Vertices(const EdgeNetwork& network, std::span<const Points> inputs, uint32_t leaf_faces)
      : PointInterpolation(inputs.size()), blending_(network, inputs, leaf_faces) {}

 private:
  Points at(std::span<const double> weights) override { return blending_.evaluate(weights); }

  VertexBlending blending_;
};

class MultiScale : public Interpolation {
 public:
  MultiScale(std::span<const uint32_t> triangles, uint32_t vertex_count,
             std::span<const std::span<const float>> inputs, const Msgi::Options& options)
      : out_(3 * size_t{vertex_count}) {
    std::vector<const float*> pointers;
    for (std::span<const float> x : inputs)
      pointers.push_back(x.data());
    const Status status = msgi_.init(triangles.data(), triangles.size() / 3, vertex_count,
                                     pointers.data(), pointers.size(), options);
    if (status != Status::kOk)
      throw Error(ErrorKind::kInput,
                  std::string("the meshes cannot be interpolated: ") + status_string(status));
    scratch_.resize((msgi_.scratch_bytes() + 7) / 8);
  }

  std::span<const float> evaluate(std::span<const double> weights,
                                  std::span<const float> pins) override {
    check_weights(weights, msgi_.input_count());
    const Status status = msgi_.evaluate(weights.data(), pins.empty() ? nullptr : pins.data(),
                                         scratch_.data(), out_.data(), task_threads());
    if (status != Status::kOk)
      throw Error(ErrorKind::kUsage, status_string(status));
    return out_;
  }

 private:
  Msgi msgi_;
  std::vector<double> scratch_;
  std::vector<float> out_;
};

/// Another interpolation, refined, and moved rigidly to where that had it.
class Refined : public PointInterpolation {
 public:
  Refined(std::unique_ptr<Interpolation> start, const EdgeNetwork& network,
          std::span<const Points> inputs, int steps)
      : PointInterpolation(inputs.size()),
        start_(std::move(start)),
        network_(network),
        refinement_(network_),
        shapes_(measure_edges(network_, inputs)),
        steps_(steps) {}

 private:
  Points at(std::span<const double> weights) override {
    const std::span<const float> start = start_->evaluate(weights);
    Points x = to_points(start);
    refinement_.refine(blend_edges(shapes_, weights), steps_, x);
    const Eigen::Matrix3Xf refined = x.cast<float>();
    const RigidMotion motion =
        fit_rigid_motion({refined.data(), static_cast<size_t>(refined.size())}, start);
    return (motion.rotation * x).colwise() + motion.translation;
  }

  std::unique_ptr<Interpolation> start_;
  EdgeNetwork network_;
  EdgeRefinement refinement_;
  std::vector<EdgeShape> shapes_;
  int steps_;
};

/// Another interpolation, with what rests in all inputs at its place.
class Anchored : public Interpolation {
 public:
  Anchored(std::unique_ptr<Interpolation> inner, RestingParts parts)
      : inner_(std::move(inner)), parts_(std::move(parts)) {}

  std::span<const float> evaluate(std::span<const double> weights,
                                  std::span<const float> pins) override {
    const std::span<const float> x = inner_->evaluate(weights, pins);
    out_.assign(x.begin(), x.end());
    parts_.anchor(out_);
    return out_;
  }

 private:
  std::unique_ptr<Interpolation> inner_;
  RestingParts parts_;
  std::vector<float> out_;
};

void check_pins(const InterpolationOptions& options, uint32_t vertex_count) {
  if (!options.pins.empty() && options.method != InterpolationMethod::kMsgi)
    throw Error(ErrorKind::kUsage, "only msgi takes pins");
  if (!options.pins.empty() && options.refinement_steps > 0)
    throw Error(ErrorKind::kUsage, "pins do not go with refinement");
  std::vector<uint32_t> pins = options.pins;
  std::sort(pins.begin(), pins.end());
  if (!pins.empty() && pins.back() >= vertex_count)
    throw Error(ErrorKind::kUsage, "vertex " + std::to_string(pins.back()) +
                                       " cannot be pinned: the meshes have " +
                                       std::to_string(vertex_count));
  auto twice = std::adjacent_find(pins.begin(), pins.end());
  if (twice != pins.end())
    throw Error(ErrorKind::kUsage, "vertex " + std::to_string(*twice) + " is pinned twice");
}

/// Without refinement.
std::unique_ptr<Interpolation> make_plain(std::span<const uint32_t> triangles,
                                          uint32_t vertex_count,
                                          std::span<const std::span<const float>> inputs,
                                          const InterpolationOptions& options) {
  uint32_t leaf = options.leaf_faces;
  switch (options.method) {
    case InterpolationMethod::kLinear:
      return std::make_unique<Linear>(all_points(inputs));
    case InterpolationMethod::kVertexBlending:
      return std::make_unique<Vertices>(EdgeNetwork(triangles, vertex_count), all_points(inputs),
                                        leaf > 0 ? leaf : kMostLeafFaces);
    case InterpolationMethod::kMsgi: {
      Msgi::Options msgi;
      msgi.leaf_faces = leaf > 0 ? leaf : choose_leaf_faces(triangles, vertex_count, inputs);
      msgi.sweeps = options.sweeps;
      msgi.pins.assign(options.pins.begin(), options.pins.end());
      return std::make_unique<MultiScale>(triangles, vertex_count, inputs, msgi);
    }
    default:
      break;
  }
  auto tracking = RotationTracking::kNone;
  if (options.method == InterpolationMethod::kBreadthFirst)
    tracking = RotationTracking::kBreadthFirst;
  else if (options.method == InterpolationMethod::kPml)
    tracking = RotationTracking::kPrioritized;
  else if (options.method == InterpolationMethod::kPmln)
    tracking = RotationTracking::kPrioritizedNormals;
  return std::make_unique<Gradients>(EdgeNetwork(triangles, vertex_count), all_points(inputs),
                                     tracking);
}

}  // namespace

std::span<const InterpolationMethod> interpolation_methods() {
  static constexpr InterpolationMethod kAll[] = {
      InterpolationMethod::kLinear,       InterpolationMethod::kGradients,
      InterpolationMethod::kBreadthFirst, InterpolationMethod::kPml,
      InterpolationMethod::kPmln,         InterpolationMethod::kVertexBlending,
      InterpolationMethod::kMsgi};
  return kAll;
}

std::string_view name_of(InterpolationMethod method) {
  static constexpr std::string_view kNames[] = {"linear", "gradients", "bfs", "pml",
                                                "pmln",   "msgi-v",    "msgi"};
  return kNames[static_cast<size_t>(method)];
}

std::unique_ptr<Interpolation> make_interpolation(std::span<const uint32_t> triangles,
                                                  uint32_t vertex_count,
                                                  std::span<const std::span<const float>> inputs,
                                                  const InterpolationOptions& options) {
  if (inputs.size() < 2)
    throw Error(ErrorKind::kUsage, "it takes two meshes to interpolate");
  check_pins(options, vertex_count);
  auto made = make_plain(triangles, vertex_count, inputs, options);
  if (options.refinement_steps > 0)
    made = std::make_unique<Refined>(std::move(made), EdgeNetwork(triangles, vertex_count),
                                     all_points(inputs), options.refinement_steps);
  const bool places_parts = options.method == InterpolationMethod::kMsgi ||
                            options.method == InterpolationMethod::kVertexBlending ||
                            options.refinement_steps > 0;
  if (!places_parts || !options.pins.empty())
    return made;
  RestingParts parts(triangles, vertex_count, inputs);
  return parts.empty() ? std::move(made)
                       : std::make_unique<Anchored>(std::move(made), std::move(parts));
}

uint32_t choose_leaf_faces(std::span<const uint32_t> triangles, uint32_t vertex_count,
                           std::span<const std::span<const float>> inputs) {
  const EdgeNetwork network(triangles, vertex_count);
  const std::vector<EdgeShape> shapes = measure_edges(network, all_points(inputs));
  const std::vector<double> weights(inputs.size(), 1 / static_cast<double>(inputs.size()));
  const EdgeShape target = blend_edges(shapes, weights);
  std::vector<std::pair<uint32_t, double>> errors;
  double least = 0;
  for (uint32_t leaf = kMostLeafFaces; leaf > 0; leaf /= 2) {
    Msgi::Options options;
    options.leaf_faces = leaf;
    MultiScale msgi(triangles, vertex_count, inputs, options);
    const Points x = to_points(msgi.evaluate(weights, {}));
    const double error = edge_error(network, x, target, 0).length;
    least = errors.empty() ? error : std::min(least, error);
    errors.emplace_back(leaf, error);
  }
  return std::find_if(errors.begin(), errors.end(),
                      [&](const auto& e) { return e.second <= (1 + kWorthwhile) * least; })
      ->first;
}

}  // namespace anicodec
