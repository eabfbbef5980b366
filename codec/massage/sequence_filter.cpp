// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/sequence_filter.h"

#include "codec/algebra/gram.h"
#include "codec/algebra/leading_eigenpairs.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr double kLeastVariance = 1e-12;  // of the largest
constexpr size_t kBlock = 384;            // coordinates combined at a time

float to_float(double x) {
  return static_cast<float>(x);
}

void play_block(const FrameView& clip, size_t first, size_t count,
                const Eigen::RowVectorXd& weights, double* out) {
  std::fill_n(out, count, 0.0);
  for (size_t g = 0; g < clip.frame_count; ++g) {
    const double weight = weights[static_cast<Index>(g)];
    const float* in = clip.frame(g) + first;
    for (size_t k = 0; k < count; ++k)
      out[k] += weight * double{in[k]};
  }
}

}  // namespace

SequenceFilter::SequenceFilter(const FrameView& clip) {
  const Eigen::MatrixXd gram = about_mean(frame_gram(clip).clip_centred());
  Eigenpairs pairs =
      leading_eigenpairs(gram, gram.rows(), kLeastVariance * std::max(0.0, gram.trace()));
  variances_ = std::move(pairs.values);
  vectors_ = std::move(pairs.vectors);
}

Eigen::MatrixXd SequenceFilter::weights(double level) const {
  const Index frames = vectors_.rows();
  const Eigen::VectorXd kept = (1 - (level / variances_.array()).square()).max(0.0);
  return Eigen::MatrixXd::Constant(frames, frames, 1 / static_cast<double>(frames)) +
         vectors_ * kept.asDiagonal() * vectors_.transpose();
}

std::vector<float> combination(const FrameView& clip, const Eigen::RowVectorXd& weights) {
  std::vector<double> sums(3 * clip.vertex_count);
  play_block(clip, 0, sums.size(), weights, sums.data());
  std::vector<float> result(sums.size());
  std::transform(sums.begin(), sums.end(), result.begin(), to_float);
  return result;
}

void play_frames(const Eigen::MatrixXd& weights, uint32_t first, MeshSequence* sequence) {
  const size_t size = size_t{3} * sequence->vertex_count;
  const FrameView clip = FrameView(*sequence).frames(first, static_cast<size_t>(weights.rows()));
  parallel_for(size_t{0}, (size + kBlock - 1) / kBlock, [&](size_t b) {
    const size_t begin = b * kBlock, count = std::min(kBlock, size - begin);
    std::vector<double> block(count * clip.frame_count);
    for (size_t f = 0; f < clip.frame_count; ++f)
      play_block(clip, begin, count, weights.row(static_cast<Index>(f)), block.data() + f * count);
    for (size_t f = 0; f < clip.frame_count; ++f) {
      const double* from = block.data() + f * count;
      std::transform(from, from + count, sequence->frame(first + f).data() + begin, to_float);
    }
  });
}

}  // namespace anicodec
