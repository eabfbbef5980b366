// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/blocked_product.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr Index kTile = 64;

using Tiles = std::vector<std::pair<Index, Index>>;

void add_tiles(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Tiles& tiles,
               Eigen::MatrixXd& sums) {
  tbb::parallel_for(size_t{0}, tiles.size(), [&](size_t t) {
    const auto [row, column] = tiles[t];
    const Index rows = std::min(kTile, a.cols() - row);
    const Index columns = std::min(kTile, b.cols() - column);
    auto sum = sums.block(row, column, rows, columns);
    for (Index d = 0; d < a.rows(); d += kProductDepth) {
      const Index depth = std::min(kProductDepth, a.rows() - d);
      sum.noalias() +=
          a.block(d, row, depth, rows).transpose() * b.block(d, column, depth, columns);
    }
  });
}

}  // namespace

Index panel_depth(Index columns) {
  return kProductDepth * std::clamp<Index>(2000 / std::max<Index>(columns, 1), 1, 8);
}

void add_products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& sums) {
  Tiles tiles;
  for (Index column = 0; column < b.cols(); column += kTile) {
    for (Index row = 0; row < a.cols(); row += kTile) {
      tiles.emplace_back(row, column);
    }
  }
  add_tiles(a, b, tiles, sums);
}

void add_self_products(const Eigen::MatrixXd& a, Eigen::MatrixXd& sums) {
  Tiles tiles;
  for (Index column = 0; column < a.cols(); column += kTile) {
    for (Index row = 0; row <= column; row += kTile) {
      tiles.emplace_back(row, column);
    }
  }
  add_tiles(a, a, tiles, sums);
}

void mirror_upper(Eigen::MatrixXd& sums) {
  sums.triangularView<Eigen::StrictlyLower>() = sums.transpose();
}

}  // namespace anicodec
