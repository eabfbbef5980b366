// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/lattice.h"

#include "format/compiler.h"
#include "sdk/exact/exact_coding.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace anicodec {
namespace {

constexpr size_t kFewest = 64;      // distinct coordinates to tell a step by
constexpr double kShare = 0.97;     // of the distinct coordinates that a lattice must be near
constexpr double kLeastStep = 0.9;  // roundings of the largest coordinate
constexpr int kMostDecimals = 9;

/// The distance of the numbers of binary32 around the largest coordinate.
double rounding_of(const std::vector<float>& sorted) {
  const float largest = std::max(std::fabs(sorted.front()), std::fabs(sorted.back()));
  return std::ldexp(1.0, std::max(std::ilogb(largest), -126) - 23);
}

/// Fits origin and step to the coordinates from `begin` to `end`, by least squares over those that
/// are near a point.
void refine(const float* begin, const float* end, ExactRecord::Lattice* lattice) {
  double n = 0, sum_k = 0, sum_kk = 0, sum_x = 0, sum_kx = 0;
  for (const float* x = begin; x < end; ++x) {
    const double offset = static_cast<double>(*x) - lattice->origin;
    const double k = std::nearbyint(offset / lattice->step);
    if (std::fabs(offset - k * lattice->step) > 0.25 * lattice->step)
      continue;
    n += 1;
    sum_k += k;
    sum_kk += k * k;
    sum_x += offset;
    sum_kx += k * offset;
  }
  const double determinant = n * sum_kk - sum_k * sum_k;
  if (n < 4 || !(determinant > 0))
    return;
  const double step = (n * sum_kx - sum_k * sum_x) / determinant;
  lattice->origin += (sum_x - step * sum_k) / n;
  lattice->step = step;
}

/// From a guess of the step, the lattice around the median, fitted to ever wider surroundings.
ExactRecord::Lattice grown(const std::vector<float>& sorted, double step) {
  ExactRecord::Lattice lattice;
  const double middle = sorted[sorted.size() / 2];
  lattice.origin = middle;
  lattice.step = step;
  const double low = sorted.front(), high = sorted.back();
  const double widest = 2 * std::max(middle - low, high - middle);
  for (double width = 16 * step; lattice.step > 0; width *= 1.5) {
    const auto begin = std::ranges::lower_bound(sorted, static_cast<float>(middle - width));
    const auto end = std::upper_bound(begin, sorted.end(), static_cast<float>(middle + width));
    refine(sorted.data() + (begin - sorted.begin()), sorted.data() + (end - sorted.begin()),
           &lattice);
    if (width > widest)
      break;
  }
  return lattice;
}

/// The largest power of two that all coordinates are multiples of.
double common_power(const std::vector<float>& sorted) {
  int exponent = 128;
  for (float x : sorted) {
    if (x == 0)
      continue;
    int of_x;
    const auto digits = static_cast<uint32_t>(std::ldexp(std::frexp(std::fabs(x), &of_x), 24));
    exponent = std::min(exponent, of_x - 24 + lowest_bit(digits));
  }
  return std::ldexp(1.0, exponent);
}

/// Sets the range of the points; false when there are too many.
bool set_range(const std::vector<float>& sorted, ExactRecord::Lattice* lattice) {
  const double low = sorted.front(), high = sorted.back();
  const double first = std::floor((low - lattice->origin) / lattice->step + 0.5);
  const double last = std::floor((high - lattice->origin) / lattice->step + 0.5);
  if (!(std::fabs(first) < INT32_MAX) || !(last - first < INT32_MAX))
    return false;
  lattice->first = static_cast<int32_t>(first);
  lattice->count = static_cast<uint32_t>(last - first) + 1;
  return true;
}

/// Whether the coordinates are the points of the lattice, or nearly all are within a rounding and the
/// points are no more than `most`. Sets the range, and whether it errs.
bool fits(const std::vector<float>& sorted, uint64_t most, ExactRecord::Lattice* lattice) {
  if (!set_range(sorted, lattice))
    return false;
  size_t near = 0, equal = 0;
  for (float x : sorted) {
    const int64_t point = ordinal(lattice_point(*lattice, nearest_point(*lattice, x)));
    near += std::abs(ordinal(x) - point) <= 1;
    equal += ordinal(x) == point;
  }
  lattice->errs = equal < sorted.size();
  return !lattice->errs ||
         (lattice->count <= most &&
          static_cast<double>(near) >= kShare * static_cast<double>(sorted.size()));
}

}  // namespace

ExactRecord::Lattice find_lattice(std::vector<float> coordinates, uint64_t most) {
  // Zeros of either sign are two numbers.
  std::ranges::sort(coordinates, {}, ordinal);
  const auto equal = [](float a, float b) { return ordinal(a) == ordinal(b); };
  coordinates.erase(std::unique(coordinates.begin(), coordinates.end(), equal), coordinates.end());
  if (coordinates.size() < 2)
    return {};
  // Fractions of a power of two; decimals; whatever was quantised: where most points are taken the median
  // of the gaps is the step, where few are, the smallest gap that is not a rounding. The coarsest tells
  // most.
  const double rounding = rounding_of(coordinates);
  ExactRecord::Lattice best;
  auto consider = [&](ExactRecord::Lattice lattice) {
    if (lattice.step > best.step && lattice.step >= kLeastStep * rounding &&
        fits(coordinates, most, &lattice))
      best = lattice;
  };
  consider({0, common_power(coordinates), 0, 0, false});
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals)
    consider({0, std::pow(10.0, -decimals), 0, 0, false});
  if (coordinates.size() < kFewest)
    return best;
  std::vector<double> gaps;
  for (size_t i = 1; i < coordinates.size(); ++i)
    gaps.push_back(static_cast<double>(coordinates[i]) - static_cast<double>(coordinates[i - 1]));
  for (const double share : {0.5, 0.1, 0.01}) {
    const auto at = gaps.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(gaps.size()));
    std::nth_element(gaps.begin(), at, gaps.end());
    if (*at > best.step && *at >= kLeastStep * rounding)
      consider(grown(coordinates, *at));
  }
  return best;
}

}  // namespace anicodec
