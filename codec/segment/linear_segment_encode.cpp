// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_segment_encode.h"

#include "codec/algebra/trajectory_gram.h"
#include "codec/sequence/error.h"
#include "format/coefficient_coder.h"
#include "format/time_weights.h"
#include "sdk/mesh/plain_coding.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/prediction/encoder_predictor.h"
#include "sdk/segment/affine_functions.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFewestFractionBits = 4;  // with fewer, residency would add to the error
constexpr double kBitsPerUnit = 65536;  // of BitCounter

[[noreturn]] void too_fine() {
  throw TooFine();
}

/// Values of the affine functions of a pose: vertices x 4.
MatrixXd function_values(const Vector<int32_t>& pose) {
  AffineFunctions functions = AffineFunctions::of(pose.data(), pose.size() / 3);
  MatrixXd values(static_cast<Index>(pose.size() / 3), Index{kAffineFunctions});
  for (Index v = 0; v < values.rows(); ++v) {
    const int32_t* p = pose.data() + 3 * v;
    const double point[3] = {double(p[0]), double(p[1]), double(p[2])};
    double row[kAffineFunctions];
    functions.evaluate(point, row);
    for (size_t b = 0; b < kAffineFunctions; ++b)
      values(v, static_cast<Index>(b)) = row[b];
  }
  return values;
}

/// Codes the columns of `weights` as time components of `channels` channels (row channels * f + c)
/// in units of `unit`, each column by its own, and replaces them by what a decoder gets.
class WeightCoder {
 public:
  WeightCoder(size_t frames, double lambda)
      : frames_(frames), lambda_(lambda), model_(static_cast<uint32_t>(frames)) {}

  void code(uint32_t channels, double unit, Eigen::Ref<VectorXd> column) {
    std::vector<double> x(channels * frames_);
    Vector<int32_t> values(x.size());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c) {
        double value = column[static_cast<Index>(channels * f + c)] / unit;
        if (!(std::abs(value) < kWeightLimit / 2))
          too_fine();
        x[c * frames_ + f] = value;
      }
    }
    model_.encode(encoder_, channels, x.data(), lambda_, values.data());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c)
        column[static_cast<Index>(channels * f + c)] =
            values[c * frames_ + f] * unit / (1 << kWeightFractionBits);
    }
  }

  Bytes finish() { return encoder_.finish(); }

 private:
  size_t frames_;
  double lambda_;
  TimeWeightModel model_;
  BinaryEncoder encoder_;
};

/// Coefficients in steps, a row per vertex: channels of component 0, of component 1, ...
using Coefficients = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The basis that goes best with the decoded weights `u` (a column per component), base taken out.
Coefficients refitted(const FrameView& clip, const LinearBasis& basis,
                      const Eigen::Vector3d& origin, const MatrixXd& u,
                      const MatrixXd& base_weights, const MatrixXd& base_functions,
                      const MatrixXd& pose, double step) {
  Index k = u.cols();
  MatrixXd normal = u.transpose() * u;
  normal.diagonal().array() += 1e-9 * std::max(normal.trace() / static_cast<double>(k), 1e-30);
  MatrixXd solved = normal.ldlt().solve(u.transpose()).transpose();  // rows of the clip x k
  bool shapes = basis.kind == BasisKind::kEigenshapes;
  Index channels = shapes ? 3 : 1;
  Coefficients y(static_cast<Index>(clip.vertex_count), k * channels);
  // What the base contributes to each component: per axis and function, or the pose times a sum.
  MatrixXd base(Index{kAffineFunctions}, k * channels);
  if (basis.base == Base::kAffine) {
    for (Index j = 0; j < k; ++j) {
      for (Index c = 0; c < channels; ++c) {
        VectorXd sum = VectorXd::Zero(Index{kAffineFunctions});
        for (Index r = 0; r < solved.rows(); ++r)
          sum += solved(r, j) * base_weights.row(shapes ? 3 * r + c : r).transpose();
        base.col(j * channels + c) = sum;
      }
    }
  }
  VectorXd sums = solved.colwise().sum().transpose();
  combine_rows(clip, origin, solved, [&](size_t first, const MatrixXd& block) {
    for (Index i = 0; i < block.rows(); ++i) {
      Index v = static_cast<Index>(first) + i / channels, c = i % channels;
      for (Index j = 0; j < k; ++j) {
        double value = block(i, j);
        value -= basis.base == Base::kAffine ? base_functions.row(v).dot(base.col(j * channels + c))
                                             : pose(v, c) * sums[j];
        y(v, j * channels + c) = static_cast<float>(value / step);
      }
    }
  });
  return y;
}

/// Rounds a residual with the cost of its candidates in mind.
int32_t rounded(CoefficientModel& model, uint32_t v, uint32_t c, double residual, double lambda) {
  double magnitude = std::abs(residual);
  if (magnitude >= kCoefficientLimit - 1)
    too_fine();
  auto q = static_cast<int32_t>(magnitude + 0.5);
  if (q == 0 || lambda <= 0 || q > 200)
    return residual < 0 ? -q : q;
  int32_t best = 0, sign = residual < 0 ? -1 : 1;
  double least = 0;
  for (int32_t candidate = q; candidate >= (q <= 2 ? 0 : q - 1); --candidate) {
    double d = magnitude - candidate;
    double cost =
        d * d + lambda * static_cast<double>(model.cost(v, c, sign * candidate)) / kBitsPerUnit;
    if (candidate == q || cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return sign * best;
}

}  // namespace

size_t component_count(const LinearBasis& basis, const LinearSettings& settings, size_t vertices,
                       size_t frames) {
  if (settings.components > 0)
    return std::min(settings.components, static_cast<size_t>(basis.energies.size()));
  bool shapes = basis.kind == BasisKind::kEigenshapes;
  double scalars = static_cast<double>(shapes ? 3 * vertices + frames : vertices + 3 * frames);
  double smallest = settings.rank_factor * scalars * settings.step * settings.step;
  return static_cast<size_t>((basis.energies.array() > smallest).count());
}

std::shared_ptr<const EncodedPose> encode_reference_pose(const MatrixXd& pose,
                                                         const Eigen::Vector3d& origin, double step,
                                                         bool slow, const MeshLayout& layout) {
  auto encoded = std::make_shared<EncodedPose>();
  PoseGrid& grid = encoded->grid;
  double largest = pose.size() > 0 ? pose.cwiseAbs().maxCoeff() : 0;
  grid.step = std::max({step, largest / (kMaxReferenceCoordinate - 1), 1e-37});
  std::copy_n(origin.data(), 3, grid.origin);
  grid.points.reserve(static_cast<size_t>(pose.size()));
  for (Index v = 0; v < pose.rows(); ++v) {
    for (Index c = 0; c < 3; ++c)
      grid.points.push_back(static_cast<int32_t>(std::lround(pose(v, c) / grid.step)));
  }
  encoded->coder = layout.coder;
  size_t held = layout.coder == CoderId::kDraco ? vertices_in_triangles(layout.topology) : 0;
  encoded->stream = encode_plain_integers(
      {grid.points.begin() + static_cast<ptrdiff_t>(3 * held), grid.points.end()}, 3);
  if (!slow)
    return encoded;
  size_t bytes = encoded->stream.size();
  if (encoded->coder == CoderId::kDraco)
    bytes += encode_with_poses(layout, {&grid.points, 1}).size() - layout.connectivity.size();
  Bytes predicted = encode_pose(layout.topology, grid.points);
  if (predicted.size() < bytes) {
    encoded->coder = CoderId::kPredictive;
    encoded->stream = std::move(predicted);
  }
  return encoded;
}

EncodedSegment encode_linear(const FrameView& clip, const LinearBasis& basis,
                             const LinearSettings& settings, const MeshLayout& layout,
                             std::shared_ptr<const EncodedPose> shared) {
  size_t n = clip.vertex_count, frames = clip.frame_count;
  bool shapes = basis.kind == BasisKind::kEigenshapes;
  uint32_t channels = shapes ? 3 : 1, weight_channels = shapes ? 1 : 3;
  size_t k = component_count(basis, settings, n, frames);

  LinearParameters parameters;
  parameters.affine = basis.base == Base::kAffine;
  parameters.basis_step = settings.step;
  parameters.weight_step = settings.weight_factor * settings.step;
  parameters.neighbours = settings.neighbours;
  parameters.colours = settings.passes_per_level;
  parameters.radius = settings.radius;
  parameters.schedule = settings.schedule;

  EncodedSegment encoded;
  encoded.sizes.kind = basis.kind;
  encoded.sizes.frames = static_cast<uint32_t>(frames);
  encoded.sizes.components = static_cast<uint32_t>(k);
  double pose_step = settings.pose_factor * settings.step / std::sqrt(static_cast<double>(frames));
  encoded.reference = shared ? std::move(shared)
                             : encode_reference_pose(basis.pose, basis.origin, pose_step,
                                                     settings.slow_pose, layout);
  const Vector<int32_t>& pose = encoded.reference->grid.points;
  const Eigen::Vector3d origin(encoded.reference->grid.origin);

  WeightCoder weight_coder(frames, settings.weight_lambda);
  MatrixXd functions, base_weights, still(static_cast<Index>(n), 3);
  if (parameters.affine) {
    functions = function_values(pose);
    base_weights = project_on_functions(clip, origin, functions);
    for (Index b = 0; b < base_weights.cols(); ++b)
      weight_coder.code(3, parameters.weight_step, base_weights.col(b));
  } else {
    for (Index i = 0; i < still.size(); ++i)
      still(i / 3, i % 3) = pose[static_cast<size_t>(i)] * encoded.reference->grid.step;
  }
  MatrixXd u = basis.time.leftCols(static_cast<Index>(k));
  for (size_t j = 0; j < k; ++j) {
    auto column = static_cast<Index>(j);
    // Weights of a component of next to no energy would have no step.
    double sigma = std::max(std::sqrt(basis.energies[column]), 1e-6 * parameters.weight_step);
    int32_t eighths = LinearParameters::sigma_eighths(sigma);
    parameters.sigma.push_back(eighths);
    weight_coder.code(weight_channels,
                      parameters.weight_step / LinearParameters::sigma_value(eighths),
                      u.col(column));
  }
  encoded.weights = weight_coder.finish();
  parameters.omega.assign(k, 128);
  if (k == 0) {
    encoded.parameters = parameters.write();
    return encoded;
  }

  Coefficients target =
      refitted(clip, basis, origin, u, base_weights, functions, still, settings.step);
  VertexOrder order;
  if (make_vertex_order(layout.topology.triangles.data(), layout.topology.triangles.size() / 3,
                        pose.data(), n, settings.neighbours, settings.passes_per_level,
                        &order) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the vertex order cannot be made");
  PredictionParameters prediction;
  prediction.channels = static_cast<int>(channels);
  prediction.radius = settings.radius;
  prediction.schedule = settings.schedule;
  EncoderPredictor predictor;
  if (predictor.init(order, pose.data(), prediction, k) != Status::kOk)
    throw Error(ErrorKind::kInternal, "the predictor refuses its parameters");
  CoefficientModel model(static_cast<uint32_t>(n), channels, order.neighbours.data(),
                         static_cast<uint32_t>(order.neighbour_count));

  uint32_t layers = std::clamp<uint32_t>(settings.layers, 1, static_cast<uint32_t>(k));
  size_t begin = 0;
  for (uint32_t layer = 0; layer < layers; ++layer) {
    // Early layers are short: half of the components in the last one, a quarter in the one before.
    size_t end = layer + 1 == layers ? k : std::max(begin + 1, k >> (layers - 1 - layer));
    end = std::min(end, k);
    BinaryEncoder encoder;
    for (size_t j = begin; j < end; ++j) {
      model.begin_component();
      double energy = 0, largest = 0;
      for (uint32_t i = 0; i < n; ++i) {
        Index v = order.order[i];
        for (uint32_t c = 0; c < channels; ++c) {
          float p = predictor.predict(i, static_cast<int>(c));
          double residual = static_cast<double>(target(v, static_cast<Index>(j * channels + c))) -
                            static_cast<double>(p);
          int32_t q = rounded(model, i, c, residual, settings.lambda);
          model.code(encoder, i, c, q);
          float y = predictor.commit(i, static_cast<int>(c), p, q);
          energy += static_cast<double>(q) * q;
          largest = std::max(largest, std::abs(static_cast<double>(y)));
        }
      }
      model.end_component();
      if (largest * (1 << kFewestFractionBits) > INT16_MAX)
        encoded.sizes.wide_components = static_cast<uint32_t>(j + 1);
      parameters.omega[j] = omega_byte(energy / (static_cast<double>(n) * channels));
      tbb::parallel_for(size_t{0}, predictor.block_count(),
                        [&](size_t b) { predictor.update(b, b + 1, parameters.omega[j]); });
      predictor.next_component();
    }
    ByteWriter writer;
    writer.varint(end - begin);
    writer.raw(encoder.finish());
    encoded.layers.push_back(std::move(writer.bytes()));
    begin = end;
  }
  encoded.parameters = parameters.write();
  return encoded;
}

}  // namespace anicodec
