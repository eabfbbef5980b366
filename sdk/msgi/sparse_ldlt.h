// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MSGI_SPARSE_LDLT_H_
#define ANICODEC_SDK_MSGI_SPARSE_LDLT_H_

#include "format/memory.h"
#include "format/status.h"
#include "sdk/base/parallel_for.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The factor L D L^T of a weighted graph Laplacian from which some vertices have been taken out,
/// and systems of three right-hand sides solved by it. The order of elimination is given from
/// outside as groups, by nested dissection; the columns of a group are stored as one dense block
/// (supernodal, factored by fronts: Duff and Reid 1983; Liu 1992).
class SparseLdlt {
 public:
  /// Weight of the edge between two vertices, above 0.
  struct Edge {
    uint32_t a, b;
    double weight;
  };

  static constexpr uint32_t kFixed = UINT32_MAX;

  /// Factors sum over edges of weight (e_a - e_b)(e_a - e_b)^T over the vertices whose group is not
  /// kFixed; lower groups are eliminated first. Every connected part of them must have an edge to a
  /// vertex that is fixed. Errors: kLimit when factor or fronts would take more than most_bytes,
  /// found before any of it is allocated; kNonFinite when a pivot is not above 0. Cost: that of the
  /// factor, about n log n numbers and n^1.5 multiplications for a surface of n vertices.
  Status init(const Vector<uint32_t>& vertex_group, const Vector<Edge>& edges, size_t most_bytes);

  /// Number of unknowns.
  uint32_t size() const { return static_cast<uint32_t>(vertices_.size()); }

  /// Unknown i is vertex vertices()[i].
  const Vector<uint32_t>& vertices() const { return vertices_; }

  size_t resident_bytes() const;

  /// The least most_bytes for which init() does not end in kLimit.
  size_t setup_bytes() const { return setup_bytes_; }

  /// Elements of the array that solve() works in, for three right-hand sides.
  size_t scratch_size() const { return kLanes * size_t{scratch_rows_}; }

  static constexpr size_t kLanes = 4;  ///< doubles per unknown: three right-hand sides and a zero

  /// Replaces right-hand sides by solutions: unknown i is x[4 i .. 4 i + 2], x[4 i + 3] is 0. x has
  /// scratch_size() elements. Subtrees are solved in parallel; the bits do not depend on the number
  /// of threads. Reads the factor twice.
  void solve(double* x, const HostThreads& threads) const;

 private:
  /// Columns eliminated together: a dense lower triangle and the rows below it.
  struct Block {
    uint32_t first_column = 0, columns = 0;
    uint32_t first_row = 0, rows = 0;  ///< in rows_
    size_t first_value = 0;
    uint32_t parent = kFixed;
  };

  struct Graph;

  /// Blocks that can be solved without looking at other subtrees, if what they add to the blocks
  /// above, `spill_rows` rows, is kept apart until all subtrees are done.
  struct Subtree {
    uint32_t first_spill = 0, spill_rows = 0;  ///< place in the scratch array
    uint32_t root = 0;
    Vector<uint32_t> blocks;
  };

  void number(const Vector<uint32_t>& vertex_group);
  Graph make_graph(const Vector<Edge>& edges, size_t vertex_count) const;
  Status analyse(const Graph& graph, size_t most_bytes);
  Status factor(const Graph& graph);
  void split();
  void forward(const Block& block, double* x) const;
  void backward(const Block& block, double* x) const;

  Vector<uint32_t> vertices_;
  Vector<Block> blocks_;           ///< in order of elimination
  Vector<uint32_t> rows_;          ///< unknowns
  Vector<uint32_t> forward_rows_;  ///< the same, or places where a subtree keeps them apart
  Vector<double> values_;  ///< per block: rows of the unit triangle without diagonal, then rows_
  Vector<double> inverse_diagonal_;
  Vector<Subtree> subtrees_;
  Vector<uint32_t> top_;  ///< blocks above all subtrees
  uint32_t scratch_rows_ = 0;
  size_t setup_bytes_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MSGI_SPARSE_LDLT_H_
