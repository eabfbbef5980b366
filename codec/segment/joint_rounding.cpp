// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/joint_rounding.h"

#include "codec/segment/coefficient_costs.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/Core>

namespace anicodec {
namespace {

// Entries of a column that are left out: docs/research/rate.md.
constexpr float kNegligible = 0.08F;
constexpr int kSweeps = 4;  // over all vertices, in turns from either end

/// What to add to a residual q: 0, a step either way, or what makes it 0, whichever lowers the error
/// and `lambda` times its bits most. `slope`: the product of its column and the error; `energy`: that
/// of the column and itself.
int32_t best_change(int32_t q, float slope, float energy, const ResidualCosts& costs,
                    float lambda) {
  // Nothing below moves a zero: half a step would have to be won.
  if (q == 0 && std::abs(slope) < 0.35F * energy)
    return 0;
  const float now = bits_of(costs, q);
  float least = -1e-6F;
  int32_t best = 0;
  for (const int32_t change : {-1, 1, -q}) {
    const auto d = static_cast<float>(change);
    const float cost = d * (d * energy - 2 * slope) + lambda * (bits_of(costs, q + change) - now);
    if (change != 0 && cost < least) {
      least = cost;
      best = change;
    }
  }
  return best;
}

/// The product of a sparse column and a vector.
template <class Entry, class Value>
Value product(std::span<const Entry> column, const std::vector<Value>& vector) {
  const auto term = [&](size_t e) -> Value { return column[e].value * vector[column[e].rank]; };
  Value sum0 = Value::Zero(), sum1 = Value::Zero(), sum2 = Value::Zero(), sum3 = Value::Zero();
  size_t e = 0;
  for (; e + 4 <= column.size(); e += 4) {  // additions that do not wait for one another
    sum0 += term(e);
    sum1 += term(e + 1);
    sum2 += term(e + 2);
    sum3 += term(e + 3);
  }
  for (; e < column.size(); ++e)
    sum0 += term(e);
  return (sum0 + sum1) + (sum2 + sum3);
}

}  // namespace

/// A sum of sparse rows, which costs what they have.
class JointRounding::SparseSum {
 public:
  explicit SparseSum(size_t columns) : values_(columns, 0.0F) {}

  /// Adds entries times a factor.
  void add(const Entry* entry, const Entry* end, float factor) {
    const size_t most = count_ + static_cast<size_t>(end - entry) + 1;
    if (met_.size() < most)
      met_.resize(2 * most);
    float* const values = values_.data();
    uint32_t* met = met_.data() + count_;
    for (; entry < end; ++entry) {
      const uint32_t r = entry->rank;
      *met = r;  // without a branch, which would be guessed wrong
      met += values[r] == 0;
      values[r] += factor * entry->value;
    }
    count_ = static_cast<size_t>(met - met_.data());
  }

  /// Calls f(rank, value) for what has been added to, and begins anew. Where sums came to 0 on the way,
  /// also f(rank, 0).
  template <class F>
  void take(const F& f) {
    for (size_t k = 0; k < count_; ++k) {
      const uint32_t r = met_[k];
      f(r, values_[r]);
      values_[r] = 0;
    }
    count_ = 0;
  }

 private:
  std::vector<float> values_;
  std::vector<uint32_t> met_;  ///< ranks, and room for one more
  size_t count_ = 0;
};

void JointRounding::set_weights(std::vector<float> weights) {
  weights_ = std::move(weights);
  const auto m = static_cast<size_t>(order_.neighbour_count);
  const size_t n = order_.vertex_count();
  // Rows: that of a vertex is the sum of its neighbours' by their weights, and 1 at itself.
  std::vector<size_t> row_start{0};
  std::vector<Entry> rows;
  row_start.reserve(n + 1);
  SparseSum sum(n);
  std::vector<size_t> count(n + 1, 0);
  for (size_t i = 0; i < n; ++i) {
    for (size_t a = 0; a < m; ++a) {
      const int32_t b = order_.neighbours[i * m + a];
      if (b < 0)
        break;
      sum.add(rows.data() + row_start[static_cast<size_t>(b)],
              rows.data() + row_start[static_cast<size_t>(b) + 1], weights_[i * m + a]);
    }
    sum.take([&](uint32_t rank, float value) {
      if (std::abs(value) > kNegligible) {
        rows.push_back({rank, value});
        ++count[rank + 1];
      }
    });
    rows.push_back({static_cast<uint32_t>(i), 1.0F});
    ++count[i + 1];
    row_start.push_back(rows.size());
  }
  for (size_t i = 0; i < n; ++i)
    count[i + 1] += count[i];
  start_ = count;
  column_.resize(rows.size());
  energy_.assign(n, 0.0F);
  for (size_t i = 0; i < n; ++i)
    for (size_t e = row_start[i]; e < row_start[i + 1]; ++e) {
      column_[count[rows[e].rank]++] = {static_cast<uint32_t>(i), rows[e].value};
      energy_[rows[e].rank] += rows[e].value * rows[e].value;
    }
}

void JointRounding::improve(uint32_t channels, const float* target, const ResidualCosts* costs,
                            double price, int32_t* q) const {
  if (channels == 1)
    improve<1>(target, costs, price, q);
  else
    improve<3>(target, costs, price, q);
}

template <Eigen::Index kChannels>
void JointRounding::improve(const float* target, const ResidualCosts* costs, double price,
                            int32_t* q) const {
  // The channels of a rank are beside one another, so that a column is read once for all.
  using Channels = Eigen::Array<float, kChannels == 1 ? 1 : 4, 1>;
  const size_t n = order_.vertex_count();
  const auto m = static_cast<size_t>(order_.neighbour_count);
  const auto at = [n](Eigen::Index c, size_t i) { return static_cast<size_t>(c) * n + i; };
  std::vector<Channels> y(n, Channels::Zero()), error(n, Channels::Zero());
  for (size_t i = 0; i < n; ++i) {
    for (size_t a = 0; a < m && order_.neighbours[i * m + a] >= 0; ++a)
      y[i] += weights_[i * m + a] * y[static_cast<size_t>(order_.neighbours[i * m + a])];
    for (Eigen::Index c = 0; c < kChannels; ++c) {
      y[i](c) += static_cast<float>(q[at(c, i)]);
      error[i](c) = target[at(c, i)] - y[i](c);
    }
  }
  const auto lambda = static_cast<float>(price);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool changes = false;
    for (size_t k = 0; k < n; ++k) {
      const size_t i = sweep % 2 == 0 ? n - 1 - k : k;
      const std::span<const Entry> column(column_.data() + start_[i], start_[i + 1] - start_[i]);
      const Channels slope = product(column, error);
      Channels step = Channels::Zero();
      for (Eigen::Index c = 0; c < kChannels; ++c) {
        int32_t& residual = q[at(c, i)];
        const int32_t change =
            best_change(residual, slope(c), energy_[i], costs[at(c, i)], lambda);
        step(c) = static_cast<float>(change);
        residual += change;
      }
      if ((step == 0).all())
        continue;
      for (const Entry& entry : column)
        error[entry.rank] -= step * entry.value;
      changes = true;
    }
    if (!changes)
      break;
  }
}

}  // namespace anicodec
