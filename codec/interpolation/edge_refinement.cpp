// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/interpolation/edge_refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Added to the diagonal, as a share of its mean: holds what turns and moves as a whole.
constexpr double kDamping = 1e-8;

/// A step is halved this often before it is given up.
constexpr int kHalvings = 8;

double wrapped(double angle) {
  return angle - kFullTurn * std::round(angle / kFullTurn);
}

/// Twice the area of a triangle, by its sides.
double double_area(double a, double b, double c) {
  const double s = (a + b + c) / 2;
  return 2 * std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
}

/// How the dihedral angle changes with the four vertices a, b, c, d of a hinge. False when it has
/// no direction.
bool angle_gradient(const Points& x, const Hinge& h, Vector3d (&gradient)[4]) {
  const Vector3d a = x.col(column(h.a));
  const Vector3d along = x.col(column(h.b)) - a, c = x.col(column(h.c)) - a,
                 d = x.col(column(h.d)) - a;
  const Vector3d n0 = along.cross(c), n1 = d.cross(along);
  const double square = along.squaredNorm(), size0 = n0.squaredNorm(), size1 = n1.squaredNorm();
  if (!(size0 > 1e-24 * square * square) || !(size1 > 1e-24 * square * square))
    return false;
  const double length = std::sqrt(square);
  gradient[2] = -length / size0 * n0;
  gradient[3] = -length / size1 * n1;
  const double share_c = c.dot(along) / square, share_d = d.dot(along) / square;
  gradient[1] = -share_c * gradient[2] - share_d * gradient[3];
  gradient[0] = -(1 - share_c) * gradient[2] - (1 - share_d) * gradient[3];
  return true;
}

}  // namespace

EdgeRefinement::EdgeRefinement(const EdgeNetwork& network) : network_(network) {
  const uint32_t vertices = network.vertex_count;
  std::vector<std::pair<uint32_t, uint32_t>> pairs;  // column, row
  auto add_pair = [&](uint32_t i, uint32_t j) {
    pairs.emplace_back(std::min(i, j), std::max(i, j));
  };
  for (uint32_t v = 0; v < vertices; ++v)
    pairs.emplace_back(v, v);
  for (const FaceGraph::Edge& e : network.edges)
    add_pair(e.a, e.b);
  for (const Hinge& h : network.hinges) {
    for (uint32_t i : {h.a, h.b, h.c}) {
      for (uint32_t j : {h.b, h.c, h.d}) {
        if (i != j)
          add_pair(i, j);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_block_.assign(size_t{vertices} + 1, 0);
  for (auto [col, row] : pairs) {
    ++first_block_[col + 1];
    block_row_.push_back(row);
  }
  for (size_t v = 0; v < vertices; ++v)
    first_block_[v + 1] += first_block_[v];
  // Full 3 x 3 blocks, those on the diagonal too: the solver reads their lower triangles.
  matrix_.resize(3 * static_cast<Index>(vertices), 3 * static_cast<Index>(vertices));
  Eigen::VectorXi counts(matrix_.cols());
  for (uint32_t v = 0; v < vertices; ++v) {
    const auto size = static_cast<int>(3 * (first_block_[v + 1] - first_block_[v]));
    counts.segment<3>(3 * column(v)).setConstant(size);
  }
  matrix_.reserve(counts);
  for (uint32_t v = 0; v < vertices; ++v) {
    for (Index c = 3 * column(v); c < 3 * column(v) + 3; ++c) {
      for (uint32_t k = first_block_[v]; k < first_block_[v + 1]; ++k) {
        for (Index r = 0; r < 3; ++r)
          matrix_.insert(3 * column(block_row_[k]) + r, c) = 0;
      }
    }
  }
  matrix_.makeCompressed();
  solver_.analyzePattern(matrix_);
}

/// The first of three numbers of a block's first column; those of the next columns follow at the
/// length of a column.
double* EdgeRefinement::block(uint32_t row, uint32_t col) {
  const auto first = block_row_.begin() + first_block_[col];
  const auto at = std::lower_bound(first, block_row_.begin() + first_block_[col + 1], row);
  return matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * column(col)] + 3 * (at - first);
}

template <size_t kVertices>
void EdgeRefinement::add(const uint32_t (&vertices)[kVertices],
                         const Vector3d (&gradient)[kVertices], double residual, double weight,
                         VectorXd& right) {
  for (size_t i = 0; i < kVertices; ++i) {
    right.segment<3>(3 * column(vertices[i])) -= weight * residual * gradient[i];
    for (size_t j = 0; j < kVertices; ++j) {
      if (vertices[i] < vertices[j])
        continue;  // above the diagonal
      double* out = block(vertices[i], vertices[j]);
      const Index stride = 3 * (first_block_[vertices[j] + 1] - first_block_[vertices[j]]);
      for (Index c = 0; c < 3; ++c) {
        for (Index r = 0; r < 3; ++r)
          out[c * stride + r] += weight * gradient[i][r] * gradient[j][c];
      }
    }
  }
}

void EdgeRefinement::set_weights(const EdgeShape& target) {
  const VectorXd& l = target.lengths;
  const double least = 1e-9 * (l.size() > 0 ? l.mean() : 0);
  length_weights_ = (l.array() > least).select(l.array().max(least).square().inverse(), 0.0);
  // Area around each hinge, from the sides of its two triangles.
  VectorXd areas(static_cast<Index>(network_.triangle_edges.size() / 3));
  for (Index t = 0; t < areas.size(); ++t) {
    const uint32_t* e = &network_.triangle_edges[3 * static_cast<size_t>(t)];
    const bool degenerate = std::max({e[0], e[1], e[2]}) == kNoIndex;
    areas[t] = degenerate ? 0 : double_area(l[column(e[0])], l[column(e[1])], l[column(e[2])]) / 2;
  }
  angle_weights_.resize(static_cast<Index>(network_.hinges.size()));
  for (size_t h = 0; h < network_.hinges.size(); ++h) {
    const Hinge& hinge = network_.hinges[h];
    const double square = l[column(hinge.edge)] * l[column(hinge.edge)];
    const double c = areas[column(hinge.face_c)], d = areas[column(hinge.face_d)];
    // Slivers would outweigh everything else, and have no angle to speak of.
    angle_weights_[static_cast<Index>(h)] = std::min(c, d) > 1e-4 * square ? square / (c + d) : 0;
  }
}

double EdgeRefinement::energy(const EdgeShape& target, const Points& x) {
  set_weights(target);
  return weighted_energy(target, x);
}

double EdgeRefinement::weighted_energy(const EdgeShape& target, const Points& x) const {
  const EdgeShape shape = measure_edges(network_, x);
  double sum = (length_weights_.array() * (shape.lengths - target.lengths).array().square()).sum();
  for (Index h = 0; h < shape.angles.size(); ++h) {
    const double off = wrapped(shape.angles[h] - target.angles[h]);
    sum += angle_weights_[h] * off * off;
  }
  return sum;
}

void EdgeRefinement::assemble(const EdgeShape& target, const Points& x, VectorXd& right) {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
  right.setZero(matrix_.rows());
  for (size_t e = 0; e < network_.edges.size(); ++e) {
    const uint32_t ends[] = {network_.edges[e].a, network_.edges[e].b};
    const Vector3d along = x.col(column(ends[0])) - x.col(column(ends[1]));
    const double length = along.norm();
    const auto i = static_cast<Index>(e);
    if (!(length > 0) || length_weights_[i] == 0)
      continue;
    const Vector3d gradient[] = {along / length, -along / length};
    add(ends, gradient, length - target.lengths[i], length_weights_[i], right);
  }
  for (size_t h = 0; h < network_.hinges.size(); ++h) {
    const Hinge& hinge = network_.hinges[h];
    const auto i = static_cast<Index>(h);
    Vector3d gradient[4];
    if (angle_weights_[i] == 0 || !angle_gradient(x, hinge, gradient))
      continue;
    const uint32_t vertices[] = {hinge.a, hinge.b, hinge.c, hinge.d};
    const double off = wrapped(dihedral_angle(x, hinge) - target.angles[i]);
    add(vertices, gradient, off, angle_weights_[i], right);
  }
  const double damping = kDamping * matrix_.diagonal().mean();
  for (Index i = 0; i < matrix_.rows(); ++i)
    matrix_.coeffRef(i, i) += damping;
}

double EdgeRefinement::refine(const EdgeShape& target, int steps, Points& x) {
  double reached = energy(target, x);
  VectorXd right;
  for (int step = 0; step < steps && reached > 0; ++step) {
    assemble(target, x, right);
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success)
      break;
    const VectorXd move = solver_.solve(right);
    if (!move.allFinite())
      break;
    const Eigen::Map<const Points> moves(move.data(), 3, x.cols());
    bool lower = false;
    double share = 1;
    for (int k = 0; k < kHalvings && !lower; ++k, share /= 2) {
      Points moved = x + share * moves;
      const double then = weighted_energy(target, moved);
      if (then < reached) {
        lower = true;
        reached = then;
        x = std::move(moved);
      }
    }
    if (!lower)
      break;
  }
  return reached;
}

}  // namespace anicodec
