// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_SDK_POSITION_TOLERANCE_H_
#define ANICODEC_TESTS_SDK_POSITION_TOLERANCE_H_

#include "sdk/segment/segment.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace anicodec {

/// How much of the tolerance of spec/09a-segments.md, section 7, the positions of a frame use, at
/// most 1 where they keep to it: the formula in double precision, with the magnitude of each term.
inline double tolerance_used(const Segment& s, uint32_t frame,
                             const std::vector<float>& positions) {
  struct Number {
    double value = 0, magnitude = 0;

    void add(double x, const Number& y) {
      value += x * y.value;
      magnitude += std::fabs(x) * y.magnitude;
    }
  };

  auto exact = [](double x) { return Number{x, std::fabs(x)}; };
  auto map = [&](const Affine& a, Number(&x)[3]) {
    Number y[3];
    for (size_t r = 0; r < 3; ++r) {
      y[r] = exact(a.m[4 * r + 3]);
      for (size_t c = 0; c < 3; ++c)
        y[r].add(a.m[4 * r + c], x[c]);
    }
    std::copy_n(y, 3, x);
  };
  const size_t channels = s.channels(), narrow = s.components - s.wide_components;
  const size_t weight_channels = s.weight_channels();
  double worst = 0;
  for (size_t v = 0; v < s.vertices; ++v) {
    const size_t block = v / kBlock, lane = v % kBlock;
    const size_t region = s.vertex_region.empty() ? 0 : s.vertex_region[v];
    const size_t row_of_weights = size_t{frame} * s.regions + region;
    Number x[3];
    if (s.pose.empty()) {
      for (size_t c = 0; c < 3; ++c)
        x[c] = exact(s.origin[c]);
    } else {
      for (size_t c = 0; c < 3; ++c)
        x[c] = exact(s.pose[(block * 3 + c) * kBlock + lane]);
      map(s.pose_maps[row_of_weights], x);
    }
    for (size_t j = 0; j < s.components; ++j) {
      for (size_t c = 0; c < 3; ++c) {
        const size_t channel = channels == 3 ? c : 0;
        const bool wide = j < s.wide_components;
        const size_t row =
            wide ? block * s.wide_components + j : block * narrow + j - s.wide_components;
        const size_t at = (row * channels + channel) * kBlock + lane;
        const double q = wide ? s.wide[at] : s.narrow[at];
        const size_t w =
            (row_of_weights * s.components + j) * weight_channels + (weight_channels == 3 ? c : 0);
        x[c].add(s.weights[w], exact(q));
      }
    }
    if (!s.motions.empty())
      map(s.motions[frame], x);
    if (!s.correction_begin.empty()) {
      for (size_t i = s.correction_begin[frame]; i < s.correction_begin[frame + 1]; ++i) {
        for (size_t c = 0; s.corrections[i].vertex == v && c < 3; ++c)
          x[c].add(1, exact(s.corrections[i].delta[c]));
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      const double error = std::fabs(positions[3 * v + c] - x[c].value);
      const double allowed = (s.components + 16) * 0x1p-23 * x[c].magnitude;
      if (!(error <= 0))
        worst = std::max(worst, error <= allowed ? error / allowed : 1e300);
    }
  }
  return worst;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_SDK_POSITION_TOLERANCE_H_
