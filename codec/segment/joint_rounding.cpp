// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/joint_rounding.h"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <Eigen/Core>

namespace anicodec {
namespace {

// Entries of a column that are left out: docs/research/rate.md.
constexpr float kNegligible = 0.12F;
constexpr int kSweeps = 4;  // over all vertices, in turns from either end

/// The best change of a residual q: 0, a step either way, or to zero, whichever lowers the error
/// and `lambda` times its bits most. `slope`: the product of its column and the error; `energy`:
/// that of the column and itself; `zero_saves`: bits that its batch saves if it is 0.
int32_t best_change(int32_t q, float slope, float energy, const ResidualCosts& costs,
                    float zero_saves, float lambda) {
  // Nothing below moves a zero: half a step would have to be won.
  if (q == 0 && std::abs(slope) < 0.35F * energy)
    return 0;
  const auto bits = [&](int32_t x) { return bits_of(costs, x) - (x == 0 ? zero_saves : 0.F); };
  const float now = bits(q);
  float least = -1e-6F;
  int32_t best = 0;
  for (const int32_t change : {-1, 1, -q}) {
    const auto d = static_cast<float>(change);
    const float cost = d * (d * energy - 2 * slope) + lambda * (bits(q + change) - now);
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

  /// Calls f(rank, value) for what has been added to, and begins anew. Also calls f(rank, 0) for
  /// sums that came to 0 on the way.
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

/// The residuals of a component while they change.
template <Eigen::Index kChannels>
class JointRounding::Component {
 public:
  Component(const JointRounding& rounding, const float* target, const ResidualCosts* costs,
            const std::vector<BatchCosts>& batches, float lambda, int32_t* q)
      : rounding_(rounding),
        n_(rounding.order_.vertex_count()),
        costs_(costs),
        batches_(batches),
        lambda_(lambda),
        q_(q),
        error_(n_, Channels::Zero()),
        nonzero_(batches.size(), 0),
        saved_(batches.size(), 0.F) {
    set_error(target);
    for (size_t b = 0; b < batches.size(); ++b) {
      saved_[b] = batches[b].zero_saves;
      for (size_t i = batches[b].first; i < batches[b].end; ++i) {
        for (Eigen::Index c = 0; c < kChannels; ++c) {
          nonzero_[b] += q[at(c, i)] != 0;
          saved_[b] += costs[at(c, i)].magnitude[0];
        }
      }
    }
  }

  /// Changes one residual after the other; false if none is worth it.
  bool sweep(bool backwards) {
    bool changes = false;
    for (size_t k = 0; k < batches_.size(); ++k) {
      const size_t b = backwards ? batches_.size() - 1 - k : k;
      const BatchCosts& batch = batches_[b];
      for (size_t l = batch.first; l < batch.end; ++l)
        changes |= change_vertex(b, backwards ? batch.first + batch.end - 1 - l : l);
    }
    return changes;
  }

  /// Makes all residuals of a batch 0 if that is worth it.
  void clear(size_t b) {
    constexpr int kFew = 6;  // Single ones are those of a sweep.
    if (nonzero_[b] < 2 || nonzero_[b] > kFew || !std::isfinite(saved_[b]))
      return;
    float gain = lambda_ * saved_[b];
    std::array<std::pair<size_t, Channels>, kFew> steps;
    size_t count = 0;
    for (size_t i = batches_[b].first; i < batches_[b].end; ++i) {
      Channels step = Channels::Zero();
      for (Eigen::Index c = 0; c < kChannels; ++c) {
        const int32_t q = q_[at(c, i)];
        const ResidualCosts& costs = costs_[at(c, i)];
        step(c) = static_cast<float>(-q);
        if (q != 0)
          gain += lambda_ * (bits_of(costs, q) - costs.magnitude[0]);
      }
      if ((step == 0).all())
        continue;
      gain -= (step * (step * rounding_.energy_[i] - 2 * product(column(i), error_))).sum();
      move(i, step);
      steps[count++] = {i, step};
    }
    for (const auto& [i, step] : std::span(steps).first(count)) {
      if (gain <= 0)
        move(i, -step);
      else
        for (Eigen::Index c = 0; c < kChannels; ++c)
          q_[at(c, i)] = 0;
    }
  }

 private:
  // The channels of a rank are beside one another, so that a column is read once for all.
  using Channels = Eigen::Array<float, kChannels == 1 ? 1 : 4, 1>;

  size_t at(Eigen::Index c, size_t i) const { return static_cast<size_t>(c) * n_ + i; }

  std::span<const Entry> column(size_t i) const {
    return {rounding_.column_.data() + rounding_.start_[i],
            rounding_.start_[i + 1] - rounding_.start_[i]};
  }

  void move(size_t i, const Channels& step) {
    for (const Entry& entry : column(i))
      error_[entry.rank] -= step * entry.value;
  }

  void set_error(const float* target) {
    const VertexOrder& order = rounding_.order_;
    const auto m = static_cast<size_t>(order.neighbour_count);
    std::vector<Channels> y(n_, Channels::Zero());
    for (size_t i = 0; i < n_; ++i) {
      for (size_t a = 0; a < m && order.neighbours[i * m + a] >= 0; ++a)
        y[i] += rounding_.weights_[i * m + a] * y[static_cast<size_t>(order.neighbours[i * m + a])];
      for (Eigen::Index c = 0; c < kChannels; ++c) {
        y[i](c) += static_cast<float>(q_[at(c, i)]);
        error_[i](c) = target[at(c, i)] - y[i](c);
      }
    }
  }

  bool change_vertex(size_t b, size_t i) {
    const Channels slope = product(column(i), error_);
    Channels step = Channels::Zero();
    for (Eigen::Index c = 0; c < kChannels; ++c) {
      int32_t& residual = q_[at(c, i)];
      const bool alone = nonzero_[b] == (residual != 0 ? 1 : 0) && std::isfinite(saved_[b]);
      const int32_t change = best_change(residual, slope(c), rounding_.energy_[i], costs_[at(c, i)],
                                         alone ? saved_[b] : 0.F, lambda_);
      step(c) = static_cast<float>(change);
      nonzero_[b] += (residual + change != 0) - (residual != 0);
      residual += change;
    }
    if ((step == 0).all())
      return false;
    move(i, step);
    return true;
  }

  const JointRounding& rounding_;
  size_t n_;
  const ResidualCosts* costs_;
  const std::vector<BatchCosts>& batches_;
  float lambda_;
  int32_t* q_;
  std::vector<Channels> error_;
  std::vector<int> nonzero_;  ///< of each batch, residuals that are not 0
  std::vector<float> saved_;  ///< bits that a batch saves that has none
};

void JointRounding::improve(uint32_t channels, const float* target, const ResidualCosts* costs,
                            const std::vector<BatchCosts>& batches, double price,
                            int32_t* q) const {
  const auto improved = [&](auto component) {
    for (int sweep = 0; sweep < kSweeps && component.sweep(sweep % 2 == 0); ++sweep) {
    }
    for (size_t b = 0; b < batches.size(); ++b)
      component.clear(b);
  };
  const auto lambda = static_cast<float>(price);
  if (channels == 1)
    improved(Component<1>(*this, target, costs, batches, lambda, q));
  else
    improved(Component<3>(*this, target, costs, batches, lambda, q));
}

}  // namespace anicodec
