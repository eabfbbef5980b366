// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_segment_encode.h"

#include "codec/algebra/trajectory_gram.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "format/coefficient_coder.h"
#include "format/time_weights.h"
#include "sdk/prediction/encoder_predictor.h"
#include "sdk/segment/affine_functions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFewestFractionBits = 4;  // with fewer, residency would add to the error
constexpr double kBitsPerUnit = 65536;  // of BitCounter

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

  /// False if a weight is too large in its unit.
  bool code(uint32_t channels, double unit, Eigen::Ref<VectorXd> column) {
    std::vector<double> x(channels * frames_);
    Vector<int32_t> values(x.size());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c) {
        double value = column[static_cast<Index>(channels * f + c)] / unit;
        if (!(std::abs(value) < kWeightLimit / 2))
          return false;
        x[c * frames_ + f] = value;
      }
    }
    model_.encode(encoder_, channels, x.data(), lambda_, values.data());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c)
        column[static_cast<Index>(channels * f + c)] =
            values[c * frames_ + f] * unit / (1 << kWeightFractionBits);
    }
    return true;
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

/// Rounds a residual with the cost of its candidates in mind. @pre |residual| < kCoefficientLimit - 1
int32_t rounded(CoefficientModel& model, uint32_t v, uint32_t c, double residual, double lambda) {
  double magnitude = std::abs(residual);
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

/// Predicts, rounds and codes the coefficients of a basis, component by component.
class CoefficientEncoder {
 public:
  CoefficientEncoder(const LinearSettings& settings, const MeshLayout& layout,
                     const Vector<int32_t>& pose, Coefficients target, uint32_t channels)
      : lambda_(settings.lambda),
        target_(std::move(target)),
        channels_(channels),
        order_(order_of(settings, layout, pose)),
        model_(static_cast<uint32_t>(target_.rows()), channels, order_.neighbours.data(),
               static_cast<uint32_t>(order_.neighbour_count)) {
    PredictionParameters prediction;
    prediction.channels = static_cast<int>(channels);
    prediction.radius = settings.radius;
    prediction.schedule = settings.schedule;
    if (predictor_.init(order_, pose.data(), prediction,
                        static_cast<size_t>(target_.cols()) / channels) != Status::kOk)
      throw Error(ErrorKind::kInternal, "the predictor refuses its parameters");
  }

  struct Component {
    uint8_t omega = 0;  ///< for the next component
    bool wide = false;  ///< whether 16 bits do not hold it in memory
  };

  /// Codes component j, after all those before it. Nothing if a coefficient is too large.
  std::optional<Component> code(size_t j, BinaryEncoder& encoder) {
    model_.begin_component();
    double energy = 0, largest = 0;
    for (uint32_t i = 0; i < target_.rows(); ++i) {
      Index v = order_.order[i];
      for (uint32_t c = 0; c < channels_; ++c) {
        float p = predictor_.predict(i, static_cast<int>(c));
        double residual = static_cast<double>(target_(v, static_cast<Index>(j * channels_ + c))) -
                          static_cast<double>(p);
        if (std::abs(residual) >= kCoefficientLimit - 1)
          return std::nullopt;
        int32_t q = rounded(model_, i, c, residual, lambda_);
        model_.code(encoder, i, c, q);
        float y = predictor_.commit(i, static_cast<int>(c), p, q);
        energy += static_cast<double>(q) * q;
        largest = std::max(largest, std::abs(static_cast<double>(y)));
      }
    }
    model_.end_component();
    Component component;
    component.wide = largest * (1 << kFewestFractionBits) > INT16_MAX;
    component.omega = omega_byte(energy / (static_cast<double>(target_.rows()) * channels_));
    tbb::parallel_for(size_t{0}, predictor_.block_count(),
                      [&](size_t b) { predictor_.update(b, b + 1, component.omega); });
    predictor_.next_component();
    return component;
  }

 private:
  static VertexOrder order_of(const LinearSettings& settings, const MeshLayout& layout,
                              const Vector<int32_t>& pose) {
    VertexOrder order;
    const Vector<uint32_t>& triangles = layout.topology.triangles;
    if (make_vertex_order(triangles.data(), triangles.size() / 3, pose.data(), pose.size() / 3,
                          settings.neighbours, settings.passes_per_level, &order) != Status::kOk)
      throw Error(ErrorKind::kInternal, "the vertex order cannot be made");
    return order;
  }

  double lambda_;
  Coefficients target_;
  uint32_t channels_;
  VertexOrder order_;
  CoefficientModel model_;
  EncoderPredictor predictor_;
};

/// A segment being coded.
class LinearEncoder {
 public:
  LinearEncoder(const FrameView& clip, const LinearBasis& basis, const LinearSettings& settings,
                const MeshLayout& layout)
      : clip_(clip),
        basis_(basis),
        settings_(settings),
        layout_(layout),
        shapes_(basis.kind == BasisKind::kEigenshapes),
        count_(component_count(basis, settings, clip.vertex_count, clip.frame_count)),
        weight_coder_(clip.frame_count, settings.weight_lambda) {
    parameters_.affine = basis.base == Base::kAffine;
    parameters_.basis_step = settings.step;
    parameters_.weight_step = settings.weight_factor * settings.step;
    parameters_.neighbours = settings.neighbours;
    parameters_.colours = settings.passes_per_level;
    parameters_.radius = settings.radius;
    parameters_.schedule = settings.schedule;
    parameters_.omega.assign(count_, 128);
    encoded_.sizes.kind = basis.kind;
    encoded_.sizes.frames = static_cast<uint32_t>(clip.frame_count);
    encoded_.sizes.components = static_cast<uint32_t>(count_);
  }

  std::optional<EncodedSegment> run(std::shared_ptr<const EncodedPose> shared) {
    set_pose(std::move(shared));
    if (!code_base() || !code_weights() || (count_ > 0 && !code_layers()))
      return std::nullopt;
    encoded_.parameters = parameters_.write();
    return std::move(encoded_);
  }

 private:
  void set_pose(std::shared_ptr<const EncodedPose> shared) {
    const double step = settings_.pose_factor * settings_.step /
                        std::sqrt(static_cast<double>(clip_.frame_count));
    encoded_.reference =
        shared ? std::move(shared)
               : encode_reference_pose(basis_.pose, basis_.origin, step, layout_);
    origin_ = Eigen::Vector3d(encoded_.reference->grid.origin);
  }

  const Vector<int32_t>& pose() const { return encoded_.reference->grid.points; }

  /// What the components are added to: an affine image of the pose in each frame, or the pose.
  bool code_base() {
    if (!parameters_.affine) {
      still_.resize(static_cast<Index>(clip_.vertex_count), 3);
      for (Index i = 0; i < still_.size(); ++i)
        still_(i / 3, i % 3) = pose()[static_cast<size_t>(i)] * encoded_.reference->grid.step;
      return true;
    }
    functions_ = function_values(pose());
    base_weights_ = project_on_functions(clip_, origin_, functions_);
    for (Index b = 0; b < base_weights_.cols(); ++b) {
      if (!weight_coder_.code(3, parameters_.weight_step, base_weights_.col(b)))
        return false;
    }
    return true;
  }

  bool code_weights() {
    const uint32_t channels = shapes_ ? 1 : 3;
    weights_ = basis_.time.leftCols(static_cast<Index>(count_));
    for (Index j = 0; j < weights_.cols(); ++j) {
      // Weights of a component of next to no energy would have no step.
      double sigma = std::max(std::sqrt(basis_.energies[j]), 1e-6 * parameters_.weight_step);
      int32_t eighths = LinearParameters::sigma_eighths(sigma);
      parameters_.sigma.push_back(eighths);
      const double unit = parameters_.weight_step / LinearParameters::sigma_value(eighths);
      if (!weight_coder_.code(channels, unit, weights_.col(j)))
        return false;
    }
    encoded_.weights = weight_coder_.finish();
    return true;
  }

  bool code_layers() {
    CoefficientEncoder coefficients(settings_, layout_, pose(),
                                    refitted(clip_, basis_, origin_, weights_, base_weights_,
                                             functions_, still_, settings_.step),
                                    shapes_ ? 3 : 1);
    uint32_t layers = std::clamp<uint32_t>(settings_.layers, 1, static_cast<uint32_t>(count_));
    size_t begin = 0;
    for (uint32_t layer = 0; layer < layers; ++layer) {
      // Early layers are short: half of the components in the last one, a quarter in the one
      // before.
      size_t end =
          layer + 1 == layers ? count_ : std::max(begin + 1, count_ >> (layers - 1 - layer));
      end = std::min(end, count_);
      if (!code_layer(begin, end, coefficients))
        return false;
      begin = end;
    }
    return true;
  }

  bool code_layer(size_t begin, size_t end, CoefficientEncoder& coefficients) {
    BinaryEncoder encoder;
    for (size_t j = begin; j < end; ++j) {
      const std::optional<CoefficientEncoder::Component> coded = coefficients.code(j, encoder);
      if (!coded)
        return false;
      parameters_.omega[j] = coded->omega;
      if (coded->wide)
        encoded_.sizes.wide_components = static_cast<uint32_t>(j + 1);
    }
    ByteWriter writer;
    writer.varint(end - begin);
    writer.raw(encoder.finish());
    encoded_.layers.push_back(std::move(writer.bytes()));
    return true;
  }

  const FrameView& clip_;
  const LinearBasis& basis_;
  const LinearSettings& settings_;
  const MeshLayout& layout_;
  bool shapes_;
  size_t count_;  ///< of components
  LinearParameters parameters_;
  EncodedSegment encoded_;
  WeightCoder weight_coder_;
  Eigen::Vector3d origin_;
  MatrixXd functions_, base_weights_;  ///< of an affine base
  MatrixXd still_;                     ///< the pose as a base, vertices x 3
  MatrixXd weights_;                   ///< as decoded, a column per component
};

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

std::optional<EncodedSegment> encode_linear(const FrameView& clip, const LinearBasis& basis,
                                            const LinearSettings& settings,
                                            const MeshLayout& layout,
                                            std::shared_ptr<const EncodedPose> shared) {
  return LinearEncoder(clip, basis, settings, layout).run(std::move(shared));
}

}  // namespace anicodec
