// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/keyframes/keyframe_weights.h"

#include <utility>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Squares below this part of the largest are rounding of the products.
constexpr double kGramTolerance = 1e-13;

// (x_i - x_0) . (x_j - x_0) for i, j >= 1.
MatrixXd relative_to_first(const MatrixXd& gram) {
  const Index reduced = gram.rows() - 1;
  MatrixXd result = gram.bottomRightCorner(reduced, reduced);
  result.colwise() -= gram.col(0).tail(reduced);
  result.rowwise() -= gram.row(0).tail(reduced);
  result.array() += gram(0, 0);
  return result;
}

MatrixXd with_noise(MatrixXd key_gram, double noise) {
  key_gram.diagonal().array() += noise;
  return key_gram;
}

}  // namespace

WeightSolver::WeightSolver(MatrixXd key_gram, WeightConstraint constraint, double noise)
    : key_gram_(with_noise(std::move(key_gram), noise)),
      constraint_(constraint),
      differences_(constraint == WeightConstraint::kSumToOne ? relative_to_first(key_gram_)
                                                             : MatrixXd()),
      factor_(constraint == WeightConstraint::kSumToOne ? differences_ : key_gram_,
              kGramTolerance * key_gram_.diagonal().maxCoeff(),
              static_cast<size_t>(key_gram_.rows())) {}

MatrixXd WeightSolver::solve(const MatrixXd& products) const {
  if (constraint_ == WeightConstraint::kNone) {
    return factor_.solve(products);
  }
  const Index reduced = key_gram_.rows() - 1;
  MatrixXd right = products.bottomRows(reduced);
  right.rowwise() -= products.row(0);
  right.colwise() -= key_gram_.col(0).tail(reduced);
  right.array() += key_gram_(0, 0);
  MatrixXd weights(reduced + 1, products.cols());
  weights.bottomRows(reduced) = factor_.solve(right);
  weights.row(0) = RowVectorXd::Ones(products.cols()) - weights.bottomRows(reduced).colwise().sum();
  return weights;
}

FrameWeights fit_weights(const MatrixXd& gram, std::span<const uint32_t> keyframes,
                         WeightConstraint constraint, double noise) {
  const WeightSolver solver(gram(keyframes, keyframes), constraint, noise);
  FrameWeights fit;
  fit.weights = solver.solve(gram(keyframes, Eigen::all)).transpose();
  for (size_t j = 0; j < keyframes.size(); j++) {
    fit.weights.row(keyframes[j]) = RowVectorXd::Unit(fit.weights.cols(), static_cast<Index>(j));
  }
  fit.squared_errors = squared_errors(gram, keyframes, fit.weights);
  return fit;
}

VectorXd squared_errors(const MatrixXd& gram, std::span<const uint32_t> keyframes,
                        const MatrixXd& weights) {
  const MatrixXd products = gram(Eigen::all, keyframes);
  const MatrixXd combined = weights * products(keyframes, Eigen::all);
  VectorXd errors = gram.diagonal() - 2 * products.cwiseProduct(weights).rowwise().sum() +
                    combined.cwiseProduct(weights).rowwise().sum();
  return errors.cwiseMax(0);
}

}  // namespace anicodec
