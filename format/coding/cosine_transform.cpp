// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/coding/cosine_transform.h"

#include "format/coding/symbol_model.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr int64_t kPi = 3373259426;  // pi 2^30, rounded down

/// Largest integer whose square is at most x.
uint32_t square_root(uint64_t x) {
  uint64_t root = 0;
  for (uint64_t bit = uint64_t{1} << 31; bit != 0; bit >>= 1)
    if ((root | bit) * (root | bit) <= x)
      root |= bit;
  return static_cast<uint32_t>(root);
}

/// cos(pi m / (2 n)) in 1/2^30 for 0 <= m <= n, by its series up to the 16th power of the angle.
int64_t cosine(int64_t m, int64_t n) {
  const int64_t angle = kPi * m / (2 * n);
  const int64_t square = (angle * angle) >> 30;
  constexpr int64_t kOne = int64_t{1} << 30;
  int64_t sum = kOne;
  for (int64_t k = 16; k >= 2; k -= 2)
    sum = kOne - ((square * sum) >> 30) / (k * (k - 1));
  return sum;
}

/// Sums of v_f cos((f + 1/2) k angle) over `count` values, for k = first, first + 2, ... below `end`, into
/// sums[k stride], by the recurrence b_f = v_f + 2 cos(a) b_(f+1) - b_(f+2) (Clenshaw 1955), some angles side by side.
void clenshaw_sums(const double* values, uint32_t count, double angle, uint32_t first, uint32_t end,
                   double* sums, size_t stride) {
  constexpr uint32_t kAngles = 8;
  for (uint32_t k = first; k < end; k += 2 * kAngles) {
    double twice[kAngles], last[kAngles] = {}, before[kAngles] = {};
    for (uint32_t i = 0; i < kAngles; ++i)
      twice[i] = 2 * std::cos((k + 2 * i) * angle);
    for (uint32_t f = count; f-- > 0;) {
      for (uint32_t i = 0; i < kAngles; ++i) {
        const double next = values[f] + twice[i] * last[i] - before[i];
        before[i] = last[i];
        last[i] = next;
      }
    }
    for (uint32_t i = 0; i < kAngles && k + 2 * i < end; ++i)
      sums[(k + 2 * i) * stride] = std::cos((k + 2 * i) * angle / 2) * (last[i] - before[i]);
  }
}

/// Sums of v_f cos((f + 1/2) k pi / length) for all k below the length into sums[k stride]. Even functions are the
/// same from both ends, and their sums a transform of half the length; odd ones change sign. Overwrites the values.
void cosine_sums(double* values, uint32_t length, double* sums, size_t stride) {
  const uint32_t half = length / 2;
  const double angle = 3.14159265358979323846 / length;
  Vector<double> odd(half);
  for (uint32_t f = 0; f < half; ++f) {
    odd[f] = values[f] - values[length - 1 - f];
    values[f] += values[length - 1 - f];
  }
  clenshaw_sums(odd.data(), half, angle, 1, length, sums, stride);
  if (length % 2 == 0) {
    cosine_sums(values, half, sums, 2 * stride);
    return;
  }
  clenshaw_sums(values, half, angle, 0, length, sums, stride);
  for (uint32_t k = 0; k < length; k += 2)
    sums[k * stride] += k % 4 == 0 ? values[half] : -values[half];
}

}  // namespace

CosineTransform::CosineTransform(uint32_t length) : length_(length) {
  const int up = floor_log2(length) / 2;
  shift_ = 28 + up;
  // With 2^up about sqrt(length), |entries| stay below 2^29.
  const int64_t scale = square_root(((uint64_t{1} << 57) / length) << (2 * up));
  constant_ = static_cast<int32_t>(square_root(((uint64_t{1} << 56) / length) << (2 * up)));
  const uint32_t n = length;
  table_.resize(size_t{4} * n);
  for (uint32_t m = 0; m <= n; ++m) {
    const auto c = static_cast<int32_t>((scale * cosine(m, n) + (1 << 29)) >> 30);
    table_[m] = c;
    table_[2 * n - m] = -c;
    table_[2 * n + m] = -c;
    table_[(4 * n - m) % (4 * n)] = c;
  }
  table_[n] = table_[size_t{3} * n] = 0;
}

void CosineTransform::inverse(const int32_t* coefficients, int32_t* values) const {
  // |coefficient| <= 2^22, |entry| < 2^29, 2^10 terms: the sums stay below 2^63. Even functions are
  // the same from both ends, odd ones change sign: half of the values, of each kind apart.
  const uint32_t half = (length_ + 1) / 2, period = 4 * length_;
  Vector<int64_t> sums(size_t{2} * half, 0);
  std::fill_n(sums.begin(), half, int64_t{coefficients[0]} * constant_);
  constexpr size_t kAtOnce = 4;  // frequencies: a place in the table waits for the one before
  for (uint32_t first = 1; first <= 2; ++first) {
    int64_t* sum = sums.data() + size_t{first % 2} * half;
    int64_t y[kAtOnce];
    uint32_t step[kAtOnce], m[kAtOnce];
    size_t count = 0;
    for (uint32_t k = first; k < length_ || count > 0; k += 2) {
      const bool ends = k >= length_;
      if (!ends && coefficients[k] == 0)
        continue;
      y[count] = ends ? 0 : coefficients[k];
      step[count] = ends ? 0 : 2 * k;
      m[count] = ends ? 0 : k;
      if (++count < kAtOnce)
        continue;
      count = 0;
      for (uint32_t f = 0; f < half; ++f) {
        int64_t s = sum[f];
#pragma GCC unroll 4
        for (size_t i = 0; i < kAtOnce; ++i) {
          s += y[i] * table_[m[i]];
          m[i] += step[i];
          m[i] = std::min(m[i], m[i] - period);  // wraps below the period
        }
        sum[f] = s;
      }
    }
  }
  const int down = shift_ - kFractionBits;
  const auto rounded = [&](int64_t sum) {
    return static_cast<int32_t>(
        std::clamp<int64_t>((sum + (int64_t{1} << (down - 1))) >> down, -kValueLimit, kValueLimit));
  };
  for (uint32_t f = 0; f < half; ++f) {
    values[f] = rounded(sums[f] + sums[half + f]);
    values[length_ - 1 - f] = rounded(sums[f] - sums[half + f]);
  }
}

void CosineTransform::forward(const double* values, double* coefficients) const {
  Vector<double> folded(length_);
  std::copy_n(values, length_, folded.begin());
  cosine_sums(folded.data(), length_, coefficients, 1);
  const double scale = std::sqrt(2.0 / length_);
  for (uint32_t k = 0; k < length_; ++k)
    coefficients[k] *= scale;
  coefficients[0] *= std::sqrt(0.5);
}

}  // namespace anicodec
