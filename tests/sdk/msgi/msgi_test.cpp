// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/msgi/msgi.h"

#include "tests/sdk/threads.h"
#include "tests/sdk/triangle_lists.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Positions = std::vector<float>;

/// Random positions: nothing about them is smooth.
Positions scattered(uint32_t vertices, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  Positions x(3 * size_t{vertices});
  for (float& value : x)
    value = uniform(random);
  return x;
}

Status init(Msgi& msgi, const TriangleList& list, const std::vector<Positions>& inputs,
            const Msgi::Options& options = {}) {
  std::vector<const float*> pointers;
  for (const Positions& x : inputs)
    pointers.push_back(x.data());
  return msgi.init(list.triangles.data(), list.triangles.size() / 3, list.vertex_count,
                   pointers.data(), pointers.size(), options);
}

Positions evaluate(const Msgi& msgi, const std::vector<double>& weights,
                   const float* pins = nullptr, const HostThreads& threads = {}) {
  std::vector<double> scratch((msgi.scratch_bytes() + 7) / 8);
  Positions x(3 * size_t{msgi.vertex_count()});
  EXPECT_EQ(msgi.evaluate(weights.data(), pins, scratch.data(), x.data(), threads), Status::kOk);
  return x;
}

double largest_distance(const Positions& a, const Positions& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); i += 3)
    largest = std::max(largest,
                       std::hypot(double{a[i]} - double{b[i]}, double{a[i + 1]} - double{b[i + 1]},
                                  double{a[i + 2]} - double{b[i + 2]}));
  return largest;
}

/// A strip of cells 0.1 wide, bent about the axis of y by an angle in all.
Positions bent_strip(const TriangleList& strip, uint32_t columns, double angle) {
  Positions x;
  for (uint32_t v = 0; v < strip.vertex_count; ++v) {
    double s = 0.1 * (v % columns), y = 0.1 * (v / columns), length = 0.1 * (columns - 1);
    double at = angle * s / length, radius = angle == 0 ? 0 : length / angle;
    x.push_back(static_cast<float>(angle == 0 ? s : radius * std::sin(at)));
    x.push_back(static_cast<float>(y));
    x.push_back(static_cast<float>(radius * (1 - std::cos(at))));
  }
  return x;
}

/// Mean of |l / l* - 1| over the edges of the triangles.
double length_error(const TriangleList& list, const Positions& x, const Positions& target) {
  auto length = [](const Positions& p, uint32_t a, uint32_t b) {
    double sum = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      double d = double{p[size_t{3} * a + axis]} - double{p[size_t{3} * b + axis]};
      sum += d * d;
    }
    return std::sqrt(sum);
  };
  double sum = 0;
  for (size_t t = 0; t < list.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      uint32_t a = list.triangles[t + k], b = list.triangles[t + (k + 1) % 3];
      sum += std::fabs(length(x, a, b) / length(target, a, b) - 1);
    }
  }
  return sum / static_cast<double>(list.triangles.size());
}

TEST(Msgi, ReproducesItsInputsOnAllKindsOfMeshes) {
  for (const TriangleList& list : odd_triangle_lists()) {
    for (uint32_t leaf : {1U, 8U, 255U}) {
      std::vector<Positions> inputs;
      for (unsigned seed = 1; seed <= 3; ++seed)
        inputs.push_back(scattered(list.vertex_count, seed));
      Msgi::Options options;
      options.leaf_faces = leaf;
      Msgi msgi;
      ASSERT_EQ(init(msgi, list, inputs, options), Status::kOk) << list.name;
      for (size_t i = 0; i < inputs.size(); ++i) {
        std::vector<double> weights(inputs.size(), 0.0);
        weights[i] = 1;
        EXPECT_LE(largest_distance(evaluate(msgi, weights), inputs[i]), 1e-6 * 3.5)
            << list.name << " " << leaf << " " << i;
      }
    }
  }
}

TEST(Msgi, ReproducesInputsWithVerticesInOnePlace) {
  for (const TriangleList& list : odd_triangle_lists()) {
    Positions collapsed = scattered(list.vertex_count, 4);
    for (size_t i = 0; i < collapsed.size() / 2; ++i)
      collapsed[i] = collapsed[i % 3];
    Positions point(collapsed.size(), 0.25F);
    Positions line = collapsed;
    for (size_t i = 0; i < line.size(); ++i)
      line[i] = line[i - i % 3];
    std::vector<Positions> inputs{collapsed, line, point};
    Msgi msgi;
    ASSERT_EQ(init(msgi, list, inputs), Status::kOk) << list.name;
    for (size_t i = 0; i < inputs.size(); ++i) {
      std::vector<double> weights(inputs.size(), 0.0);
      weights[i] = 1;
      EXPECT_LE(largest_distance(evaluate(msgi, weights), inputs[i]), 1e-6 * 3.5) << list.name;
    }
  }
}

TEST(Msgi, BendsOverSeveralTurns) {
  const uint32_t columns = 200;
  TriangleList strip = grid_list(columns, 6);
  std::vector<Positions> inputs{bent_strip(strip, columns, 0), bent_strip(strip, columns, 20)};
  Msgi msgi;
  ASSERT_EQ(init(msgi, strip, inputs), Status::kOk);
  for (double t : {-0.3, 0.25, 0.5, 0.8, 1.2}) {
    Positions x = evaluate(msgi, {1 - t, t}), wanted = bent_strip(strip, columns, 20 * t);
    EXPECT_LE(length_error(strip, x, wanted), 0.002) << t;
  }
}

TEST(Msgi, MovesARigidBodyRigidly) {
  TriangleList grid = grid_list(9, 7);
  Positions a = scattered(grid.vertex_count, 5), b = a, half = a;
  for (size_t i = 0; i < a.size(); i += 3) {
    // 120 degrees about z, and 60.
    auto turn = [&](Positions& out, double angle, double shift) {
      out[i] = static_cast<float>(std::cos(angle) * a[i] - std::sin(angle) * a[i + 1]);
      out[i + 1] = static_cast<float>(std::sin(angle) * a[i] + std::cos(angle) * a[i + 1] + shift);
    };
    turn(b, 2.0943951, 4);
    turn(half, 1.0471976, 2);
  }
  Msgi msgi;
  ASSERT_EQ(init(msgi, grid, {a, b}), Status::kOk);
  Positions x = evaluate(msgi, {0.5, 0.5});
  EXPECT_LE(length_error(grid, x, a), 1e-6);
}

TEST(Msgi, BlendsManyInputs) {
  const uint32_t columns = 60;
  TriangleList strip = grid_list(columns, 5);
  std::vector<Positions> inputs;
  for (double angle : {0.0, 2.0, 4.0, 9.0})
    inputs.push_back(bent_strip(strip, columns, angle));
  Msgi msgi;
  ASSERT_EQ(init(msgi, strip, inputs), Status::kOk);
  Positions x = evaluate(msgi, {0.3, 0.4, -0.2, 0.5});
  EXPECT_LE(length_error(strip, x, bent_strip(strip, columns, 0.8 - 0.8 + 4.5)), 0.002);
}

TEST(Msgi, PutsPinsWhereTheyAreWanted) {
  const uint32_t columns = 40;
  TriangleList strip = grid_list(columns, 5);
  std::vector<Positions> inputs{bent_strip(strip, columns, 0.5), bent_strip(strip, columns, 2)};
  Msgi::Options options;
  options.pins = {0, columns - 1, 2 * columns};
  options.sweeps = 15;
  Msgi msgi;
  ASSERT_EQ(init(msgi, strip, inputs, options), Status::kOk);
  Positions free = bent_strip(strip, columns, 1.25);
  Positions pins;
  for (uint32_t pin : options.pins) {
    for (size_t axis = 0; axis < 3; ++axis)
      pins.push_back(free[size_t{3} * pin + axis] + (pin == columns - 1 && axis == 2 ? 0.3F : 0.F));
  }
  Positions x = evaluate(msgi, {0.5, 0.5}, pins.data());
  for (size_t p = 0; p < options.pins.size(); ++p) {
    for (size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(x[3 * size_t{options.pins[p]} + axis], pins[3 * p + axis]);
  }
  EXPECT_LE(length_error(strip, x, free), 0.02);
  EXPECT_GE(largest_distance(x, free), 0.2);
}

TEST(Msgi, MovesContinuously) {
  TriangleList book = odd_triangle_lists()[3];
  std::vector<Positions> inputs{scattered(book.vertex_count, 1), scattered(book.vertex_count, 2)};
  Msgi msgi;
  ASSERT_EQ(init(msgi, book, inputs), Status::kOk);
  Positions before = inputs[0];
  for (int step = 0; step <= 1000; ++step) {
    double t = step / 1000.0;
    Positions x = evaluate(msgi, {1 - t, t});
    EXPECT_LE(largest_distance(x, before), 0.2) << t;
    before = x;
  }
}

TEST(Msgi, GivesTheSameBitsWithAnyThreads) {
  TriangleList grid = grid_list(90, 70);
  std::vector<Positions> inputs{scattered(grid.vertex_count, 1), scattered(grid.vertex_count, 2)};
  Msgi msgi;
  ASSERT_EQ(init(msgi, grid, inputs), Status::kOk);
  EXPECT_EQ(evaluate(msgi, {0.3, 0.7}), evaluate(msgi, {0.3, 0.7}, nullptr, three_threads()));
}

TEST(Msgi, SaysHowManyBytesSettingUpNeeds) {
  for (const TriangleList& list : odd_triangle_lists()) {
    const std::vector<Positions> inputs{scattered(list.vertex_count, 1),
                                        scattered(list.vertex_count, 2)};
    Msgi msgi;
    ASSERT_EQ(init(msgi, list, inputs), Status::kOk);
    Msgi::Options options;
    options.most_bytes = msgi.required_bytes();
    EXPECT_GE(options.most_bytes, msgi.resident_bytes());
    EXPECT_EQ(init(msgi, list, inputs, options), Status::kOk) << list.name;
    --options.most_bytes;
    EXPECT_EQ(init(msgi, list, inputs, options), Status::kLimit) << list.name;
  }
}

TEST(Msgi, RefusesWhatItCannotDo) {
  TriangleList grid = grid_list(4, 4);
  std::vector<Positions> inputs{scattered(16, 1), scattered(16, 2)};
  Msgi msgi;
  EXPECT_EQ(init(msgi, grid, {}), Status::kArgument);
  Msgi::Options options;
  options.leaf_faces = 0;
  EXPECT_EQ(init(msgi, grid, inputs, options), Status::kArgument);
  options = {};
  options.pins = {16};
  EXPECT_EQ(init(msgi, grid, inputs, options), Status::kArgument);
  options.pins = {3, 3};
  EXPECT_EQ(init(msgi, grid, inputs, options), Status::kArgument);
  options = {};
  options.most_bytes = 100;
  EXPECT_EQ(init(msgi, grid, inputs, options), Status::kLimit);
  TriangleList wrong = grid;
  wrong.triangles[5] = 16;
  EXPECT_EQ(init(msgi, wrong, inputs), Status::kIndexRange);
  inputs[1][7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(init(msgi, grid, inputs), Status::kNonFinite);

  inputs[1][7] = 0;
  options = {};
  options.pins = {5};
  ASSERT_EQ(init(msgi, grid, inputs, options), Status::kOk);
  std::vector<double> scratch((msgi.scratch_bytes() + 7) / 8);
  Positions x(48), pin{0, 0, 0};
  const double wrong_sum[] = {0.5, 0.6}, nan[] = {std::nan(""), 1}, right[] = {0.5, 0.5};
  EXPECT_EQ(msgi.evaluate(wrong_sum, pin.data(), scratch.data(), x.data()), Status::kArgument);
  EXPECT_EQ(msgi.evaluate(nan, pin.data(), scratch.data(), x.data()), Status::kArgument);
  EXPECT_EQ(msgi.evaluate(right, nullptr, scratch.data(), x.data()), Status::kArgument);
  EXPECT_EQ(msgi.evaluate(right, pin.data(), scratch.data(), x.data()), Status::kOk);
}

}  // namespace
}  // namespace anicodec
