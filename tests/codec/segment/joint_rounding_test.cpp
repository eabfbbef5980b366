// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/joint_rounding.h"

#include "tests/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr size_t kGridSide = 24;
constexpr size_t kCount = kGridSide * kGridSide;

/// A grid of triangles and its order, each vertex predicted as the mean of its neighbours.
struct Grid {
  VertexOrder order;
  std::vector<float> weights;

  Grid() {
    Vector<uint32_t> triangles;
    Vector<int32_t> positions;
    for (uint32_t y = 0; y < kGridSide; ++y)
      for (uint32_t x = 0; x < kGridSide; ++x) {
        positions.insert(positions.end(),
                         {static_cast<int32_t>(100 * x), static_cast<int32_t>(100 * y), 0});
        if (x + 1 == kGridSide || y + 1 == kGridSide)
          continue;
        const uint32_t v = y * kGridSide + x;
        for (const uint32_t d :
             {0u, 1u, uint32_t{kGridSide} + 1, 0u, uint32_t{kGridSide} + 1, uint32_t{kGridSide}})
          triangles.push_back(v + d);
      }
    EXPECT_EQ(make_vertex_order(triangles.data(), triangles.size() / 3, positions.data(), kCount, 8,
                                1, &order),
              Status::kOk);
    weights.assign(order.neighbours.size(), 0.0F);
    for (size_t i = 0; i < kCount; ++i) {
      size_t valid = 0;
      while (valid < 8 && order.neighbours[8 * i + valid] >= 0)
        ++valid;
      for (size_t a = 0; a < valid; ++a)
        weights[8 * i + a] = 1.0F / static_cast<float>(valid);
    }
  }

  std::vector<double> decoded(const std::vector<int32_t>& q) const {
    std::vector<double> y(kCount);
    for (size_t i = 0; i < kCount; ++i) {
      y[i] = q[i];
      for (size_t a = 0; a < 8; ++a)
        if (order.neighbours[8 * i + a] >= 0)
          y[i] += static_cast<double>(weights[8 * i + a]) *
                  y[static_cast<size_t>(order.neighbours[8 * i + a])];
    }
    return y;
  }

  double squared_error(const std::vector<float>& target, const std::vector<int32_t>& q) const {
    const std::vector<double> y = decoded(q);
    double sum = 0;
    for (size_t i = 0; i < kCount; ++i)
      sum += (static_cast<double>(target[i]) - y[i]) * (static_cast<double>(target[i]) - y[i]);
    return sum;
  }

  /// A target rounded vertex by vertex.
  std::vector<int32_t> rounded(const std::vector<float>& target) const {
    std::vector<int32_t> q(kCount);
    std::vector<double> y(kCount);
    for (size_t i = 0; i < kCount; ++i) {
      double p = 0;
      for (size_t a = 0; a < 8; ++a)
        if (order.neighbours[8 * i + a] >= 0)
          p += static_cast<double>(weights[8 * i + a]) *
               y[static_cast<size_t>(order.neighbours[8 * i + a])];
      q[i] = static_cast<int32_t>(std::lround(static_cast<double>(target[i]) - p));
      y[i] = p + q[i];
    }
    return q;
  }
};

std::vector<float> target(const Grid& grid) {
  SmallRandom random(5);
  std::vector<float> t(kCount);
  for (size_t i = 0; i < kCount; ++i) {
    const double x = grid.order.order[i] % kGridSide,
                 y = static_cast<double>(grid.order.order[i] / kGridSide);
    t[i] = static_cast<float>(6 * std::sin(0.3 * x) + 4 * std::cos(0.2 * y + 0.1 * x) +
                              0.6 * random.symmetric());
  }
  return t;
}

ResidualCosts usual_costs() {
  ResidualCosts costs;
  costs.magnitude[0] = 0.4F;
  costs.magnitude[1] = 2.5F;
  costs.magnitude[2] = 4.5F;
  costs.magnitude[3] = 6;
  costs.positive = costs.negative = 1;
  return costs;
}

double bits(const std::vector<int32_t>& q) {
  const ResidualCosts costs = usual_costs();
  double sum = 0;
  for (const int32_t x : q) {
    const int32_t magnitude = std::abs(x);
    sum += static_cast<double>(costs.magnitude[std::min(magnitude, 3)]) + (x != 0) +
           0.7 * std::max(magnitude - 3, 0);
  }
  return sum;
}

/// Batches of 32 that save so much, besides their bits, if they are empty.
std::vector<BatchCosts> batches(float zero_saves) {
  std::vector<BatchCosts> all;
  for (uint32_t first = 0; first < kCount; first += 32)
    all.push_back({first, std::min(first + 32, uint32_t{kCount}), zero_saves});
  return all;
}

/// Batches that cannot be empty.
std::vector<BatchCosts> full_batches() {
  return batches(-std::numeric_limits<float>::infinity());
}

TEST(JointRounding, LowersErrorPlusBits) {
  const Grid grid;
  const std::vector<float> t = target(grid);
  const std::vector<ResidualCosts> costs(kCount, usual_costs());
  JointRounding joint(grid.order);
  joint.set_weights(grid.weights);
  const std::vector<int32_t> start = grid.rounded(t);
  for (const double price : {0.02, 0.1, 0.5}) {
    std::vector<int32_t> q = start;
    joint.improve(1, t.data(), costs.data(), full_batches(), price, q.data());
    const double before = grid.squared_error(t, start) + price * bits(start);
    const double after = grid.squared_error(t, q) + price * bits(q);
    EXPECT_LT(after, (price < 0.1 ? 0.995 : 0.97) * before) << price;
  }
}

TEST(JointRounding, TakesFewerBitsTheDearerTheyAre) {
  const Grid grid;
  const std::vector<float> t = target(grid);
  const std::vector<ResidualCosts> costs(kCount, usual_costs());
  JointRounding joint(grid.order);
  joint.set_weights(grid.weights);
  double last_bits = 1e9, last_error = 0;
  for (const double price : {0.02, 0.2, 1.0}) {
    std::vector<int32_t> q = grid.rounded(t);
    joint.improve(1, t.data(), costs.data(), full_batches(), price, q.data());
    EXPECT_LT(bits(q), last_bits);
    EXPECT_GT(grid.squared_error(t, q), last_error);
    last_bits = bits(q);
    last_error = grid.squared_error(t, q);
  }
}

TEST(JointRounding, EmptiesBatchesWhereThatSaves) {
  constexpr float kSaves = 3;
  constexpr double kPrice = 0.2;
  const Grid grid;
  std::vector<float> t = target(grid);
  for (float& x : t)
    x *= 0.12F;
  const std::vector<ResidualCosts> costs(kCount, usual_costs());
  JointRounding joint(grid.order);
  joint.set_weights(grid.weights);
  const auto cost = [&](const std::vector<int32_t>& q) {
    double sum = grid.squared_error(t, q);
    for (const BatchCosts& batch : batches(kSaves)) {
      const std::vector<int32_t> part(q.begin() + batch.first, q.begin() + batch.end);
      const bool empty = std::ranges::count(part, 0) == std::ssize(part);
      sum += kPrice * (empty ? -static_cast<double>(kSaves) : bits(part));
    }
    return sum;
  };
  std::vector<int32_t> heeded = grid.rounded(t), not_heeded = heeded;
  joint.improve(1, t.data(), costs.data(), batches(kSaves), kPrice, heeded.data());
  joint.improve(1, t.data(), costs.data(), full_batches(), kPrice, not_heeded.data());
  EXPECT_LT(cost(heeded), 0.95 * cost(not_heeded));
}

TEST(JointRounding, LeavesAnExactTargetAlone) {
  const Grid grid;
  std::vector<int32_t> q(kCount, 0);
  SmallRandom random(9);
  for (int32_t& x : q)
    x = static_cast<int32_t>(random.below(7)) - 3;
  const std::vector<double> y = grid.decoded(q);
  const std::vector<float> t(y.begin(), y.end());
  const std::vector<ResidualCosts> costs(kCount, usual_costs());
  JointRounding joint(grid.order);
  joint.set_weights(grid.weights);
  std::vector<int32_t> improved = q;
  joint.improve(1, t.data(), costs.data(), full_batches(), 0.0, improved.data());
  EXPECT_EQ(improved, q);
}

TEST(JointRounding, TreatsEachOfThreeChannelsAsItWouldAlone) {
  const Grid grid;
  std::vector<float> all;
  std::vector<int32_t> together, alone;
  const std::vector<ResidualCosts> costs(3 * kCount, usual_costs());
  JointRounding joint(grid.order);
  joint.set_weights(grid.weights);
  for (const float factor : {1.0F, -0.4F, 2.5F}) {
    std::vector<float> t = target(grid);
    for (float& x : t)
      x *= factor;
    std::vector<int32_t> q = grid.rounded(t);
    all.insert(all.end(), t.begin(), t.end());
    together.insert(together.end(), q.begin(), q.end());
    joint.improve(1, t.data(), costs.data(), full_batches(), 0.1, q.data());
    alone.insert(alone.end(), q.begin(), q.end());
  }
  joint.improve(3, all.data(), costs.data(), full_batches(), 0.1, together.data());
  EXPECT_EQ(together, alone);
}

}  // namespace
}  // namespace anicodec
