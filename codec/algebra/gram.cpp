// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/gram.h"

#include "codec/algebra/blocked_product.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace anicodec {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::RowVector3d;

MatrixXd FrameGram::clip_centred() const {
  const Centroids motion = centroids.rowwise() - centroids.colwise().mean();
  return shape + static_cast<double>(vertex_count) * (motion * motion.transpose());
}

double kg_error(double squared_error, double reference) {
  return 100 * std::sqrt(squared_error / (reference > 0 ? reference : 1));
}

double rmse(double squared_error, size_t vertices, size_t frames) {
  return std::sqrt(squared_error / (static_cast<double>(vertices) * static_cast<double>(frames)));
}

Centroids frame_centroids(const FrameView& clip) {
  Centroids centroids(static_cast<Index>(clip.frame_count), 3);
  parallel_for(size_t{0}, clip.frame_count, [&](size_t f) {
    const float* p = clip.frame(f);
    RowVector3d sum = RowVector3d::Zero();
    for (size_t v = 0; v < clip.vertex_count; v++, p += 3) {
      sum += RowVector3d(p[0], p[1], p[2]);
    }
    centroids.row(static_cast<Index>(f)) = sum / static_cast<double>(clip.vertex_count);
  });
  return centroids;
}

FrameGram frame_gram(const FrameView& clip, std::span<const Matrix3d> rotations) {
  const auto frames = static_cast<Index>(clip.frame_count);
  FrameGram gram{clip.vertex_count, frame_centroids(clip), MatrixXd::Zero(frames, frames)};
  const auto block = static_cast<size_t>(panel_depth(frames)) / 3;
  MatrixXd panel;
  for (size_t first = 0; first < clip.vertex_count; first += block) {
    const size_t count = std::min(block, clip.vertex_count - first);
    panel.resize(static_cast<Index>(3 * count), frames);
    parallel_for(Index{0}, frames, [&](Index f) {
      const float* p = clip.frame(static_cast<size_t>(f)) + 3 * first;
      double* out = panel.col(f).data();
      const RowVector3d c = gram.centroids.row(f);
      if (rotations.empty()) {
        for (size_t i = 0; i < 3 * count; i += 3) {
          out[i] = double{p[i]} - c[0];
          out[i + 1] = double{p[i + 1]} - c[1];
          out[i + 2] = double{p[i + 2]} - c[2];
        }
        return;
      }
      const Matrix3d& r = rotations[static_cast<size_t>(f)];
      for (size_t i = 0; i < 3 * count; i += 3) {
        const RowVector3d y = (RowVector3d(p[i], p[i + 1], p[i + 2]) - c) * r;
        out[i] = y[0];
        out[i + 1] = y[1];
        out[i + 2] = y[2];
      }
    });
    add_self_products(panel, gram.shape);
  }
  mirror_upper(gram.shape);
  return gram;
}

MatrixXd about_mean(const MatrixXd& gram) {
  const Eigen::VectorXd mean = gram.rowwise().mean();
  MatrixXd centred = gram.colwise() - mean;
  centred.rowwise() -= mean.transpose();
  centred.array() += mean.mean();
  return centred;
}

CrossProducts::CrossProducts(const FrameView& clip, Centroids centroids)
    : clip_(clip), centroids_(std::move(centroids)), slot_(clip.frame_count, -1) {}

void CrossProducts::require(std::span<const uint32_t> frames, size_t max_columns) {
  std::vector<uint32_t> missing;
  const auto collect = [&] {
    missing.clear();
    for (uint32_t g : frames) {
      if (slot_[g] < 0) {
        missing.push_back(g);
      }
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  };
  collect();
  if (missing.empty()) {
    return;
  }
  if (static_cast<size_t>(used_) + missing.size() > max_columns) {
    std::fill(slot_.begin(), slot_.end(), -1);
    used_ = 0;
    collect();
  }
  const auto rows = static_cast<Index>(3 * clip_.frame_count);
  const auto columns = static_cast<Index>(3 * missing.size());

  // A panel's row is a vertex, its columns are the coordinates of the frames.
  const auto block = static_cast<size_t>(panel_depth(rows));
  const auto load = [&](size_t first, size_t count, uint32_t frame, Index column, MatrixXd& panel) {
    const float* p = clip_.frame(frame) + 3 * first;
    for (Index axis = 0; axis < 3; axis++) {
      const double c = centroids_(frame, axis);
      double* out = panel.col(column + axis).data();
      for (size_t v = 0; v < count; v++) {
        out[v] = double{p[3 * v + static_cast<size_t>(axis)]} - c;
      }
    }
  };
  MatrixXd sums = MatrixXd::Zero(rows, columns);
  MatrixXd all;
  MatrixXd some;
  for (size_t first = 0; first < clip_.vertex_count; first += block) {
    const size_t count = std::min(block, clip_.vertex_count - first);
    all.resize(static_cast<Index>(count), rows);
    some.resize(static_cast<Index>(count), columns);
    parallel_for(size_t{0}, clip_.frame_count, [&](size_t f) {
      load(first, count, static_cast<uint32_t>(f), static_cast<Index>(3 * f), all);
    });
    for (size_t j = 0; j < missing.size(); j++) {
      const auto from = static_cast<Index>(3 * missing[j]);
      some.middleCols(static_cast<Index>(3 * j), 3) = all.middleCols(from, 3);
    }
    add_products(all, some, sums);
  }
  if (products_.cols() < 3 * used_ + columns) {
    products_.conservativeResize(rows, 3 * used_ + columns);
  }
  products_.middleCols(3 * used_, columns) = sums;
  for (uint32_t g : missing) {
    slot_[g] = used_++;
  }
}

Eigen::Block<const MatrixXd> CrossProducts::column(uint32_t g) const {
  return products_.block(0, 3 * slot_[g], products_.rows(), 3);
}

std::vector<double> principal_errors(const Eigen::MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();  // ascending
  std::vector<double> left(static_cast<size_t>(values.size()) + 1, 0.0);
  for (Index i = 0; i < values.size(); i++) {
    const auto k = static_cast<size_t>(values.size() - 1 - i);
    left[k] = left[k + 1] + (values[i] > 0 ? values[i] : 0);
  }
  return left;
}

}  // namespace anicodec
