// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/basis_fit.h"

#include "codec/algebra/blocked_product.h"
#include "codec/algebra/symmetric_solve.h"
#include "codec/algebra/trajectory_gram.h"
#include "sdk/segment/affine_functions.h"

#include <algorithm>
#include <utility>

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

/// products (fields' gram)^-1, for products with as many columns as there are fields.
MatrixXd solved(const MatrixXd& fields, const MatrixXd& products) {
  MatrixXd gram = MatrixXd::Zero(fields.cols(), fields.cols());
  add_self_products(fields, gram);
  mirror_upper(gram);
  // By the size of each field: one may be millions of times as large as another.
  constexpr double kRidge = 1e-12;
  const double least = 1e-24 * gram.trace() + 1e-300;
  gram.diagonal().array() += kRidge * gram.diagonal().array().max(least);
  return solve_symmetric(gram, MatrixXd(products.transpose())).transpose();
}

}  // namespace

BasisFit::BasisFit(const FrameView& clip, const LinearBasis& basis, size_t components)
    : clip_(clip), basis_(basis), count_(components) {}

void BasisFit::set_pose(const Vector<int32_t>& points, const Eigen::Vector3d& origin, double step) {
  origin_ = origin;
  if (basis_.base == Base::kAffine) {
    functions_ = function_values(points);
    return;
  }
  still_.resize(static_cast<Index>(clip_.vertex_count), 3);
  for (Index i = 0; i < still_.size(); ++i)
    still_(i / 3, i % 3) = points[static_cast<size_t>(i)] * step;
}

TimeWeights BasisFit::exact_weights() const {
  return {
      basis_.base == Base::kAffine ? project_on_functions(clip_, origin_, functions_) : MatrixXd(),
      basis_.time.leftCols(static_cast<Index>(count_))};
}

Coefficients BasisFit::targets(double step) const {
  const MatrixXd& u = decoded_.components;
  const Index k = u.cols();
  if (k == 0)
    return Coefficients(static_cast<Index>(clip_.vertex_count), 0);
  MatrixXd normal = u.transpose() * u;
  normal.diagonal().array() += 1e-9 * std::max(normal.trace() / static_cast<double>(k), 1e-30);
  const MatrixXd solved =  // rows of the clip x k
      solve_symmetric(normal, MatrixXd(u.transpose())).transpose();
  bool shapes = basis_.kind == BasisKind::kEigenshapes;
  Index channels = traits_of(basis_.kind).channels;
  Coefficients y(static_cast<Index>(clip_.vertex_count), k * channels);
  // The base's share of each component: per axis and function, or the pose times a sum.
  MatrixXd base(Index{kAffineFunctions}, k * channels);
  if (basis_.base == Base::kAffine) {
    for (Index j = 0; j < k; ++j) {
      for (Index c = 0; c < channels; ++c) {
        VectorXd sum = VectorXd::Zero(Index{kAffineFunctions});
        for (Index r = 0; r < solved.rows(); ++r)
          sum += solved(r, j) * decoded_.base.row(shapes ? 3 * r + c : r).transpose();
        base.col(j * channels + c) = sum;
      }
    }
  }
  VectorXd sums = solved.colwise().sum().transpose();
  combine_rows(clip_, origin_, solved, [&](size_t first, const MatrixXd& block) {
    for (Index i = 0; i < block.rows(); ++i) {
      Index v = static_cast<Index>(first) + i / channels, c = i % channels;
      for (Index j = 0; j < k; ++j) {
        double value = block(i, j);
        value -= basis_.base == Base::kAffine ? functions_.row(v).dot(base.col(j * channels + c))
                                              : still_(v, c) * sums[j];
        y(v, j * channels + c) = static_cast<float>(value / step);
      }
    }
  });
  return y;
}

TimeWeights BasisFit::refitted(const Coefficients& decoded, double step) const {
  const auto k = static_cast<Index>(count_);
  if (basis_.kind == BasisKind::kEigenshapes) {
    const MatrixXd fields = fields_of(decoded, step);
    MatrixXd products = project_on_fields(clip_, origin_, fields);
    products -= products_of_base(fields);
    return {exact_weights().base, solved(fields, products)};
  }
  // The base is fitted with the components: their functions are no longer at right angles.
  MatrixXd functions(static_cast<Index>(clip_.vertex_count), functions_.cols() + k);
  functions << functions_, decoded.cast<double>() * step;
  const MatrixXd all = solved(functions, project_on_functions(clip_, origin_, functions));
  return {all.leftCols(functions_.cols()), all.rightCols(k)};
}

/// Decoded shapes in scene units, a column each: row 3v + c is coordinate c of vertex v.
MatrixXd BasisFit::fields_of(const Coefficients& decoded, double step) const {
  MatrixXd fields(3 * decoded.rows(), static_cast<Index>(count_));
  for (Index v = 0; v < decoded.rows(); ++v)
    for (Index j = 0; j < fields.cols(); ++j)
      for (Index c = 0; c < 3; ++c)
        fields(3 * v + c, j) = static_cast<double>(decoded(v, 3 * j + c)) * step;
  return fields;
}

/// The decoded base of every frame times the shapes: frames x components.
MatrixXd BasisFit::products_of_base(const MatrixXd& fields) const {
  const auto frames = static_cast<Index>(clip_.frame_count);
  MatrixXd products = MatrixXd::Zero(frames, fields.cols());
  for (Index c = 0; c < 3; ++c) {
    const auto rows = Eigen::seqN(c, still_.rows() + functions_.rows(), 3);
    const MatrixXd of_axis = fields(rows, Eigen::all);
    if (basis_.base != Base::kAffine) {
      products.rowwise() += (still_.col(c).transpose() * of_axis).row(0);
      continue;
    }
    const MatrixXd by_function = functions_.transpose() * of_axis;
    const MatrixXd of_frames = decoded_.base(Eigen::seqN(c, frames, 3), Eigen::all);
    products += of_frames * by_function;
  }
  return products;
}

}  // namespace anicodec
