// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/sparse_ldlt.h"

#include "format/sort.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace anicodec {
namespace {

/// A part of the factor small enough to be one task, as a share of the whole.
constexpr size_t kSubtreeShare = 24;

/// Eliminates the first `columns` unknowns of a dense front. panel[c] holds column c from the
/// diagonal down to row `size`-1, at panel + c * size; rest is the lower triangle of what remains,
/// row-major, rows x rows. On return panel is L with D on its diagonal. False for a bad pivot.
bool eliminate(double* panel, size_t columns, double* rest, size_t size, double* scaled) {
  for (size_t c = 0; c < columns; ++c) {
    double* column = panel + c * size;
    double pivot = column[c];
    if (!(pivot > 0))
      return false;
    double inverse = 1 / pivot;
    for (size_t d = c + 1; d < columns; ++d) {
      double factor = column[d] * inverse;
      if (factor == 0)
        continue;
      double* other = panel + d * size;
      for (size_t r = d; r < size; ++r)
        other[r] -= factor * column[r];
    }
    // The remaining columns take their share of the column before it is divided by the pivot.
    std::copy(column + columns, column + size, scaled + c * (size - columns));
    for (size_t r = c + 1; r < size; ++r)
      column[r] *= inverse;
  }
  const size_t rows = size - columns;
  size_t c = 0;
  for (; c + 4 <= columns; c += 4) {
    const double *l0 = panel + c * size + columns, *l1 = l0 + size, *l2 = l1 + size,
                 *l3 = l2 + size;
    const double* s = scaled + c * rows;
    for (size_t i = 0; i < rows; ++i) {
      double a0 = s[i], a1 = s[rows + i], a2 = s[2 * rows + i], a3 = s[3 * rows + i];
      double* out = rest + i * rows;
      for (size_t j = 0; j <= i; ++j)
        out[j] -= (a0 * l0[j] + a1 * l1[j]) + (a2 * l2[j] + a3 * l3[j]);
    }
  }
  for (; c < columns; ++c) {
    const double* l = panel + c * size + columns;
    const double* s = scaled + c * rows;
    for (size_t i = 0; i < rows; ++i) {
      double a = s[i];
      double* out = rest + i * rows;
      for (size_t j = 0; j <= i; ++j)
        out[j] -= a * l[j];
    }
  }
  return true;
}

}  // namespace

struct SparseLdlt::Graph {
  Vector<uint32_t> begin, neighbours;  ///< of each unknown: other unknowns
  Vector<double> weights;
  Vector<double> diagonal;
};

void SparseLdlt::number(const Vector<uint32_t>& vertex_group) {
  vertices_.clear();
  for (uint32_t v = 0; v < vertex_group.size(); ++v) {
    if (vertex_group[v] != kFixed)
      vertices_.push_back(v);
  }
  sort_ascending(vertices_.begin(), vertices_.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(vertex_group[a], a) < std::pair(vertex_group[b], b);
  });
  blocks_.clear();
  for (uint32_t i = 0; i < size(); ++i) {
    if (i == 0 || vertex_group[vertices_[i]] != vertex_group[vertices_[i - 1]]) {
      blocks_.emplace_back();
      blocks_.back().first_column = i;
    }
    ++blocks_.back().columns;
  }
}

SparseLdlt::Graph SparseLdlt::make_graph(const Vector<Edge>& edges, size_t vertex_count) const {
  Vector<uint32_t> unknown(vertex_count, kFixed);
  for (uint32_t i = 0; i < size(); ++i)
    unknown[vertices_[i]] = i;
  Graph graph;
  graph.diagonal.assign(size(), 0);
  graph.begin.assign(size_t{size()} + 1, 0);
  for (const Edge& e : edges) {
    uint32_t a = unknown[e.a], b = unknown[e.b];
    for (uint32_t end : {a, b}) {
      if (end != kFixed)
        graph.diagonal[end] += e.weight;
    }
    if (a != kFixed && b != kFixed) {
      ++graph.begin[a + 1];
      ++graph.begin[b + 1];
    }
  }
  std::partial_sum(graph.begin.begin(), graph.begin.end(), graph.begin.begin());
  graph.neighbours.resize(graph.begin.back());
  graph.weights.resize(graph.begin.back());
  Vector<uint32_t> at(graph.begin.begin(), graph.begin.end() - 1);
  for (const Edge& e : edges) {
    uint32_t a = unknown[e.a], b = unknown[e.b];
    if (a == kFixed || b == kFixed)
      continue;
    graph.neighbours[at[a]] = b;
    graph.weights[at[a]++] = e.weight;
    graph.neighbours[at[b]] = a;
    graph.weights[at[b]++] = e.weight;
  }
  return graph;
}

Status SparseLdlt::analyse(const Graph& graph, size_t most_bytes) {
  // The rows of a block: neighbours of its columns and the rows of the blocks whose first row it
  // holds, as far as they come later.
  Vector<uint32_t> block_of(size()), mark(size(), kFixed);
  Vector<uint32_t> first_child(blocks_.size(), kFixed), sibling(blocks_.size(), kFixed);
  for (uint32_t b = 0; b < blocks_.size(); ++b) {
    std::fill_n(block_of.data() + blocks_[b].first_column, blocks_[b].columns, b);
  }
  rows_.clear();
  size_t values = 0;
  size_t largest_front = 0;
  setup_bytes_ = 0;
  for (uint32_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    uint32_t end = block.first_column + block.columns;
    block.first_row = static_cast<uint32_t>(rows_.size());
    auto add = [&](uint32_t row) {
      if (row >= end && mark[row] != b) {
        mark[row] = b;
        rows_.push_back(row);
      }
    };
    for (uint32_t k = graph.begin[block.first_column]; k < graph.begin[end]; ++k)
      add(graph.neighbours[k]);
    for (uint32_t child = first_child[b]; child != kFixed; child = sibling[child]) {
      const Block& c = blocks_[child];
      for (uint32_t k = c.first_row; k < c.first_row + c.rows; ++k)
        add(rows_[k]);
    }
    block.rows = static_cast<uint32_t>(rows_.size()) - block.first_row;
    sort_ascending(rows_.data() + block.first_row, rows_.data() + rows_.size());
    block.first_value = values;
    values += size_t{block.columns} * (block.columns - 1) / 2 + size_t{block.columns} * block.rows;
    size_t front = size_t{block.columns} + block.rows;
    largest_front = std::max(largest_front, front * front);
    if (block.rows > 0) {
      block.parent = block_of[rows_[block.first_row]];
      sibling[b] = first_child[block.parent];
      first_child[block.parent] = b;
    }
    setup_bytes_ = std::max(setup_bytes_, sizeof(double) * (values + 2 * largest_front) +
                                              2 * sizeof(uint32_t) * rows_.size());
    if (setup_bytes_ > most_bytes || rows_.size() >= UINT32_MAX - size())
      return Status::kLimit;
  }
  values_.resize(values);
  return Status::kOk;
}

Status SparseLdlt::factor(const Graph& graph) {
  Vector<Vector<double>> rests(blocks_.size());
  Vector<uint32_t> first_child(blocks_.size(), kFixed), sibling(blocks_.size(), kFixed);
  Vector<uint32_t> place(size());  // of an unknown in the front
  Vector<double> panel, scaled;
  inverse_diagonal_.resize(size());
  for (uint32_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const size_t columns = block.columns, rows = block.rows, front = columns + rows;
    const uint32_t* row = rows_.data() + block.first_row;
    uint32_t* const first = place.data() + block.first_column;
    std::iota(first, first + block.columns, 0U);
    for (uint32_t r = 0; r < rows; ++r)
      place[row[r]] = block.columns + r;
    panel.assign(columns * front, 0);
    Vector<double>& rest = rests[b];
    rest.assign(rows * rows, 0);
    for (size_t c = 0; c < columns; ++c) {
      uint32_t unknown = block.first_column + static_cast<uint32_t>(c);
      panel[c * front + c] += graph.diagonal[unknown];
      for (uint32_t k = graph.begin[unknown]; k < graph.begin[unknown + 1]; ++k) {
        if (graph.neighbours[k] > unknown)
          panel[c * front + place[graph.neighbours[k]]] -= graph.weights[k];
      }
    }
    for (uint32_t child = first_child[b]; child != kFixed; child = sibling[child]) {
      const uint32_t* child_row = rows_.data() + blocks_[child].first_row;
      const size_t child_rows = blocks_[child].rows;
      const double* from = rests[child].data();
      for (size_t i = 0; i < child_rows; ++i, from += child_rows) {
        size_t pi = place[child_row[i]];
        for (size_t j = 0; j <= i; ++j) {
          size_t pj = place[child_row[j]];
          if (pj < columns)
            panel[pj * front + pi] += from[j];
          else
            rest[(pi - columns) * rows + pj - columns] += from[j];
        }
      }
      Vector<double>().swap(rests[child]);
    }
    scaled.resize(columns * rows);
    if (!eliminate(panel.data(), columns, rest.data(), front, scaled.data()))
      return Status::kNonFinite;
    double* value = values_.data() + block.first_value;
    for (size_t r = 1; r < front; ++r) {
      for (size_t c = 0; c < std::min(r, columns); ++c)
        *value++ = panel[c * front + r];
    }
    for (size_t c = 0; c < columns; ++c)
      inverse_diagonal_[block.first_column + c] = 1 / panel[c * front + c];
    if (block.parent != kFixed) {
      sibling[b] = first_child[block.parent];
      first_child[block.parent] = b;
    }
  }
  return Status::kOk;
}

/// Cuts the tree of blocks into subtrees of about equal cost and the blocks above them.
void SparseLdlt::split() {
  Vector<size_t> cost(blocks_.size());
  size_t total = 0;
  for (size_t b = 0; b < blocks_.size(); ++b) {
    size_t own = size_t{blocks_[b].columns} * (blocks_[b].columns + blocks_[b].rows);
    total += own;
    cost[b] += own;
    if (blocks_[b].parent != kFixed)
      cost[blocks_[b].parent] += cost[b];
  }
  Vector<uint32_t> subtree(blocks_.size(), kFixed);
  subtrees_.clear();
  top_.clear();
  // Small trees that nothing stands above, those of small components, share a subtree.
  uint32_t shared = kFixed;
  size_t shared_cost = 0;
  for (uint32_t b = static_cast<uint32_t>(blocks_.size()); b-- > 0;) {
    const Block& block = blocks_[b];
    if (block.parent != kFixed && subtree[block.parent] != kFixed) {
      subtree[b] = subtree[block.parent];
      continue;
    }
    if (cost[b] > total / kSubtreeShare)
      continue;
    bool share = block.parent == kFixed;
    if (share && shared != kFixed && shared_cost + cost[b] <= total / kSubtreeShare) {
      subtree[b] = shared;
      shared_cost += cost[b];
      continue;
    }
    subtree[b] = static_cast<uint32_t>(subtrees_.size());
    subtrees_.emplace_back();
    subtrees_.back().root = b;
    if (share) {
      shared = subtree[b];
      shared_cost = cost[b];
    }
  }
  for (uint32_t b = 0; b < blocks_.size(); ++b)
    (subtree[b] == kFixed ? top_ : subtrees_[subtree[b]].blocks).push_back(b);
  forward_rows_.assign(rows_.begin(), rows_.end());
  scratch_rows_ = size();
  for (Subtree& s : subtrees_) {
    const Block& root = blocks_[s.root];
    const uint32_t* above = rows_.data() + root.first_row;
    s.first_spill = scratch_rows_;
    s.spill_rows = root.rows;
    scratch_rows_ += root.rows;
    if (root.rows == 0)
      continue;
    for (uint32_t b : s.blocks) {
      for (uint32_t k = blocks_[b].first_row; k < blocks_[b].first_row + blocks_[b].rows; ++k) {
        if (rows_[k] >= root.first_column + root.columns) {
          auto at = std::lower_bound(above, above + root.rows, rows_[k]) - above;
          forward_rows_[k] = s.first_spill + static_cast<uint32_t>(at);
        }
      }
    }
  }
}

Status SparseLdlt::init(const Vector<uint32_t>& vertex_group, const Vector<Edge>& edges,
                        size_t most_bytes) {
  number(vertex_group);
  Graph graph = make_graph(edges, vertex_group.size());
  if (Status s = analyse(graph, most_bytes); s != Status::kOk)
    return s;
  if (Status s = factor(graph); s != Status::kOk)
    return s;
  split();
  vertices_.shrink_to_fit();
  blocks_.shrink_to_fit();
  rows_.shrink_to_fit();
  subtrees_.shrink_to_fit();
  top_.shrink_to_fit();
  for (Subtree& s : subtrees_)
    s.blocks.shrink_to_fit();
  return Status::kOk;
}

size_t SparseLdlt::resident_bytes() const {
  return sizeof(double) * (values_.size() + inverse_diagonal_.size()) +
         sizeof(uint32_t) * (2 * rows_.size() + vertices_.size() + blocks_.size()) +
         sizeof(Block) * blocks_.size() + sizeof(Subtree) * subtrees_.size();
}

void SparseLdlt::forward(const Block& block, double* x) const {
  const double* value = values_.data() + block.first_value;
  double* own = x + kLanes * block.first_column;
  const uint32_t* row = forward_rows_.data() + block.first_row;
  const size_t columns = block.columns;
  for (size_t r = 1; r < columns + block.rows; ++r) {
    const size_t count = std::min(r, columns);
    double* out = r < columns ? own + kLanes * r : x + kLanes * row[r - columns];
    double sum[kLanes] = {}, sum2[kLanes] = {};
    size_t c = 0;
    for (; c + 2 <= count; c += 2) {
      for (size_t k = 0; k < kLanes; ++k) {
        sum[k] += value[c] * own[kLanes * c + k];
        sum2[k] += value[c + 1] * own[kLanes * (c + 1) + k];
      }
    }
    if (c < count) {
      for (size_t k = 0; k < kLanes; ++k)
        sum[k] += value[c] * own[kLanes * c + k];
    }
    for (size_t k = 0; k < kLanes; ++k)
      out[k] -= sum[k] + sum2[k];
    value += count;
  }
}

void SparseLdlt::backward(const Block& block, double* x) const {
  const size_t columns = block.columns;
  const double* value =
      values_.data() + block.first_value + columns * (columns - 1) / 2 + columns * block.rows;
  double* own = x + kLanes * block.first_column;
  const uint32_t* row = rows_.data() + block.first_row;
  for (size_t c = 0; c < columns; ++c) {
    for (size_t k = 0; k < kLanes; ++k)
      own[kLanes * c + k] *= inverse_diagonal_[block.first_column + c];
  }
  for (size_t r = columns + block.rows; r-- > 1;) {
    const size_t count = std::min(r, columns);
    value -= count;
    const double* from = r < columns ? own + kLanes * r : x + kLanes * row[r - columns];
    double known[kLanes];
    std::copy(from, from + kLanes, known);
    for (size_t c = 0; c < count; ++c) {
      for (size_t k = 0; k < kLanes; ++k)
        own[kLanes * c + k] -= value[c] * known[k];
    }
  }
}

void SparseLdlt::solve(double* x, const HostThreads& threads) const {
  std::fill(x + kLanes * size(), x + scratch_size(), 0.0);
  for_ranges(threads, subtrees_.size(), 1, [&](size_t first, size_t last) {
    for (size_t s = first; s < last; ++s) {
      for (uint32_t b : subtrees_[s].blocks)
        forward(blocks_[b], x);
    }
  });
  for (const Subtree& s : subtrees_) {
    const uint32_t* above = rows_.data() + blocks_[s.root].first_row;
    for (uint32_t r = 0; r < s.spill_rows; ++r) {
      for (size_t k = 0; k < kLanes; ++k)
        x[kLanes * above[r] + k] += x[kLanes * (s.first_spill + r) + k];
    }
  }
  for (uint32_t b : top_)
    forward(blocks_[b], x);
  for (size_t i = top_.size(); i-- > 0;)
    backward(blocks_[top_[i]], x);
  for_ranges(threads, subtrees_.size(), 1, [&](size_t first, size_t last) {
    for (size_t s = first; s < last; ++s) {
      const Vector<uint32_t>& blocks = subtrees_[s].blocks;
      for (size_t i = blocks.size(); i-- > 0;)
        backward(blocks_[blocks[i]], x);
    }
  });
}

}  // namespace anicodec
