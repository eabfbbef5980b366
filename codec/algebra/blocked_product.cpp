// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/algebra/blocked_product.h"

#include "codec/parallel/parallel.h"
#include "format/compiler.h"
#include "sdk/base/cpu_features.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

using Eigen::Index;

constexpr Index kTile = 64, kStrip = 16;

using Tiles = std::vector<std::pair<Index, Index>>;

/// Sums over a depth: sums(i, j) += a(d, i) b(d, j). a lies in strips of kStrip numbers i for each d, b in columns.
struct TileProduct {
  const double* a;
  const double* b;
  double* sums;
  size_t a_stride;      ///< from a depth to the next
  size_t strip_stride;  ///< from a strip to the next
  size_t b_stride, sums_stride, depth, rows, columns;
};

/// Some columns by rows of Width x Groups numbers. Every entry is summed by itself in the order of the depth, so that
/// the width of registers changes no bit; contraction is off.
template <size_t Width, size_t Groups, size_t Columns>
[[gnu::always_inline]] inline void multiply(const TileProduct& p, size_t row, size_t column) {
  typedef double Lanes ANICODEC_LOOSE_VECTOR(sizeof(double) * Width, 8);
  Lanes sums[Groups][Columns] = {};
  const double* b = p.b + column * p.b_stride;
  const double* strip = p.a + row / kStrip * p.strip_stride + row % kStrip;
  for (size_t d = 0; d < p.depth; ++d) {
    const double* a = strip + d * p.a_stride;
#pragma GCC unroll 4  // sums stay in registers
    for (size_t j = 0; j < Columns; ++j) {
      const double factor = b[d + j * p.b_stride];
#pragma GCC unroll 2
      for (size_t g = 0; g < Groups; ++g)
        sums[g][j] += *reinterpret_cast<const Lanes*>(a + g * Width) * factor;
    }
  }
  const size_t rows = std::min(Width * Groups, p.rows - row);
  for (size_t j = 0; j < Columns; ++j) {
    double* to = p.sums + (column + j) * p.sums_stride + row;
    for (size_t i = 0; i < rows; ++i)
      to[i] += sums[i / Width][j][i % Width];
  }
}

template <size_t Width, size_t Groups>
[[gnu::always_inline]] inline void multiply_tile(const TileProduct& p) {
  constexpr size_t kColumns = 4;
  for (size_t row = 0; row < p.rows; row += Width * Groups) {
    size_t column = 0;
    for (; column + kColumns <= p.columns; column += kColumns)
      multiply<Width, Groups, kColumns>(p, row, column);
    for (; column < p.columns; ++column)
      multiply<Width, Groups, 1>(p, row, column);
  }
}

void multiply_by_2(const TileProduct& p) {
  multiply_tile<2, 2>(p);
}

// Eigen knows the registers of the machine that it is compiled for alone.
#if defined(__x86_64__)
[[gnu::target("avx2")]] void multiply_by_4(const TileProduct& p) {
  multiply_tile<4, 2>(p);
}

[[gnu::target("avx512f")]] void multiply_by_8(const TileProduct& p) {
  multiply_tile<8, 2>(p);
}
#endif

using Multiply = void (*)(const TileProduct&);

Multiply widest() {
#if defined(__x86_64__)
  if (cpu_features().avx512f)
    return multiply_by_8;
  if (cpu_features().avx2)
    return multiply_by_4;
#endif
  return multiply_by_2;
}

void run(const TileProduct& product) {
  static const Multiply multiply = widest();
  multiply(product);
}

/// Rows first .. first + depth - 1 of a in strips, zeros beyond the last column.
void pack(const MatrixView& a, Index first, Index depth, std::vector<double>& strips) {
  const Index count = (a.cols() + kStrip - 1) / kStrip;
  strips.resize(static_cast<size_t>(count * kStrip * depth));
  parallel_for(Index{0}, count, [&](Index s) {
    double* to = strips.data() + s * kStrip * depth;
    const Index columns = std::min(kStrip, a.cols() - s * kStrip);
    if (columns < kStrip)
      std::fill_n(to, kStrip * depth, 0.0);
    const double* from = a.col(s * kStrip).data() + first;
    for (Index k = 0; k < depth; ++k) {
      for (Index c = 0; c < columns; ++c)
        to[k * kStrip + c] = from[c * a.outerStride() + k];
    }
  });
}

void add_tiles(const MatrixView& a, const MatrixView& b, const Tiles& tiles,
               Eigen::MatrixXd& sums) {
  std::vector<double> strips;
  for (Index d = 0; d < a.rows(); d += kProductDepth) {
    const Index depth = std::min(kProductDepth, a.rows() - d);
    pack(a, d, depth, strips);
    parallel_for(size_t{0}, tiles.size(), [&](size_t t) {
      const auto [row, column] = tiles[t];
      TileProduct p;
      p.a = strips.data() + row * depth;
      p.b = b.col(column).data() + d;
      p.sums = &sums(row, column);
      p.a_stride = size_t{kStrip};
      p.strip_stride = static_cast<size_t>(kStrip * depth);
      p.b_stride = static_cast<size_t>(b.outerStride());
      p.sums_stride = static_cast<size_t>(sums.rows());
      p.depth = static_cast<size_t>(depth);
      p.rows = static_cast<size_t>(std::min(kTile, a.cols() - row));
      p.columns = static_cast<size_t>(std::min(kTile, b.cols() - column));
      run(p);
    });
  }
}

}  // namespace

Index panel_depth(Index columns) {
  return kProductDepth * std::clamp<Index>(2000 / std::max<Index>(columns, 1), 1, 8);
}

void add_products(const MatrixView& a, const MatrixView& b, Eigen::MatrixXd& sums) {
  Tiles tiles;
  for (Index column = 0; column < b.cols(); column += kTile) {
    for (Index row = 0; row < a.cols(); row += kTile) {
      tiles.emplace_back(row, column);
    }
  }
  add_tiles(a, b, tiles, sums);
}

void add_self_products(const MatrixView& a, Eigen::MatrixXd& sums) {
  Tiles tiles;
  for (Index column = 0; column < a.cols(); column += kTile) {
    for (Index row = 0; row <= column; row += kTile) {
      tiles.emplace_back(row, column);
    }
  }
  add_tiles(a, a, tiles, sums);
}

Eigen::MatrixXd product(const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  constexpr Index kRows = 32 * kStrip;
  parallel_for(Index{0}, (a.rows() + kRows - 1) / kRows, [&](Index t) {
    const Index first = t * kRows, rows = std::min(kRows, a.rows() - first);
    const Index whole = rows / kStrip * kStrip, rest = rows - whole;
    double last[kProductDepth * kStrip];  // rows that do not fill a strip
    if (rest > 0)
      std::fill(std::begin(last), std::end(last), 0.0);
    for (Index d = 0; d < a.cols(); d += kProductDepth) {
      TileProduct p;
      p.a = a.col(d).data() + first;
      p.b = b.data() + d;
      p.sums = sums.data() + first;
      p.a_stride = static_cast<size_t>(a.outerStride());
      p.strip_stride = size_t{kStrip};
      p.b_stride = static_cast<size_t>(b.outerStride());
      p.sums_stride = static_cast<size_t>(sums.rows());
      p.depth = static_cast<size_t>(std::min(kProductDepth, a.cols() - d));
      p.rows = static_cast<size_t>(whole);
      p.columns = static_cast<size_t>(b.cols());
      run(p);
      if (rest == 0)
        continue;
      for (size_t k = 0; k < p.depth; ++k)
        std::copy_n(p.a + k * p.a_stride + p.rows, rest, last + k * size_t{kStrip});
      p.a = last;
      p.a_stride = size_t{kStrip};
      p.sums += whole;
      p.rows = static_cast<size_t>(rest);
      run(p);
    }
  });
  return sums;
}

Eigen::MatrixXd inner_products(const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  add_products(a, b, sums);
  return sums;
}

void mirror_upper(Eigen::MatrixXd& sums) {
  sums.triangularView<Eigen::StrictlyLower>() = sums.transpose();
}

}  // namespace anicodec
