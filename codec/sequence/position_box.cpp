// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/position_box.h"

#include <algorithm>
#include <cmath>

namespace anicodec {

void PositionBox::add(std::span<const float> positions) {
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<double>(positions[i]);
    least_[i % 3] = empty_ ? x : std::min(least_[i % 3], x);
    most_[i % 3] = empty_ ? x : std::max(most_[i % 3], x);
    empty_ = empty_ && i < 2;
  }
}

double PositionBox::size() const {
  return std::hypot(most_[0] - least_[0], most_[1] - least_[1], most_[2] - least_[2]);
}

double PositionBox::farthest() const {
  double x = 0;
  for (size_t k = 0; k < 3; ++k)
    x = std::max({x, std::abs(least_[k]), std::abs(most_[k])});
  return x;
}

double PositionBox::rounding() const {
  const auto x = static_cast<float>(farthest());
  return static_cast<double>(x - std::nextafter(x, 0.F)) / 2;
}

Point PositionBox::middle() const {
  const double step = std::exp2(std::ceil(std::log2(size())));
  Point point{};
  for (size_t k = 0; k < 3; ++k)
    point[k] = std::round((least_[k] + most_[k]) / 2 / step) * step;
  return point;
}

}  // namespace anicodec
