// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/search/size_curve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

// Bytes go about as error^kUsual; a mesh that takes most of the file makes that flatter.
constexpr double kUsual = -0.5, kFlattest = -0.05, kSteepest = -2;

}  // namespace

void SizeCurve::add(double rmse, double bytes) {
  sizes_[std::log(rmse)] = std::log(bytes);
}

double SizeCurve::rmse_of(double bytes) const {
  const double wanted = std::log(bytes);
  std::vector<std::pair<double, double>> nearest(sizes_.begin(), sizes_.end());
  std::ranges::stable_sort(
      nearest, {}, [&](const auto& trial) { return std::abs(trial.second - wanted); });
  const auto [at, size] = nearest[0];
  double slope = kUsual;
  if (nearest.size() > 1) {
    const double measured = (nearest[1].second - size) / (nearest[1].first - at);
    if (measured < 0)
      slope = std::clamp(measured, kSteepest, kFlattest);
  }
  const double furthest = std::log(kFurthest);
  return std::exp(at + std::clamp((wanted - size) / slope, -furthest, furthest));
}

}  // namespace anicodec
