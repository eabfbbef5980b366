// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/linear_segment_encode.h"

#include "codec/parallel/parallel.h"
#include "codec/segment/basis_fit.h"
#include "codec/segment/coefficient_encoder.h"
#include "codec/sequence/error.h"
#include "format/coding/time_weights.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/learnt_segment.h"
#include "sdk/segment/region_coding.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Isolated: a thread that waits here must not begin another trial meanwhile, which takes long.
void run_together(size_t count, const std::function<void(size_t)>& task) {
  isolated([&] { parallel_tasks(count, task); });
}

/// Codes the columns of `weights` as time components of `channels` channels (row channels * f + c)
/// in units of `unit`, each column by its own, and replaces them by what a decoder gets.
class WeightEncoder {
 public:
  WeightEncoder(size_t frames, const Vector<uint32_t>& runs, const LinearSettings& settings)
      : frames_(frames),
        lambda_(settings.weight_lambda),
        predictors_(settings.weight_predictors),
        runs_(runs.empty() ? Vector<uint32_t>(1, static_cast<uint32_t>(frames)) : runs),
        model_(runs_) {
    for (size_t r = 0; r < settings.run_steps.size(); ++r)
      factors_.insert(factors_.end(), runs[r],
                      LinearParameters::sigma_value(settings.run_steps[r]));
    factors_.resize(frames, 1);
  }

  /// False if a weight is too large in its unit. `values`: receives channels x frames integers.
  bool code(uint32_t channels, double unit, Eigen::Ref<VectorXd> column, int32_t* values) {
    std::vector<double> x(channels * frames_);
    for (size_t f = 0; f < frames_; ++f) {
      for (size_t c = 0; c < channels; ++c) {
        double value = column[static_cast<Index>(channels * f + c)] / (unit * factors_[f]);
        if (!(std::abs(value) < kWeightLimit / 2))
          return false;
        x[c * frames_ + f] = value;
      }
    }
    model_.encode(encoder_, channels, x.data(), lambda_, values, predictors_, run_together);
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
  uint32_t predictors_;
  std::vector<double> factors_;  ///< of the unit, for each frame
  Vector<uint32_t> runs_;
  TimeWeightModel model_;
  BinaryEncoder encoder_;
};

/// A segment being coded.
class LinearEncoder {
 public:
  LinearEncoder(const FrameView& clip, const LinearBasis& basis, const LinearSettings& settings,
                const MeshLayout& layout, const Vector<uint32_t>& runs, const Learning& learning)
      : clip_(clip), basis_(basis), settings_(settings), layout_(layout) {
    const std::vector<size_t> counts =
        component_counts(basis, settings, clip.vertex_count, clip.frame_count);
    count_ = *std::ranges::max_element(counts);
    if (basis.regions.empty())
      fits_.emplace_back(clip, basis, count_);
    for (size_t r = 0; r < basis.regions.size(); ++r)
      fits_.emplace_back(basis.clips->clip(r), basis.regions[r], counts[r]);
    if (!basis.regions.empty())
      parameters_.region_components.assign(counts.begin(), counts.end());
    parameters_.affine = basis.base == Base::kAffine;
    parameters_.basis_step = settings.step;
    parameters_.weight_step = settings.weight_factor * settings.step;
    parameters_.neighbours = settings.neighbours;
    parameters_.colours = settings.passes_per_level;
    parameters_.radius = settings.radius;
    parameters_.schedule = settings.schedule;
    parameters_.alike = settings.alike;
    parameters_.layers_anew = settings.layers_anew;
    parameters_.run_steps.assign(settings.run_steps.begin(), settings.run_steps.end());
    parameters_.omega.assign(count_, 128);
    encoded_.runs = runs;
    encoded_.sizes.kind = basis.kind;
    encoded_.sizes.frames = static_cast<uint32_t>(clip.frame_count);
    encoded_.sizes.components = static_cast<uint32_t>(count_);
    encoded_.sizes.regions = parameters_.regions();
    encoded_.sizes.learns = learning.hands_on && count_ > 0 && !settings.layers_anew &&
                            settings.neighbours <= kMostLearningNeighbours;
    if (encoded_.sizes.learns)
      encoded_.continued = learning.continued;
  }

  std::optional<EncodedSegment> run(std::shared_ptr<const EncodedPose> coded_pose) {
    set_pose(std::move(coded_pose));
    set_sigma();
    set_layers();
    code_regions();
    std::vector<TimeWeights> weights;
    for (const BasisFit& fit : fits_)
      weights.push_back(fit.exact_weights());
    // The order needs the pose alone.
    bool is_coded = false;
    Coefficients target;
    VertexOrder order;
    run_together(count_ > 0 ? 2 : 1, [&](size_t task) {
      if (task > 0) {
        order = coefficient_order(settings_, layout_, pose(), regions());
        return;
      }
      is_coded = code_time(std::move(weights));
      if (is_coded && count_ > 0)
        target = targets();
    });
    if (!is_coded)
      return std::nullopt;
    if (encoded_.continued && !encoded_.continued->suits(encoded_.sizes.kind, order))
      encoded_.continued = nullptr;
    if (encoded_.continued)
      encoded_.continued_identity = encoded_.continued->identity;
    if (count_ > 0) {
      CoefficientEncoder coefficients(settings_, std::move(order), pose(), std::move(target),
                                      traits_of(basis_.kind).channels, encoded_.continued);
      if (!code_layers(coefficients))
        return std::nullopt;
      if (settings_.refit_weights)
        refit_time(coefficients.decoded());
      std::move(coefficients).take_decoded(&decoded_);
    }
    encoded_.parameters = parameters_.write();
    for (size_t l = 0; l < layers_.size(); ++l) {
      BasisLayer& layer = layers_[l];
      layer.weights = time_streams_[l];
      layer.coefficients = coefficient_streams_[l];
      encoded_.coefficient_bytes += coefficient_streams_[l].size();
      encoded_.layers.push_back(layer.write());
    }
    encoded_.decoded = std::move(decoded_);
    return std::move(encoded_);
  }

 private:
  /// Null: all vertices are of one region.
  const uint8_t* regions() const { return basis_.clips ? basis_.clips->regions().data() : nullptr; }

  uint32_t weight_channels() const { return traits_of(basis_.kind).weight_channels; }

  const LinearBasis& basis_of(size_t region) const {
    return basis_.regions.empty() ? basis_ : basis_.regions[region];
  }

  void set_pose(std::shared_ptr<const EncodedPose> coded_pose) {
    encoded_.reference = std::move(coded_pose);
    const PoseGrid& grid = encoded_.reference->grid;
    for (size_t r = 0; r < fits_.size(); ++r) {
      Vector<int32_t> points;
      for (size_t v = 0; v < clip_.vertex_count; ++v) {
        if (!regions() || regions()[v] == r)
          points.insert(points.end(), pose().data() + 3 * v, pose().data() + 3 * v + 3);
      }
      fits_[r].set_pose(points, Eigen::Vector3d(grid.origin), grid.step);
    }
  }

  const Vector<int32_t>& pose() const { return encoded_.reference->grid.points; }

  void set_sigma() {
    parameters_.sigma.assign(count_ * fits_.size(), 0);
    for (size_t r = 0; r < fits_.size(); ++r) {
      for (size_t j = 0; j < fits_[r].components(); ++j) {
        // Weights of a component of next to no energy would have no step.
        const double sigma = std::max(std::sqrt(basis_of(r).energies[static_cast<Index>(j)]),
                                      1e-6 * parameters_.weight_step);
        parameters_.sigma[j * fits_.size() + r] = LinearParameters::sigma_eighths(sigma);
      }
    }
  }

  void code_regions() {
    if (!regions())
      return;
    const Vector<uint32_t>& triangles = layout_.topology.triangles;
    MeshGraph graph;
    if (graph.init(triangles.data(), triangles.size() / 3, clip_.vertex_count) != Status::kOk)
      throw Error(ErrorKind::kInternal, "the edges of the mesh cannot be found");
    BinaryEncoder encoder;
    Vector<uint8_t> copy(basis_.clips->regions());
    RegionCoding(graph, encoded_.sizes.regions).code(encoder, &copy);
    encoded_.pose = encoder.finish();
  }

  /// Codes the time weights of bases and components, and keeps what a decoder gets. False if one is
  /// too large in its unit: then nothing has changed.
  bool code_time(std::vector<TimeWeights> weights) {
    WeightEncoder coder(clip_.frame_count, encoded_.runs, settings_);
    const auto functions = static_cast<size_t>(weights[0].base.cols());
    const size_t of_function = 3 * clip_.frame_count, regions = weights.size();
    Vector<int32_t> affine(regions * functions * of_function);
    Vector<int32_t> integers(count_ * regions * weight_channels() * clip_.frame_count);
    for (size_t b = 0; b < functions; ++b) {
      for (size_t r = 0; r < regions; ++r) {
        if (!coder.code(3, parameters_.weight_step, weights[r].base.col(static_cast<Index>(b)),
                        affine.data() + (r * functions + b) * of_function))
          return false;
      }
    }
    Bytes of_base = coder.finish();
    std::vector<Bytes> streams;
    for (const BasisLayer& layer : layers_) {
      if (parameters_.layers_anew && layer.first > 0)
        coder.begin_anew();
      for (size_t j = layer.first; j < layer.first + layer.count; ++j) {
        if (!code_component(coder, j, weights, integers))
          return false;
      }
      streams.push_back(coder.finish());
    }
    encoded_.time_weights = affine.size();
    for (const BasisFit& fit : fits_)
      encoded_.time_weights += fit.components() * weight_channels() * clip_.frame_count;
    encoded_.weights = std::move(of_base);
    time_streams_ = std::move(streams);
    decoded_.affine_weights = std::move(affine);
    decoded_.weights = std::move(integers);
    for (size_t r = 0; r < weights.size(); ++r)
      fits_[r].set_decoded(std::move(weights[r]));
    return true;
  }

  /// The weights of a component, by region.
  bool code_component(WeightEncoder& coder, size_t j, std::vector<TimeWeights>& weights,
                      Vector<int32_t>& integers) const {
    const size_t rows = weight_channels() * clip_.frame_count;
    for (size_t r = 0; r < weights.size(); ++r) {
      if (j >= fits_[r].components())
        continue;
      const int32_t sigma = parameters_.sigma[j * weights.size() + r];
      const double unit = parameters_.weight_step / LinearParameters::sigma_value(sigma);
      if (!coder.code(weight_channels(), unit, weights[r].components.col(static_cast<Index>(j)),
                      integers.data() + (j * weights.size() + r) * rows))
        return false;
    }
    return true;
  }

  /// The best coefficients of all vertices; 0 where a region has no more components.
  Coefficients targets() const {
    if (!regions())
      return fits_[0].targets(settings_.step);
    Coefficients all =
        Coefficients::Zero(static_cast<Index>(clip_.vertex_count), static_cast<Index>(count_));
    for (size_t r = 0; r < fits_.size(); ++r) {
      const Coefficients of_region = fits_[r].targets(settings_.step);
      all(basis_.clips->vertices(r), Eigen::seqN(0, of_region.cols())) = of_region;
    }
    return all;
  }

  /// The coefficients are no longer those that the weights were made for: the weights that are best
  /// for what was coded. Nothing of the coefficients depends on them.
  void refit_time(const Coefficients& decoded) {
    std::vector<TimeWeights> weights;
    for (size_t r = 0; r < fits_.size(); ++r) {
      const auto k = static_cast<Index>(fits_[r].components());
      weights.push_back(fits_[r].refitted(
          regions() ? Coefficients(decoded(basis_.clips->vertices(r), Eigen::seqN(0, k))) : decoded,
          settings_.step));
    }
    code_time(std::move(weights));
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
  size_t count_ = 0;            ///< of components, most of any region
  std::vector<BasisFit> fits_;  ///< of the regions, or of the whole
  LinearParameters parameters_;
  EncodedSegment encoded_;
  DecodedBasis decoded_;            ///< what a decoder gets
  std::vector<BasisLayer> layers_;  ///< their streams are below
  std::vector<Bytes> time_streams_, coefficient_streams_;
};

}  // namespace

std::vector<size_t> component_counts(const LinearBasis& basis, const LinearSettings& settings,
                                     size_t vertices, size_t frames) {
  const BasisTraits traits = traits_of(basis.kind);
  std::vector<size_t> counts;
  const auto count = [&](const LinearBasis& of_region, size_t vertex_count) {
    const auto most = static_cast<size_t>(of_region.energies.size());
    if (!settings.components.empty())
      return std::min(settings.components[std::min(counts.size(), settings.components.size() - 1)],
                      most);
    const auto scalars =
        static_cast<double>(traits.channels * vertex_count + traits.weight_channels * frames);
    const double smallest = settings.rank_factor * scalars * settings.step * settings.step;
    return static_cast<size_t>((of_region.energies.array() > smallest).count());
  };
  if (basis.regions.empty())
    counts.push_back(count(basis, vertices));
  for (size_t r = 0; r < basis.regions.size(); ++r)
    counts.push_back(count(basis.regions[r], basis.clips->vertices(r).size()));
  return counts;
}

double pose_step(const LinearSettings& settings, size_t frames) {
  return settings.pose_factor * settings.step / std::sqrt(static_cast<double>(frames));
}

std::optional<EncodedSegment> encode_linear(const FrameView& clip, const LinearBasis& basis,
                                            const LinearSettings& settings,
                                            const MeshLayout& layout,
                                            std::shared_ptr<const EncodedPose> pose,
                                            const Vector<uint32_t>& runs,
                                            const Learning& learning) {
  return LinearEncoder(clip, basis, settings, layout, runs, learning).run(std::move(pose));
}

}  // namespace anicodec
