// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/affine_functions.h"

#include "sdk/base/float_control.h"

#include <cmath>

namespace anicodec {
namespace {

// The rest of an axis must be more than this part of its variance.
constexpr double kIndependent = 1e-9;

}  // namespace

AffineFunctions AffineFunctions::of(const int32_t* pose, size_t vertex_count,
                                    const uint8_t* regions, uint32_t region) {
  const FloatControl control;
  AffineFunctions f;
  size_t count = 0;
  int64_t sum[3] = {};
  for (size_t v = 0; v < vertex_count; ++v) {
    if (regions && regions[v] != region)
      continue;
    ++count;
    for (size_t d = 0; d < 3; ++d)
      sum[d] += pose[3 * v + d];
  }
  if (count == 0)
    return f;
  const auto n = static_cast<double>(count);
  f.constant = 1 / std::sqrt(n);
  for (size_t d = 0; d < 3; ++d)
    f.mean[d] = static_cast<double>(sum[d]) / n;
  double moments[3][3] = {};  // lower triangle
  for (size_t v = 0; v < vertex_count; ++v) {
    if (regions && regions[v] != region)
      continue;
    double c[3];
    for (size_t d = 0; d < 3; ++d)
      c[d] = pose[3 * v + d] - f.mean[d];
    for (size_t a = 0; a < 3; ++a)
      for (size_t b = 0; b <= a; ++b)
        moments[a][b] += c[a] * c[b];
  }
  // moments = L L', row by row, and the inverse of L along with it.
  double L[3][3] = {};
  for (size_t a = 0; a < 3; ++a) {
    double rest = moments[a][a];
    for (size_t b = 0; b < a; ++b) {
      double s = 0;
      for (size_t d = 0; d <= b; ++d)
        s += f.inverse[b][d] * moments[a][d];
      L[a][b] = s;
      rest -= s * s;
    }
    if (!(rest > kIndependent * moments[a][a]))
      continue;
    const double scale = 1 / std::sqrt(rest);
    f.inverse[a][a] = scale;
    for (size_t d = 0; d < a; ++d) {
      double s = 0;
      for (size_t b = d; b < a; ++b)
        s += L[a][b] * f.inverse[b][d];
      f.inverse[a][d] = -s * scale;
    }
  }
  return f;
}

void AffineFunctions::evaluate(const double p[3], double values[kAffineFunctions]) const {
  values[0] = constant;
  for (size_t a = 0; a < 3; ++a) {
    double s = 0;
    for (size_t d = 0; d <= a; ++d)
      s += inverse[a][d] * (p[d] - mean[d]);
    values[a + 1] = s;
  }
}

void AffineFunctions::map(const double weights[3][kAffineFunctions], double out[12]) const {
  for (size_t axis = 0; axis < 3; ++axis) {
    double* row = out + 4 * axis;
    row[3] = weights[axis][0] * constant;
    for (size_t d = 0; d < 3; ++d) {
      row[d] = 0;
      for (size_t a = d; a < 3; ++a)
        row[d] += weights[axis][a + 1] * inverse[a][d];
      row[3] -= row[d] * mean[d];
    }
  }
}

}  // namespace anicodec
