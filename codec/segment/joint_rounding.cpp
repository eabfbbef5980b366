// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/joint_rounding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

constexpr float kNegligible = 0.02F;  // entries of a column that are left out
constexpr int kSweeps = 4;            // over all vertices, in turns from either end

/// The bits that a residual of any magnitude would take.
float bits(const ResidualCosts& costs, int32_t q) {
  constexpr int32_t kKnown = 3;
  constexpr float kFurther = 0.7F;  // of each more in magnitude
  const int32_t magnitude = std::abs(q);
  const float sign = q == 0 ? 0 : q > 0 ? costs.positive : costs.negative;
  return sign + costs.magnitude[std::min(magnitude, kKnown)] +
         kFurther * static_cast<float>(std::max(magnitude - kKnown, 0));
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

void JointRounding::improve(const float* target, const ResidualCosts* costs, double price,
                            int32_t* q) const {
  const size_t n = order_.vertex_count();
  const auto m = static_cast<size_t>(order_.neighbour_count);
  std::vector<float> y(n), error(n);
  for (size_t i = 0; i < n; ++i) {
    float p = 0;
    for (size_t a = 0; a < m && order_.neighbours[i * m + a] >= 0; ++a)
      p += weights_[i * m + a] * y[static_cast<size_t>(order_.neighbours[i * m + a])];
    y[i] = p + static_cast<float>(q[i]);
    error[i] = target[i] - y[i];
  }
  const auto lambda = static_cast<float>(price);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    size_t changes = 0;
    for (size_t k = 0; k < n; ++k) {
      const size_t i = sweep % 2 == 0 ? n - 1 - k : k;
      float slope = 0;
      for (size_t e = start_[i]; e < start_[i + 1]; ++e)
        slope += column_[e].value * error[column_[e].rank];
      // Nothing below moves a zero: half a step would have to be won.
      if (q[i] == 0 && std::abs(slope) < 0.35F * energy_[i])
        continue;
      const ResidualCosts& cost = costs[i];
      const float now = bits(cost, q[i]);
      float least = -1e-6F;
      int32_t best = q[i];
      for (const int32_t candidate : {q[i] - 1, q[i] + 1, 0}) {
        const auto d = static_cast<float>(candidate - q[i]);
        const float change =
            d * (d * energy_[i] - 2 * slope) + lambda * (bits(cost, candidate) - now);
        if (candidate != q[i] && change < least) {
          least = change;
          best = candidate;
        }
      }
      if (best == q[i])
        continue;
      const auto d = static_cast<float>(best - q[i]);
      for (size_t e = start_[i]; e < start_[i + 1]; ++e)
        error[column_[e].rank] -= d * column_[e].value;
      q[i] = best;
      ++changes;
    }
    if (changes == 0)
      break;
  }
}

}  // namespace anicodec
