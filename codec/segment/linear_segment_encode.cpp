// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_segment_encode.h"

#include "codec/algebra/blocked_product.h"
#include "codec/algebra/trajectory_gram.h"
#include "codec/segment/coefficient_encoder.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "format/time_weights.h"
#include "sdk/segment/affine_functions.h"
#include "sdk/segment/basis_layer.h"

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
  WeightCoder(size_t frames, const Vector<uint32_t>& runs, const LinearSettings& settings)
      : frames_(frames),
        lambda_(settings.weight_lambda),
        runs_(runs.empty() ? Vector<uint32_t>(1, static_cast<uint32_t>(frames)) : runs),
        model_(runs_) {
    for (size_t r = 0; r < settings.run_steps.size(); ++r)
      factors_.insert(factors_.end(), runs[r],
                      LinearParameters::sigma_value(settings.run_steps[r]));
    factors_.resize(frames, 1);
  }

  /// False if a weight is too large in its unit.
  bool code(uint32_t channels, double unit, Eigen::Ref<VectorXd> column) {
    std::vector<double> x(channels * frames_);
    Vector<int32_t> values(x.size());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c) {
        double value = column[static_cast<Index>(channels * f + c)] / (unit * factors_[f]);
        if (!(std::abs(value) < kWeightLimit / 2))
          return false;
        x[c * frames_ + f] = value;
      }
    }
    model_.encode(encoder_, channels, x.data(), lambda_, values.data());
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c)
        column[static_cast<Index>(channels * f + c)] =
            values[c * frames_ + f] * unit * factors_[f] / (1 << kWeightFractionBits);
    }
    return true;
  }

  /// The stream of what was coded since the one before.
  Bytes finish() {
    Bytes bytes = encoder_.finish();
    encoder_ = BinaryEncoder();
    return bytes;
  }

  void begin_anew() { model_ = TimeWeightModel(runs_); }

 private:
  size_t frames_;
  double lambda_;
  std::vector<double> factors_;  ///< of the unit, for each frame
  Vector<uint32_t> runs_;
  TimeWeightModel model_;
  BinaryEncoder encoder_;
};

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
  // The base's share of each component: per axis and function, or the pose times a sum.
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

/// A segment being coded.
class LinearEncoder {
 public:
  LinearEncoder(const FrameView& clip, const LinearBasis& basis, const LinearSettings& settings,
                const MeshLayout& layout, const Vector<uint32_t>& runs)
      : clip_(clip),
        basis_(basis),
        settings_(settings),
        layout_(layout),
        shapes_(basis.kind == BasisKind::kEigenshapes),
        count_(component_count(basis, settings, clip.vertex_count, clip.frame_count)) {
    parameters_.affine = basis.base == Base::kAffine;
    parameters_.basis_step = settings.step;
    parameters_.weight_step = settings.weight_factor * settings.step;
    parameters_.neighbours = settings.neighbours;
    parameters_.colours = settings.passes_per_level;
    parameters_.radius = settings.radius;
    parameters_.schedule = settings.schedule;
    parameters_.coder = settings.coder;
    parameters_.alike = settings.alike;
    parameters_.layers_anew = settings.layers_anew;
    parameters_.run_steps.assign(settings.run_steps.begin(), settings.run_steps.end());
    parameters_.omega.assign(count_, 128);
    encoded_.runs = runs;
    encoded_.sizes.kind = basis.kind;
    encoded_.sizes.frames = static_cast<uint32_t>(clip.frame_count);
    encoded_.sizes.components = static_cast<uint32_t>(count_);
  }

  std::optional<EncodedSegment> run(std::shared_ptr<const EncodedPose> shared) {
    set_pose(std::move(shared));
    set_base();
    set_sigma();
    set_layers();
    const MatrixXd base =
        parameters_.affine ? project_on_functions(clip_, origin_, functions_) : MatrixXd();
    if (!code_time(base, basis_.time.leftCols(static_cast<Index>(count_))))
      return std::nullopt;
    if (count_ > 0) {
      CoefficientEncoder coefficients(settings_, layout_, pose(),
                                      refitted(clip_, basis_, origin_, weights_, base_weights_,
                                               functions_, still_, settings_.step),
                                      shapes_ ? 3 : 1);
      if (!code_layers(coefficients))
        return std::nullopt;
      if (settings_.refit_weights)
        refit_time(coefficients.decoded(), base);
    }
    encoded_.parameters = parameters_.write();
    for (size_t l = 0; l < layers_.size(); ++l) {
      BasisLayer& layer = layers_[l];
      layer.weights = time_streams_[l];
      layer.slices[0] = coefficient_streams_[l];
      encoded_.coefficient_bytes += coefficient_streams_[l].size();
      encoded_.layers.push_back(layer.write(1));
    }
    return std::move(encoded_);
  }

 private:
  void set_pose(std::shared_ptr<const EncodedPose> shared) {
    const double step =
        settings_.pose_factor * settings_.step / std::sqrt(static_cast<double>(clip_.frame_count));
    encoded_.reference = shared ? std::move(shared)
                                : encode_reference_pose(basis_.pose, basis_.origin, step, layout_);
    origin_ = Eigen::Vector3d(encoded_.reference->grid.origin);
  }

  const Vector<int32_t>& pose() const { return encoded_.reference->grid.points; }

  /// The base that components are added to: an affine image of the pose in each frame, or the pose.
  void set_base() {
    if (parameters_.affine) {
      functions_ = function_values(pose());
      return;
    }
    still_.resize(static_cast<Index>(clip_.vertex_count), 3);
    for (Index i = 0; i < still_.size(); ++i)
      still_(i / 3, i % 3) = pose()[static_cast<size_t>(i)] * encoded_.reference->grid.step;
  }

  void set_sigma() {
    for (Index j = 0; j < static_cast<Index>(count_); ++j) {
      // Weights of a component of next to no energy would have no step.
      const double sigma = std::max(std::sqrt(basis_.energies[j]), 1e-6 * parameters_.weight_step);
      parameters_.sigma.push_back(LinearParameters::sigma_eighths(sigma));
    }
  }

  /// Codes the time weights of base and components, and keeps what a decoder gets. False if one is
  /// too large in its unit: then nothing has changed.
  bool code_time(MatrixXd base, MatrixXd components) {
    WeightCoder coder(clip_.frame_count, encoded_.runs, settings_);
    for (Index b = 0; b < base.cols(); ++b) {
      if (!coder.code(3, parameters_.weight_step, base.col(b)))
        return false;
    }
    Bytes of_base = coder.finish();
    std::vector<Bytes> streams;
    for (const BasisLayer& layer : layers_) {
      if (parameters_.layers_anew && layer.first > 0)
        coder.begin_anew();
      for (size_t j = layer.first; j < layer.first + layer.count; ++j) {
        const double unit =
            parameters_.weight_step / LinearParameters::sigma_value(parameters_.sigma[j]);
        if (!coder.code(shapes_ ? 1 : 3, unit, components.col(static_cast<Index>(j))))
          return false;
      }
      streams.push_back(coder.finish());
    }
    encoded_.weights = std::move(of_base);
    time_streams_ = std::move(streams);
    base_weights_ = std::move(base);
    weights_ = std::move(components);
    return true;
  }

  /// The coefficients are no longer those that the weights were made for: the weights that are best
  /// for what was coded. Nothing of the coefficients depends on them. `base`: the exact weights of
  /// the base.
  void refit_time(const Coefficients& decoded, const MatrixXd& base) {
    const auto k = static_cast<Index>(count_);
    if (shapes_) {
      const MatrixXd fields = fields_of(decoded);
      MatrixXd products = project_on_fields(clip_, origin_, fields);
      products -= products_of_base(fields);
      code_time(base, solved(fields, products));
      return;
    }
    // The base is fitted with the components: their functions are no longer at right angles.
    MatrixXd functions(static_cast<Index>(clip_.vertex_count), base.cols() + k);
    functions << functions_, decoded.cast<double>() * settings_.step;
    const MatrixXd all = solved(functions, project_on_functions(clip_, origin_, functions));
    code_time(all.leftCols(base.cols()), all.rightCols(k));
  }

  /// products (fields' gram)^-1, for products with as many columns as there are fields.
  static MatrixXd solved(const MatrixXd& fields, const MatrixXd& products) {
    MatrixXd gram = MatrixXd::Zero(fields.cols(), fields.cols());
    add_self_products(fields, gram);
    mirror_upper(gram);
    gram.diagonal().array() += 1e-12 * gram.trace();
    return gram.ldlt().solve(products.transpose()).transpose();
  }

  /// Decoded shapes in scene units, a column each: row 3v + c is coordinate c of vertex v.
  MatrixXd fields_of(const Coefficients& decoded) const {
    MatrixXd fields(3 * decoded.rows(), static_cast<Index>(count_));
    for (Index v = 0; v < decoded.rows(); ++v)
      for (Index j = 0; j < fields.cols(); ++j)
        for (Index c = 0; c < 3; ++c)
          fields(3 * v + c, j) = static_cast<double>(decoded(v, 3 * j + c)) * settings_.step;
    return fields;
  }

  /// The decoded base of every frame times the shapes: frames x components.
  MatrixXd products_of_base(const MatrixXd& fields) const {
    const auto frames = static_cast<Index>(clip_.frame_count);
    MatrixXd products = MatrixXd::Zero(frames, fields.cols());
    for (Index c = 0; c < 3; ++c) {
      const auto rows = Eigen::seqN(c, still_.rows() + functions_.rows(), 3);
      const MatrixXd of_axis = fields(rows, Eigen::all);
      if (!parameters_.affine) {
        products.rowwise() += (still_.col(c).transpose() * of_axis).row(0);
        continue;
      }
      const MatrixXd by_function = functions_.transpose() * of_axis;
      const MatrixXd of_frames = base_weights_(Eigen::seqN(c, frames, 3), Eigen::all);
      products += of_frames * by_function;
    }
    return products;
  }

  /// Early layers are short, as their components take most bytes: three quarters of the components are
  /// in the last one, three quarters of the others in the one before.
  void set_layers() {
    const auto count = static_cast<uint32_t>(count_);
    const uint32_t most = std::min(std::max(settings_.layers, 1U), count);
    uint32_t begin = 0;
    for (uint32_t l = 0; l < most && begin < count; ++l) {
      const uint32_t end = l + 1 == most ? count : std::max(begin + 1, count >> 2 * (most - 1 - l));
      BasisLayer& layer = layers_.emplace_back();
      layer.first = begin;
      layer.count = end - begin;
      begin = end;
    }
  }

  bool code_layers(CoefficientEncoder& coefficients) {
    for (const BasisLayer& layer : layers_) {
      for (size_t j = layer.first; j < layer.first + layer.count; ++j) {
        const std::optional<CoefficientEncoder::Component> coded = coefficients.code(j);
        if (!coded)
          return false;
        parameters_.omega[j] = coded->omega;
        if (coded->wide)
          encoded_.sizes.wide_components = static_cast<uint32_t>(j + 1);
      }
      coefficient_streams_.push_back(coefficients.finish_layer());
    }
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
  Eigen::Vector3d origin_;
  MatrixXd functions_, base_weights_;  ///< of an affine base: exact, and as decoded
  MatrixXd still_;                     ///< the pose as a base, vertices x 3
  MatrixXd weights_;                   ///< as decoded, a column per component
  std::vector<BasisLayer> layers_;     ///< their streams are below
  std::vector<Bytes> time_streams_, coefficient_streams_;
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
                                            std::shared_ptr<const EncodedPose> shared,
                                            const Vector<uint32_t>& runs) {
  return LinearEncoder(clip, basis, settings, layout, runs).run(std::move(shared));
}

}  // namespace anicodec
