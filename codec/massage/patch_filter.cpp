// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/patch_filter.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/algebra/rigid_motion.h"
#include "codec/parallel/parallel.h"
#include "codec/sequence/frame_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

constexpr uint32_t kMiddlesApart = 4, kReach = 7;  // edges
constexpr size_t kFewestVertices = 8;
constexpr Index kNoiseFrames = 64;  // that the noise is measured on, at most
constexpr size_t kPatchesAtOnce = 32;

/// Noise of a patch per coordinate, from the Gram matrix of its frames.
double noise_level(const MatrixXd& gram, double dimensions) {
  const Index frames = std::min(gram.rows(), kNoiseFrames);
  std::vector<Index> some(static_cast<size_t>(frames));
  for (Index k = 0; k < frames; ++k)
    some[static_cast<size_t>(k)] = k * gram.rows() / frames;
  const MatrixXd centred = about_mean(gram(some, some));
  const Eigenpairs pairs = leading_eigenpairs(centred, frames, 0);
  const double samples = static_cast<double>(frames) - 1;
  const double fewer = std::min(samples, dimensions), more = std::max(samples, dimensions);
  const auto middle = static_cast<Index>(fewer / 2);
  if (middle >= pairs.values.size())
    return 0;
  return std::sqrt(pairs.values[middle] / (more * marchenko_pastur_median(fewer / more)));
}

/// The frames of a patch.
class PatchClip {
 public:
  PatchClip(std::span<const uint32_t> source, const MeshSequence& clip, uint32_t first,
            uint32_t count)
      : vertices_(source.size()), frames_(count) {
    floats_.reserve(3 * vertices_ * frames_);
    for (uint32_t f = first; f < first + count; ++f) {
      const std::span<const float> frame = clip.frame(f);
      for (uint32_t v : source)
        floats_.insert(floats_.end(),
                       {frame[3 * size_t{v}], frame[3 * size_t{v} + 1], frame[3 * size_t{v} + 2]});
    }
  }

  /// Makes of the frames by how much the filter moves them. Returns the components left.
  double filter(double level, std::vector<float>* moves) const {
    moves->assign(floats_.size(), 0);
    const FrameView view(floats_.data(), frames_, vertices_);
    const Centroids centroids = frame_centroids(view);
    const std::vector<Eigen::Matrix3d> rotations = align_frames(view, centroids);
    const MatrixXd gram = frame_gram(view, rotations).shape;
    const double dimensions = 3 * static_cast<double>(vertices_) - 6;  // less the rigid ones
    const double noise = level * noise_level(gram, dimensions);
    const auto samples = static_cast<double>(frames_ - 1);
    if (!(noise > 0))
      return samples;
    const double more = std::max(samples, dimensions);
    const double ratio = std::min(samples, dimensions) / more;
    const double unit = noise * noise * more;
    const double edge = unit * (1 + std::sqrt(ratio)) * (1 + std::sqrt(ratio));
    const Eigenpairs pairs = leading_eigenpairs(about_mean(gram), gram.rows(), edge);
    const Eigen::ArrayXd squares = pairs.values.array() / unit;
    const Eigen::VectorXd kept =
        ((squares - ratio - 1).square() - 4 * ratio).max(0).sqrt() / squares;

    const auto rows = static_cast<Index>(frames_), points = static_cast<Index>(vertices_);
    MatrixXd posed(rows, 3 * points);
    for (Index f = 0; f < rows; ++f) {
      const Points turned = (frame(f).rowwise() - centroids.row(f)) * rotation(rotations, f);
      posed.row(f) = Eigen::Map<const Eigen::RowVectorXd>(turned.data(), turned.size());
    }
    posed.rowwise() -= posed.colwise().mean().eval();
    const MatrixXd parts = kept.asDiagonal() * (pairs.vectors.transpose() * posed);
    for (Index f = 0; f < rows; ++f) {
      Eigen::RowVectorXd move = -posed.row(f);
      if (parts.rows() > 0)  // nothing of a patch may be above the noise
        move += pairs.vectors.row(f) * parts;
      const Points back =
          Eigen::Map<const Points>(move.data(), points, 3) * rotation(rotations, f).transpose();
      std::transform(back.data(), back.data() + back.size(),
                     moves->begin() + static_cast<ptrdiff_t>(f * back.size()),
                     [](double x) { return static_cast<float>(x); });
    }
    return kept.sum();
  }

 private:
  Points frame(Index f) const {
    return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
               floats_.data() + static_cast<size_t>(f) * 3 * vertices_,
               static_cast<Index>(vertices_), 3)
        .cast<double>();
  }

  static const Eigen::Matrix3d& rotation(const std::vector<Eigen::Matrix3d>& rotations, Index f) {
    return rotations[static_cast<size_t>(f)];
  }

  size_t vertices_, frames_;
  std::vector<float> floats_;
};

}  // namespace

PatchFilter::PatchFilter(const SurfaceTopology& topology) {
  std::vector<bool> near_middle(topology.vertex_count, false);
  std::vector<uint32_t> found_for(topology.vertex_count, SurfaceTopology::kNone);
  for (uint32_t middle = 0; middle < topology.vertex_count; ++middle) {
    if (near_middle[middle] || topology.star[middle].empty())
      continue;
    Patch patch;
    std::vector<uint32_t> hops{0};
    patch.vertices.push_back(middle);
    found_for[middle] = middle;
    for (size_t k = 0; k < patch.vertices.size() && hops[k] < kReach; ++k) {
      for (uint32_t j : topology.ring[patch.vertices[k]]) {
        if (found_for[j] == middle)
          continue;
        found_for[j] = middle;
        patch.vertices.push_back(j);
        hops.push_back(hops[k] + 1);
      }
    }
    for (size_t k = 0; k < hops.size(); ++k) {
      if (hops[k] <= kMiddlesApart)
        near_middle[patch.vertices[k]] = true;
      const float height = 1 - static_cast<float>(hops[k]) / (kReach + 1);
      patch.weights.push_back(height * height);
    }
    if (patch.vertices.size() >= kFewestVertices)
      patches_.push_back(std::move(patch));
  }
}

double PatchFilter::run(double level, std::span<const uint32_t> vertices, uint32_t first,
                        uint32_t count, MeshSequence* clip) const {
  const size_t frame_size = 3 * vertices.size();
  std::vector<float> sums(frame_size * count, 0), weights(vertices.size(), 0);
  double components = 0;
  for (size_t begin = 0; begin < patches_.size(); begin += kPatchesAtOnce) {
    const size_t end = std::min(begin + kPatchesAtOnce, patches_.size());
    std::vector<std::vector<float>> moves(end - begin);
    std::vector<double> kept(end - begin);
    parallel_for(begin, end, [&](size_t p) {
      std::vector<uint32_t> source;
      for (uint32_t v : patches_[p].vertices)
        source.push_back(vertices[v]);
      kept[p - begin] = PatchClip(source, *clip, first, count).filter(level, &moves[p - begin]);
    });
    for (size_t p = begin; p < end; ++p) {
      const Patch& patch = patches_[p];
      const float* move = moves[p - begin].data();
      for (uint32_t f = 0; f < count; ++f) {
        for (size_t k = 0; k < patch.vertices.size(); ++k) {
          float* sum = sums.data() + f * frame_size + 3 * size_t{patch.vertices[k]};
          for (int c = 0; c < 3; ++c)
            sum[c] += patch.weights[k] * *move++;
        }
      }
      for (size_t k = 0; k < patch.vertices.size(); ++k)
        weights[patch.vertices[k]] += patch.weights[k];
      components += kept[p - begin];
    }
  }
  for (uint32_t f = 0; f < count; ++f) {
    const std::span<float> frame = clip->frame(first + f);
    for (size_t v = 0; v < vertices.size(); ++v) {
      for (size_t c = 0; weights[v] > 0 && c < 3; ++c)
        frame[3 * size_t{vertices[v]} + c] += sums[f * frame_size + 3 * v + c] / weights[v];
    }
  }
  return patches_.empty() ? 0 : components / static_cast<double>(patches_.size());
}

double marchenko_pastur_median(double ratio) {
  // The eigenvalue is 1 + ratio - 2 sqrt(ratio) cos(t), of density 2 sin^2(t) / (pi eigenvalue).
  constexpr int kSteps = 400;
  const double pi = std::acos(-1.0), step = pi / kSteps;
  double below = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double t = (k + 0.5) * step;
    const double value = 1 + ratio - 2 * std::sqrt(ratio) * std::cos(t);
    const double here = 2 * std::sin(t) * std::sin(t) / (pi * value) * step;
    if (below + here >= 0.5) {
      const double at = t + (0.5 - below - here / 2) / here * step;
      return 1 + ratio - 2 * std::sqrt(ratio) * std::cos(at);
    }
    below += here;
  }
  return 1 + ratio;
}

}  // namespace anicodec
