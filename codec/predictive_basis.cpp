// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/predictive_basis.h"

#include "codec/error.h"
#include "codec/trajectory_gram.h"
#include "format/bit_cost.h"
#include "format/coefficient_coder.h"
#include "format/time_weights.h"
#include "sdk/affine_functions.h"
#include "sdk/encoder_predictor.h"
#include "sdk/vertex_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kWeightFraction = 1.0 / (1 << kWeightFractionBits);
constexpr double kLargestWeight = kWeightLimit / 2;
constexpr double kLargestCoefficient = 1 << 19;

[[noreturn]] void too_fine(const char* what) {
  throw Error(ErrorKind::kInput,
              std::string("the error asked for is too small for this clip: ") + what);
}

class SegmentEncoder {
 public:
  SegmentEncoder(const LinearAnalysis& analysis, const LinearBasis& basis,
                 const PredictiveOptions& options)
      : clip_(analysis.clip()), linear_(basis), options_(options) {
    out_.kind = basis.kind;
    out_.base = basis.base;
    out_.frames = static_cast<uint32_t>(clip_.frame_count);
    out_.vertices = static_cast<uint32_t>(clip_.vertex_count);
    out_.prediction.channels = basis.kind == format::BasisKind::kEigenshapes ? 3 : 1;
    out_.prediction.radius = options.radius;
    out_.prediction.schedule = options.schedule;
    out_.neighbours = options.neighbours;
    out_.colours = options.colours;
    out_.step = options.step;
    for (Index c = 0; c < 3; ++c)
      out_.origin[c] = basis.origin[c];
    out_.components = static_cast<uint32_t>(
        component_count(basis, clip_.vertex_count, clip_.frame_count, options));
  }

  PredictiveBasis run(std::span<const uint32_t> triangles);

 private:
  void quantise_pose();
  void encode_weights();
  void encode_base_weights(TimeWeightModel& model, BinaryEncoder& encoder);
  double base_squared_error() const;
  void fit_coefficients(const VertexOrder& order);
  void encode_coefficients(const VertexOrder& order);
  int32_t quantise(CoefficientModel& model, uint32_t rank, uint32_t channel, double residual) const;
  void add_quantisation_error();

  size_t channels() const { return out_.channels(); }

  FrameView clip_;
  const LinearBasis& linear_;
  const PredictiveOptions& options_;
  PredictiveBasis out_;
  MatrixXd base_time_;         // 3 frames x 4: decoded weights of the affine functions
  MatrixXd time_;              // rows of linear_.time x components: decoded time weights
  MatrixXd products_;          // time_' time_
  std::vector<float> target_;  // as out_.coefficients: what they should be
};

void SegmentEncoder::quantise_pose() {
  const MatrixXd& pose = linear_.pose;
  const Vector3d low = pose.colwise().minCoeff().transpose();
  const Vector3d high = pose.colwise().maxCoeff().transpose();
  const Vector3d middle = (low + high) / 2;
  const double range = (high - low).maxCoeff();
  // A pose below the resolution of the integers has no further use.
  const double step =
      std::max({options_.pose_step * options_.step / std::sqrt(static_cast<double>(out_.frames)),
                range / (2 * (kMaxReferenceCoordinate - 1)), 1e-300});
  out_.pose_step = step;
  out_.pose.resize(clip_.vertex_count * 3);
  for (Index c = 0; c < 3; ++c)
    out_.pose_origin[c] = middle[c];
  for (Index v = 0; v < pose.rows(); ++v)
    for (Index c = 0; c < 3; ++c)
      out_.pose[static_cast<size_t>(3 * v + c)] =
          static_cast<int32_t>(std::lround((pose(v, c) - middle[c]) / step));
}

void SegmentEncoder::encode_base_weights(TimeWeightModel& model, BinaryEncoder& encoder) {
  const AffineFunctions functions = AffineFunctions::of(out_.pose.data(), clip_.vertex_count);
  MatrixXd values(static_cast<Index>(clip_.vertex_count), Index{kAffineFunctions});
  for (Index v = 0; v < values.rows(); ++v) {
    const int32_t* p = out_.pose.data() + 3 * v;
    const double at[] = {double(p[0]), double(p[1]), double(p[2])};
    double b[kAffineFunctions];
    functions.evaluate(at, b);
    for (Index j = 0; j < values.cols(); ++j)
      values(v, j) = b[j];
  }
  const MatrixXd fitted = project_on_functions(clip_, linear_.origin, values);
  out_.base_weight_step =
      std::max(options_.weight_step * options_.step, fitted.cwiseAbs().maxCoeff() / kLargestWeight);
  const size_t frames = out_.frames;
  base_time_.resize(fitted.rows(), fitted.cols());
  out_.base_weights.resize(kAffineFunctions * 3 * frames);
  std::vector<double> x(3 * frames);
  for (size_t j = 0; j < kAffineFunctions; ++j) {
    const auto column = static_cast<Index>(j);
    for (size_t c = 0; c < 3; ++c)
      for (size_t f = 0; f < frames; ++f)
        x[c * frames + f] = fitted(static_cast<Index>(3 * f + c), column) / out_.base_weight_step;
    int32_t* decoded = out_.base_weights.data() + j * 3 * frames;
    model.encode(encoder, 3, x.data(), options_.weight_lambda, decoded);
    for (size_t c = 0; c < 3; ++c)
      for (size_t f = 0; f < frames; ++f)
        base_time_(static_cast<Index>(3 * f + c), column) =
            decoded[c * frames + f] * kWeightFraction * out_.base_weight_step;
  }
}

void SegmentEncoder::encode_weights() {
  TimeWeightModel model(out_.frames);
  BinaryEncoder encoder;
  if (out_.base == Base::kAffine)
    encode_base_weights(model, encoder);
  const size_t k = out_.components, frames = out_.frames, rows = out_.weight_channels();
  out_.weights.resize(k * rows * frames);
  out_.weight_scales.resize(k);
  time_.resize(linear_.time.rows(), static_cast<Index>(k));
  std::vector<double> x(rows * frames);
  for (size_t j = 0; j < k; ++j) {
    const auto column = static_cast<Index>(j);
    const double singular = std::sqrt(linear_.energies[column]);
    const double byte = 4 * std::log2(singular / (options_.weight_step * options_.step));
    // 2^21 steps for a weight of 1 are the finest that the coder takes.
    out_.weight_scales[j] = static_cast<uint8_t>(std::clamp(std::round(byte), 0.0, 84.0));
    const double scale = weight_scale_value(out_.weight_scales[j]);
    for (size_t c = 0; c < rows; ++c)
      for (size_t f = 0; f < frames; ++f)
        x[c * frames + f] = linear_.time(static_cast<Index>(rows * f + c), column) / scale;
    int32_t* decoded = out_.weights.data() + j * rows * frames;
    model.encode(encoder, static_cast<uint32_t>(rows), x.data(), options_.weight_lambda, decoded);
    for (size_t c = 0; c < rows; ++c)
      for (size_t f = 0; f < frames; ++f)
        time_(static_cast<Index>(rows * f + c), column) =
            decoded[c * frames + f] * kWeightFraction * scale;
  }
  out_.weight_stream = encoder.finish();
}

// Squared deviations of the clip from the decoded base.
double SegmentEncoder::base_squared_error() const {
  const AffineFunctions functions = AffineFunctions::of(out_.pose.data(), clip_.vertex_count);
  std::vector<double> errors(out_.frames);
  tbb::parallel_for(size_t{0}, errors.size(), [&](size_t f) {
    double map[12] = {};
    if (out_.base == Base::kAffine) {
      double weights[3][kAffineFunctions];
      for (size_t c = 0; c < 3; ++c)
        for (size_t j = 0; j < kAffineFunctions; ++j)
          weights[c][j] = base_time_(static_cast<Index>(3 * f + c), static_cast<Index>(j));
      functions.map(weights, map);
    } else {
      for (size_t c = 0; c < 3; ++c) {
        map[4 * c + c] = out_.pose_step;
        map[4 * c + 3] = out_.pose_origin[c];
      }
    }
    const float* x = clip_.frame(f);
    double sum = 0;
    for (size_t v = 0; v < clip_.vertex_count; ++v) {
      const int32_t* p = out_.pose.data() + 3 * v;
      for (size_t c = 0; c < 3; ++c) {
        const double* m = map + 4 * c;
        const double e = double{x[3 * v + c]} - out_.origin[c] -
                         (m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3]);
        sum += e * e;
      }
    }
    errors[f] = sum;
  });
  double sum = 0;
  for (const double e : errors)
    sum += e;
  return sum;
}

// Least squares against the time weights that a decoder has: Y = (U'U)^-1 U' (X - base).
void SegmentEncoder::fit_coefficients(const VertexOrder& order) {
  const auto k = static_cast<Index>(out_.components);
  const size_t n = clip_.vertex_count, c_count = channels();
  target_.resize(out_.components * n * c_count);
  out_.squared_error = base_squared_error();
  if (k == 0)
    return;
  products_ = time_.transpose() * time_;
  // Every column has about unit length; the ridge only matters where weights were lost in
  // quantisation. Explained energy is then <Y, (U'U + 2 ridge) Y>.
  constexpr double ridge = 1e-9;
  MatrixXd ridged = products_;
  ridged.diagonal().array() += ridge;
  const MatrixXd inverse = ridged.ldlt().solve(time_.transpose());  // k x rows
  const Eigen::RowVectorXd row_sums = inverse.rowwise().sum().transpose();
  const AffineFunctions functions = AffineFunctions::of(out_.pose.data(), n);
  MatrixXd base_part[3];  // per channel: what the combinations make of the affine functions, 4 x k
  if (out_.base == Base::kAffine) {
    const Index stride = c_count == 3 ? 3 : 1;
    for (Index c = 0; c < stride; ++c) {
      MatrixXd rows(base_time_.rows() / stride, base_time_.cols());
      for (Index f = 0; f < rows.rows(); ++f)
        rows.row(f) = base_time_.row(stride * f + c);
      base_part[c].noalias() = (inverse * rows).transpose();
    }
  }
  std::vector<uint32_t> rank(n);
  for (size_t r = 0; r < n; ++r)
    rank[order.order[r]] = static_cast<uint32_t>(r);
  std::vector<double> energies(n);  // per first vertex of a block
  combine_rows(
      clip_, linear_.origin, inverse.transpose(), [&](size_t first, const MatrixXd& block) {
        MatrixXd y = block;
        for (Index i = 0; i < y.rows(); ++i) {
          const size_t v = first + static_cast<size_t>(i) / c_count,
                       c = static_cast<size_t>(i) % c_count;
          const int32_t* p = out_.pose.data() + 3 * v;
          if (out_.base == Base::kPose) {
            y.row(i) -= (out_.pose_origin[c] + out_.pose_step * p[c]) * row_sums;
          } else {
            const double at[] = {double(p[0]), double(p[1]), double(p[2])};
            Eigen::RowVector4d b;
            functions.evaluate(at, b.data());
            y.row(i) -= b * base_part[c];
          }
        }
        energies[first] = (y * products_).cwiseProduct(y).sum() + 2 * ridge * y.squaredNorm();
        for (Index j = 0; j < k; ++j)
          for (Index i = 0; i < y.rows(); ++i) {
            const double value = y(i, j) / options_.step;
            if (!(std::abs(value) < kLargestCoefficient))
              too_fine("a coefficient exceeds 2^19 steps");
            const size_t v = first + static_cast<size_t>(i) / c_count;
            target_[(static_cast<size_t>(j) * n + rank[v]) * c_count +
                    static_cast<size_t>(i) % c_count] = static_cast<float>(value);
          }
      });
  for (const double e : energies)
    out_.squared_error -= e;
}

// The cheapest of the nearest integers, in squared steps and bits.
int32_t SegmentEncoder::quantise(CoefficientModel& model, uint32_t rank, uint32_t channel,
                                 double residual) const {
  const double magnitude = std::abs(residual);
  const auto nearest = static_cast<int32_t>(std::lround(magnitude));
  if (nearest == 0 || options_.lambda <= 0)
    return residual < 0 ? -nearest : nearest;
  int32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  // Nearest first, then towards zero: of equal costs the more exact one.
  for (int32_t q = nearest; q >= std::max(0, nearest - (nearest == 2 ? 2 : 1)); --q) {
    const int32_t candidate = residual < 0 ? -q : q;
    const double bits = static_cast<double>(model.cost(rank, channel, candidate)) / kBitCostOne;
    const double cost = (magnitude - q) * (magnitude - q) + options_.lambda * bits;
    if (cost < least) {
      least = cost;
      best = candidate;
    }
  }
  return best;
}

void SegmentEncoder::encode_coefficients(const VertexOrder& order) {
  const auto n = static_cast<uint32_t>(clip_.vertex_count);
  const auto c_count = static_cast<uint32_t>(channels());
  EncoderPredictor predictor;
  if (predictor.init(order, out_.pose.data(), out_.prediction, out_.components) != Status::kOk)
    throw Error(ErrorKind::kInternal, "invalid prediction parameters");
  CoefficientModel model(n, c_count, order.neighbours.data(),
                         static_cast<uint32_t>(order.neighbour_count));
  BinaryEncoder encoder;
  out_.residuals.resize(target_.size());
  out_.coefficients.resize(target_.size());
  out_.omega.resize(out_.components);
  size_t at = 0, layer = 0;
  for (uint32_t j = 0; j < out_.components; ++j) {
    if (layer < options_.layer_starts.size() && options_.layer_starts[layer] == j) {
      out_.coefficient_streams.push_back(std::exchange(encoder, BinaryEncoder()).finish());
      ++layer;
    }
    double energy = 0;
    model.begin_component();
    for (uint32_t r = 0; r < n; ++r)
      for (uint32_t c = 0; c < c_count; ++c, ++at) {
        const float p = predictor.predict(r, static_cast<int>(c));
        const int32_t q = quantise(model, r, c, double{target_[at]} - double{p});
        model.code(encoder, r, c, q);
        out_.residuals[at] = q;
        out_.coefficients[at] = predictor.commit(r, static_cast<int>(c), p, q);
        energy += static_cast<double>(q) * q;
      }
    model.end_component();
    const uint8_t omega = omega_byte(energy / (static_cast<double>(n) * c_count));
    out_.omega[j] = omega;
    constexpr size_t grain = 256;
    const size_t blocks = predictor.block_count();
    tbb::parallel_for(size_t{0}, (blocks + grain - 1) / grain, [&](size_t b) {
      predictor.update(b * grain, std::min(blocks, (b + 1) * grain), omega);
    });
    predictor.next_component();
  }
  out_.coefficient_streams.push_back(encoder.finish());
}

void SegmentEncoder::add_quantisation_error() {
  const auto k = static_cast<Index>(out_.components);
  const size_t rows = clip_.vertex_count * channels();
  constexpr size_t grain = 1024;
  std::vector<double> errors((rows + grain - 1) / grain);
  tbb::parallel_for(size_t{0}, errors.size(), [&](size_t b) {
    const size_t first = b * grain, count = std::min(grain, rows - first);
    MatrixXd e(static_cast<Index>(count), k);
    for (Index j = 0; j < k; ++j)
      for (size_t i = 0; i < count; ++i) {
        const size_t from = static_cast<size_t>(j) * rows + first + i;
        e(static_cast<Index>(i), j) =
            (double{target_[from]} - double{out_.coefficients[from]}) * options_.step;
      }
    errors[b] = (e * products_).cwiseProduct(e).sum();
  });
  for (const double e : errors)
    out_.squared_error += e;
  out_.squared_error = std::max(0.0, out_.squared_error);
}

PredictiveBasis SegmentEncoder::run(std::span<const uint32_t> triangles) {
  quantise_pose();
  VertexOrder order;
  const Status status =
      make_vertex_order(triangles.data(), triangles.size() / 3, out_.pose.data(),
                        clip_.vertex_count, options_.neighbours, options_.colours, &order);
  if (status != Status::kOk)
    throw Error(ErrorKind::kInternal, status_string(status));
  encode_weights();
  fit_coefficients(order);
  encode_coefficients(order);
  if (out_.components > 0)
    add_quantisation_error();
  return std::move(out_);
}

}  // namespace

size_t PredictiveBasis::coefficient_bytes() const {
  size_t sum = 0;
  for (const auto& stream : coefficient_streams)
    sum += stream.size();
  return sum;
}

double weight_scale_value(uint8_t byte) {
  return std::exp2(-0.25 * byte);
}

double smallest_energy(format::BasisKind kind, size_t vertices, size_t frames,
                       const PredictiveOptions& options) {
  const size_t sum =
      kind == format::BasisKind::kEigenshapes ? 3 * vertices + frames : vertices + 3 * frames;
  return options.rank_share * static_cast<double>(sum) * options.step * options.step;
}

size_t component_count(const LinearBasis& basis, size_t vertices, size_t frames,
                       const PredictiveOptions& options) {
  const double smallest = smallest_energy(basis.kind, vertices, frames, options);
  const auto limit = std::min(options.max_components, static_cast<size_t>(basis.energies.size()));
  size_t count = 0;
  while (count < limit && basis.energies[static_cast<Index>(count)] > smallest)
    ++count;
  return count;
}

PredictiveBasis encode_predictive_basis(const LinearAnalysis& analysis, const LinearBasis& basis,
                                        std::span<const uint32_t> triangles,
                                        const PredictiveOptions& options) {
  if (!(options.step > 0))
    throw Error(ErrorKind::kInternal, "the step must be positive");
  return SegmentEncoder(analysis, basis, options).run(triangles);
}

Eigen::MatrixXd decoded_frame(const PredictiveBasis& basis, std::span<const uint32_t> order,
                              size_t frame) {
  const size_t n = basis.vertices, c_count = basis.channels(), rows = basis.weight_channels();
  const size_t frames = basis.frames;
  double map[12] = {};
  if (basis.base == Base::kAffine) {
    double weights[3][kAffineFunctions];
    for (size_t c = 0; c < 3; ++c)
      for (size_t j = 0; j < kAffineFunctions; ++j)
        weights[c][j] = basis.base_weights[(3 * j + c) * frames + frame] * kWeightFraction *
                        basis.base_weight_step;
    AffineFunctions::of(basis.pose.data(), n).map(weights, map);
  } else {
    for (size_t c = 0; c < 3; ++c) {
      map[4 * c + c] = basis.pose_step;
      map[4 * c + 3] = basis.pose_origin[c];
    }
  }
  MatrixXd out(static_cast<Index>(n), 3);
  for (size_t r = 0; r < n; ++r) {
    const size_t v = order[r];
    const int32_t* p = basis.pose.data() + 3 * v;
    for (size_t c = 0; c < 3; ++c) {
      const double* m = map + 4 * c;
      double x = basis.origin[c] + m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
      for (size_t j = 0; j < basis.components; ++j) {
        const size_t row = rows == 3 ? c : 0, channel = c_count == 3 ? c : 0;
        x += basis.weights[(j * rows + row) * frames + frame] * kWeightFraction *
             weight_scale_value(basis.weight_scales[j]) * basis.step *
             double{basis.coefficients[(j * n + r) * c_count + channel]};
      }
      out(static_cast<Index>(v), static_cast<Index>(c)) = x;
    }
  }
  return out;
}

}  // namespace anicodec
