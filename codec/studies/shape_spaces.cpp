// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/studies/shape_spaces.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/rigid_motion.h"
#include "codec/connectivity/weld.h"
#include "codec/interpolation/deformation_gradients.h"
#include "codec/interpolation/interpolation.h"
#include "codec/sequence/error.h"
#include "codec/surface/closest_point.h"
#include "codec/surface/edge_network.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Vertices x frames that a clip may have before frames are left out.
constexpr size_t kMostPositions = 1'600'000;

/// Frames that errors are measured on.
constexpr size_t kMeasured = 16;

constexpr uint32_t kStudyLeafFaces = 8;

/// The frames as a space reproduces them.
struct ShapeSpace {
  const char* name;
  uint64_t numbers = 0;  ///< of one shape
  MatrixXd gram;         ///< products of all frames about their mean
  /// The mesh at weights over the frames that sum to one.
  std::function<Points(std::span<const double>)> rebuild;
};

/// The frames of a clip that are looked at, welded and turned into one orientation.
struct AlignedFrames {
  explicit AlignedFrames(const MeshSequence& clip) {
    const Weld weld = weld_trajectories(clip);
    vertex_count = static_cast<uint32_t>(weld.representative.size());
    for (uint32_t corner : fan_triangles(clip.polygons))
      triangles.push_back(weld.welded[corner]);
    const size_t most = std::clamp<size_t>(kMostPositions / vertex_count, 2, clip.frame_count);
    std::vector<float> welded;
    for (size_t i = 0; i < most; ++i) {
      const std::span<const float> frame = clip.frame(i * clip.frame_count / most);
      for (uint32_t v : weld.representative)
        welded.insert(welded.end(), &frame[3 * size_t{v}], &frame[3 * size_t{v}] + 3);
    }
    const FrameView view(welded.data(), most, vertex_count);
    const Centroids centroids = frame_centroids(view);
    const std::vector<Eigen::Matrix3d> rotations = align_frames(view, centroids);
    for (size_t f = 0; f < most; ++f) {
      const Eigen::Vector3d centroid = centroids.row(static_cast<Index>(f)).transpose();
      const std::span<const float> x(view.frame(f), 3 * size_t{vertex_count});
      points.push_back(rotations[f].transpose() * (to_points(x).colwise() - centroid));
      positions.emplace_back(x.size());
      Eigen::Map<Eigen::Matrix3Xf>(positions.back().data(), 3, points.back().cols()) =
          points.back().cast<float>();
      inputs.emplace_back(positions.back());
    }
  }

  AlignedFrames(const AlignedFrames&) = delete;
  AlignedFrames& operator=(const AlignedFrames&) = delete;

  size_t count() const { return points.size(); }

  uint32_t vertex_count = 0;
  std::vector<uint32_t> triangles;
  std::vector<Points> points;
  std::vector<std::vector<float>> positions;
  std::vector<std::span<const float>> inputs;
};

/// Products of features, a column per frame, about their mean.
MatrixXd products(MatrixXd features) {
  const VectorXd mean = features.rowwise().mean();
  features.colwise() -= mean;
  return features.transpose() * features;
}

std::function<Points(std::span<const double>)> rebuild_by(
    std::shared_ptr<Interpolation> interpolation) {
  return [interpolation = std::move(interpolation)](std::span<const double> weights) {
    return to_points(interpolation->evaluate(weights));
  };
}

std::shared_ptr<Interpolation> interpolation_of(const AlignedFrames& frames,
                                                InterpolationMethod method) {
  InterpolationOptions options;
  options.method = method;
  options.leaf_faces = kStudyLeafFaces;
  return make_interpolation(frames.triangles, frames.vertex_count, frames.inputs, options);
}

ShapeSpace vertex_space(const AlignedFrames& frames) {
  MatrixXd features(3 * static_cast<Index>(frames.vertex_count),
                    static_cast<Index>(frames.count()));
  for (size_t f = 0; f < frames.count(); ++f)
    features.col(static_cast<Index>(f)) = frames.points[f].reshaped();
  const auto numbers = static_cast<uint64_t>(features.rows());
  return {"vertices", numbers, products(std::move(features)),
          rebuild_by(interpolation_of(frames, InterpolationMethod::kLinear))};
}

std::optional<ShapeSpace> edge_space(const AlignedFrames& frames) {
  std::shared_ptr<Interpolation> interpolation;
  try {
    interpolation = interpolation_of(frames, InterpolationMethod::kMsgi);
  } catch (const Error&) {
    return std::nullopt;
  }
  const EdgeNetwork network(frames.triangles, frames.vertex_count);
  const std::vector<EdgeShape> shapes = measure_edges(network, frames.points);
  const Index edges = shapes[0].lengths.size(), hinges = shapes[0].angles.size();
  VectorXd mean = VectorXd::Zero(edges);
  for (const EdgeShape& shape : shapes)
    mean += shape.lengths / static_cast<double>(shapes.size());
  MatrixXd features(edges + hinges, static_cast<Index>(shapes.size()));
  for (size_t f = 0; f < shapes.size(); ++f) {
    auto column = features.col(static_cast<Index>(f));
    column.head(edges) = shapes[f].lengths;
    for (Index h = 0; h < hinges; ++h)
      column[edges + h] = mean[network.hinges[static_cast<size_t>(h)].edge] * shapes[f].angles[h];
  }
  return ShapeSpace{"edges", static_cast<uint64_t>(edges + hinges), products(std::move(features)),
                    rebuild_by(std::move(interpolation))};
}

std::optional<ShapeSpace> gradient_space(const AlignedFrames& frames) {
  const EdgeNetwork network(frames.triangles, frames.vertex_count);
  std::shared_ptr<GradientInterpolation> interpolation;
  try {
    interpolation = std::make_shared<GradientInterpolation>(network, frames.points,
                                                            RotationTracking::kPrioritized);
  } catch (const Error&) {
    return std::nullopt;
  }
  const std::vector<double>& areas = interpolation->areas();
  // Three numbers of the rotation and nine of the stretch; six of those tell the rest.
  constexpr Index kNumbers = 12;
  MatrixXd features(kNumbers * static_cast<Index>(areas.size()),
                    static_cast<Index>(frames.count()));
  for (size_t f = 0; f < frames.count(); ++f) {
    const DeformationGradients::Gradients& g = interpolation->measured(f);
    for (size_t t = 0; t < areas.size(); ++t) {
      auto features_of_triangle =
          features.col(static_cast<Index>(f)).segment<kNumbers>(kNumbers * static_cast<Index>(t));
      features_of_triangle << g.turns[t], g.stretches[t].reshaped();
      features_of_triangle *= std::sqrt(areas[t]);
    }
  }
  return ShapeSpace{"gradients", uint64_t{9} * areas.size(), products(std::move(features)),
                    [interpolation](std::span<const double> weights) {
                      return interpolation->evaluate(weights);
                    }};
}

/// Squared distance of a mesh from a frame, moved onto it.
double squared_error(const Points& x, const Points& frame) {
  const Eigen::Vector3d from = x.rowwise().mean(), to = frame.rowwise().mean();
  const Points centred = x.colwise() - from, wanted = frame.colwise() - to;
  const Eigen::Matrix3d rotation = best_rotation(wanted * centred.transpose());
  return (wanted - rotation * centred).squaredNorm();
}

void add_errors(const ShapeSpace& space, const AlignedFrames& frames,
                std::span<const size_t> counts, size_t all_frames,
                std::vector<ShapeSpaceError>& rows) {
  const size_t count = frames.count(), measured = std::min(count, kMeasured);
  // The mean is in the kernel of the products.
  const Eigenpairs pairs = leading_eigenpairs(space.gram, space.gram.rows(), 0, space.gram.rows());
  const double variance = pairs.values.sum();
  double reference = 0;
  for (size_t i = 0; i < measured; ++i)
    reference += frames.points[i * count / measured].squaredNorm();
  for (size_t k : counts) {
    if (k < 1 || k >= count)
      continue;
    const Index kept = std::min(static_cast<Index>(k), pairs.values.size());
    const auto leading = pairs.vectors.leftCols(kept);
    double squared = 0;
    for (size_t i = 0; i < measured; ++i) {
      const size_t f = i * count / measured;
      VectorXd weights = leading * leading.row(static_cast<Index>(f)).transpose();
      weights.array() += (1 - weights.sum()) / static_cast<double>(count);
      squared += squared_error(space.rebuild({weights.data(), count}), frames.points[f]);
    }
    ShapeSpaceError row;
    row.space = space.name;
    row.k = k;
    row.kg = kg_error(squared, reference);
    row.numbers = space.numbers;
    row.bytes = 4 * ((k + 1) * space.numbers + k * all_frames);
    row.residual_percent =
        variance > 0 ? 100 * pairs.values.tail(pairs.values.size() - kept).sum() / variance : 0;
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::vector<ShapeSpaceError> shape_space_errors(const MeshSequence& clip,
                                                std::span<const size_t> counts) {
  std::vector<ShapeSpaceError> rows;
  if (clip.frame_count < 2)
    return rows;
  const AlignedFrames frames(clip);
  // One after the other: each holds several numbers for every vertex and frame.
  add_errors(vertex_space(frames), frames, counts, clip.frame_count, rows);
  if (frames.triangles.empty())
    return rows;
  if (const std::optional<ShapeSpace> edges = edge_space(frames))
    add_errors(*edges, frames, counts, clip.frame_count, rows);
  if (const std::optional<ShapeSpace> gradients = gradient_space(frames))
    add_errors(*gradients, frames, counts, clip.frame_count, rows);
  return rows;
}

}  // namespace anicodec
