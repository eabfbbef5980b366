// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/signed_axes.h"

#include <algorithm>
#include <cmath>

namespace anicodec::tools {
namespace {

double square(float x) {
  return static_cast<double>(x) * static_cast<double>(x);
}

/// Distance of the farthest point from the origin.
double extent(std::span<const float> points) {
  double most = 0;
  for (size_t i = 0; i + 2 < points.size(); i += 3)
    most = std::max(most, square(points[i]) + square(points[i + 1]) + square(points[i + 2]));
  return std::sqrt(most);
}

double norm(std::span<const float> numbers) {
  double sum = 0;
  for (const float x : numbers)
    sum += square(x);
  return std::sqrt(sum);
}

bool fits(std::span<const float> from, std::span<const float> to, const ScaledTurn& turn,
          double tolerance) {
  for (size_t i = 0; i + 2 < from.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const double turned =
          turn.scale * static_cast<double>(turn.axes[k].sign * from[i + turn.axes[k].axis]);
      if (!(std::abs(turned - static_cast<double>(to[i + k])) <= tolerance))
        return false;
    }
  }
  return true;
}

}  // namespace

std::string text_of(const SignedAxes& axes) {
  std::string text;
  for (const SignedAxis& axis : axes)
    text += std::string(text.empty() ? "" : ",") + (axis.sign < 0 ? "-" : "") + "xyz"[axis.axis];
  return text;
}

std::optional<ScaledTurn> find_turn(std::span<const float> from, std::span<const float> to) {
  constexpr double kTolerance = 1e-3;
  const double size = norm(from);
  if (from.size() != to.size() || !(size > 0) || !(norm(to) > 0))
    return {};
  const double scale = norm(to) / size, tolerance = kTolerance * extent(to);
  std::array<size_t, 3> order = {0, 1, 2};
  do {
    const bool is_even = (order[1] + 3 - order[0]) % 3 == 1;
    for (unsigned signs = 0; signs < 8; ++signs) {
      const bool flips = ((signs ^ signs >> 1 ^ signs >> 2) & 1) != 0;
      if (is_even == flips)  // a mirror image
        continue;
      ScaledTurn turn;
      turn.scale = scale;
      for (size_t k = 0; k < 3; ++k)
        turn.axes[k] = {order[k], (signs >> k & 1) != 0 ? -1.0F : 1.0F};
      if (fits(from, to, turn, tolerance))
        return turn;
    }
  } while (std::ranges::next_permutation(order).found);
  return {};
}

}  // namespace anicodec::tools
