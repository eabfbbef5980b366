// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Weights of the spatial prediction for W vertices at once (spec/09-reconstruction.md, sections 3
// to 5). Part of the prediction kernels, whose rules hold: see prediction_kernel.h.
#ifndef ANICODEC_SDK_PREDICTION_REFIT_SOLVER_H_
#define ANICODEC_SDK_PREDICTION_REFIT_SOLVER_H_

#include "sdk/base/lanes.h"
#include "sdk/prediction/prediction_job.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {
namespace {

/// Prior weights, normal equations and refit of W vertices with M neighbours each.
template <size_t W, size_t M>
struct RefitSolver {
  using Float = typename LaneTypes<W>::Float;

#if defined(ANICODEC_SMALL)
  size_t n = M;  ///< neighbours: one solver does for any number of up to M
#else
  static constexpr size_t n = M;
#endif
  Float A[M][M];  // sum of omega x x', lower triangle
  Float g[M];     // sum of omega x (y - w0 x)
  Float prior[M];
  Float weights[M];

  /// To be called first for other vertices.
  void begin() {
    placed = false;
    moved = 0;
  }

  static Float splat(float x) {
    return Float{} + x;
  }

  void clear() {
    for (size_t a = 0; a < n; ++a) {
      weights[a] = prior[a];
      g[a] = Float{};
      Float* const of_row = A[a];
      for (size_t b = 0; b < n; ++b)
        of_row[b] = Float{};
    }
  }

  /// Prior weights from the positions (rank x 3) of the vertices of `count` ranks from `first`; the
  /// lanes beyond repeat the last one.
  void set_prior(const PredictionJob& job, size_t first, size_t count) {
    Float length[M];
    const Float scale = place(job, first, count, length);
    for (size_t a = 0; a < n; ++a)
      length[a] *= scale;
    const float inverse_radius = 1.0f / job.radius;
    const auto kernel = [&](Float r) {  // Wendland's C2 function
      const Float t = r * inverse_radius;
      Float u = 1.0f - t;
      u = u > 0.0f ? u : Float{};
      const Float u2 = u * u;
      return u2 * u2 * (4.0f * t + 1.0f);
    };
    interpolate([&](size_t a) { return kernel(length[a]); },
                [&](size_t a, size_t b) {
                  return kernel(square_root(squared_distance(places[a], places[b])));
                },
                prior);
  }

  /// Prior weights anew, by what is near in position and in the `samples` decoded so far, those of
  /// the last renewal before the others: x of the neighbours, y of the vertices (Rasmussen and
  /// Williams 2006, chapter 4: Matern's covariance). All that has been learnt stays valid.
  void renew_prior(const PredictionJob& job, size_t first, size_t count, const Float (*x)[M],
                   const Float* y, size_t samples) {
    Float length[M], number{}, mean{};
    if (!placed)
      place(job, first, count, length);
    for (size_t a = 0; a < n; ++a) {
      Float sum = moved > 0 ? apart[a] : Float{};
      const Float* at = x[moved] + a;
      for (size_t s = moved; s < samples; ++s, at += M) {
        const Float d = *at - y[s];
        sum += d * d;
      }
      apart[a] = sum;
      mean += valid[a] * square_root(sum);
      number += valid[a];
    }
    // The part of the squared distances that two roundings leave; if there is little more, motion
    // tells nothing.
    const float noise = 1.0f / 6.0f * static_cast<float>(samples);
    mean = mean / number;
    const Float square = mean * mean;
    const Float rest = square - noise;
    const Float share = rest > 0.0f ? rest / (square * square) : Float{};
    const Float factor_of_motion = job.alike * share;
    const float inverse_length = 0.28f / job.radius;
    const auto kernel = [&](Float squared) {  // about Matern's of order 3/2
      const Float t = square_root(squared) * inverse_length;
      const Float u = 1.0f + t;
      const Float u2 = u * u, u4 = u2 * u2, u8 = u4 * u4;
      return (1.0f + 16.0f * t) / (u8 * u8);
    };
    Float before[M];
    for (size_t a = 0; a < n; ++a)
      before[a] = prior[a];
    interpolate(
        [&](size_t a) { return kernel(square_of(places[a]) + factor_of_motion * apart[a]); },
        [&](size_t a, size_t b) {
          Float sum = moved > 0 ? differ[a][b] : Float{};
          const Float *of_a = x[moved] + a, *of_b = x[moved] + b;
          for (size_t s = moved; s < samples; ++s, of_a += M, of_b += M) {
            const Float d = *of_a - *of_b;
            sum += d * d;
          }
          differ[a][b] = sum;
          return kernel(squared_distance(places[a], places[b]) + factor_of_motion * sum);
        },
        prior);
    moved = samples;
    for (size_t a = 0; a < n; ++a)
      before[a] -= prior[a];
    for (size_t a = 0; a < n; ++a) {
      Float sum = g[a];
      const Float* to_diagonal = A[a];
      for (size_t b = 0; b < a; ++b)
        sum += to_diagonal[b] * before[b];
      const Float* below = A[a] + a;
      for (size_t b = a; b < n; ++b, below += M)
        sum += *below * before[b];
      g[a] = sum;
    }
  }

  /// Begins where `count` vertices of another segment ended, with half the trust in what they have learnt: learnt_floats()
  /// rows, the next of which begins `stride` floats further.
  void continue_from(const float* rows, size_t stride, size_t count) {
    const auto load = [&] {
      Float value;
      if (count == W) {
        ANICODEC_COPY(&value, rows, sizeof value);
      } else {
        for (size_t l = 0; l < W; ++l)
          value[l] = rows[l < count ? l : count - 1];
      }
      rows += stride;
      return value;
    };
    for (size_t a = 0; a < n; ++a)
      prior[a] = load();
    for (size_t a = 0; a < n; ++a)
      g[a] = 0.5f * load();
    for (size_t a = 0; a < n; ++a)
      for (size_t b = 0; b <= a; ++b)
        A[a][b] = 0.5f * load();
    refit();
  }

  /// Writes what continue_from() reads.
  void hand_on(size_t count, size_t stride, float* rows) const {
    const auto store = [&](const Float& value) {
      ANICODEC_COPY(rows, &value, count * sizeof(float));
      rows += stride;
    };
    for (size_t a = 0; a < n; ++a)
      store(prior[a]);
    for (size_t a = 0; a < n; ++a)
      store(g[a]);
    for (size_t a = 0; a < n; ++a)
      for (size_t b = 0; b <= a; ++b)
        store(A[a][b]);
  }

  /// weights = prior + (A + ridge)^-1 g.
  void refit() {
    Float trace{};
    for (size_t a = 0; a < n; ++a)
      trace += A[a][a];
    factor(A, 0.3f + trace * static_cast<float>(1e-5 / static_cast<double>(n)));
    Float change[M];
    solve(g, change);
    for (size_t a = 0; a < n; ++a)
      weights[a] = finite(prior[a] + change[a]);
  }

  /// Adds the samples x[s] with weights omega[s] and residuals r[s] to A and g.
  void accumulate(const Float (*x)[M], const Float* r, const float* omega, size_t samples) {
    Float scaled[kMaxSamples][M];
    const Float* from = x[0];
    Float* to = scaled[0];
    for (size_t s = 0; s < samples; ++s, from += M, to += M)
      for (size_t a = 0; a < n; ++a)
        to[a] = from[a] * omega[s];
    // Blocks of 4 x 2 elements stay in registers; those on the diagonal fill a little of the upper
    // triangle too, which nobody reads.
    for (size_t a = 0; a < n; a += 4)
      for (size_t b = 0; b <= a + 2; b += 2) {
        Float c[4][2];
        Float* const block = &A[a][b];
        ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i)
            ANICODEC_UNROLL for (size_t j = 0; j < 2; ++j) c[i][j] = block[i * M + j];
        const Float *left = scaled[0] + a, *right = x[0] + b;
        for (size_t s = 0; s < samples; ++s, left += M, right += M) {
          const Float x0 = right[0], x1 = right[1];
          ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i) {
            c[i][0] += left[i] * x0;
            c[i][1] += left[i] * x1;
          }
        }
        ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i)
            ANICODEC_UNROLL for (size_t j = 0; j < 2; ++j) block[i * M + j] = c[i][j];
      }
    for (size_t a = 0; a < n; a += 4) {
      Float* const block = g + a;
      Float c[4] = {block[0], block[1], block[2], block[3]};
      const Float* left = scaled[0] + a;
      for (size_t s = 0; s < samples; ++s, left += M)
        ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i) c[i] += left[i] * r[s];
      ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i) block[i] = c[i];
    }
  }

  static constexpr size_t kMaxSamples = 32;

 private:
  Float L[M][M], D[M], inverse[M];
  Float row[M];  // row j of L D
  // Data of the neighbours, kept from one prior to the next: places, whether there is one, squared distances in the
  // first `moved` samples to the vertices and to one another.
  Float places[M][3], valid[M], apart[M], differ[M][M];
  bool placed = false;
  size_t moved = 0;

  static ANICODEC_INLINE Float square_of(const Float* x) {
    return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  }

  static ANICODEC_INLINE Float squared_distance(const Float* a, const Float* b) {
    const Float e[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return square_of(e);
  }

  /// Positions of the neighbours about the vertices in units of their mean distance, and these
  /// distances in units of the grid. Returns the scale between both.
  Float place(const PredictionJob& job, size_t first, size_t count, Float* length) {
    Float sum{}, number{};
    Float(*const x)[3] = places;
    placed = true;
    for (size_t a = 0; a < n; ++a) {
      // Lanes one by one in memory: vectors are slow to fill so.
      float of_lane[3][W], valid_lane[W];
      for (size_t l = 0; l < W; ++l) {
        const size_t r = first + (l < count ? l : count - 1);
        const int32_t b = job.neighbours[r * n + a];
        const size_t other = b < 0 ? r : static_cast<size_t>(b);
        valid_lane[l] = b < 0 ? 0.0f : 1.0f;
        for (size_t d = 0; d < 3; ++d)
          of_lane[d][l] = job.positions[3 * other + d] - job.positions[3 * r + d];
      }
      ANICODEC_COPY(x[a], of_lane, sizeof of_lane);
      ANICODEC_COPY(&valid[a], valid_lane, sizeof valid_lane);
      length[a] = square_root(square_of(x[a]));
      sum += length[a];
      number += valid[a];
    }
    const Float scale = sum > 0.0f ? number / sum : splat(1.0f);
    for (size_t a = 0; a < n; ++a)
      for (size_t d = 0; d < 3; ++d)
        x[a][d] *= scale;
    return scale;
  }

  /// Weights of interpolation from the places: covariances near(a) with the vertices themselves
  /// and between(a, b), beside constant and linear parts.
  template <class Near, class Between>
  void interpolate(const Near& near, const Between& between, Float* out) {
    const Float(*const x)[3] = places;
    Float right[M], covariance[M][M];
    for (size_t a = 0; a < n; ++a) {
      right[a] = valid[a] * (100.0f + 10.0f * near(a));
      for (size_t b = 0; b <= a; ++b) {
        const Float dot = x[a][0] * x[b][0] + x[a][1] * x[b][1] + x[a][2] * x[b][2];
        covariance[a][b] = valid[a] * valid[b] * (100.0f + 10.0f * dot + 10.0f * between(a, b));
      }
    }
    factor(covariance, splat(0.02f));
    solve(right, out);
    for (size_t a = 0; a < n; ++a)
      out[a] = finite(out[a]);
  }

  static Float finite(Float x) {
    return x - x == Float{} ? x : Float{};
  }

  // S + ridge I = L D L', left-looking, without pivoting. The diagonal is one of the eight chains
  // of a block, so that no sum waits for another. Pointers run along rows, as compilers for small code leave the products of
  // indices in the loops.
  void factor(const Float (*S)[M], Float ridge) {
    for (size_t j = 0; j < n; ++j) {
      const Float* of_row = L[j];
      for (size_t p = 0; p < j; ++p)
        row[p] = of_row[p] * D[p];
      const Float* from = S[j] + j;
      Float* to = L[j];
      size_t i = j;
      for (; i + 8 <= n; i += 8, from += 8 * M, to += 8 * M)
        eliminate<8>(from, to, j, i == j, ridge);
      for (; i + 4 <= n; i += 4, from += 4 * M, to += 4 * M)
        eliminate<4>(from, to, j, i == j, ridge);
      for (; i < n; ++i, from += M, to += M)
        eliminate<1>(from, to, j, i == j, ridge);
      Float* below = L[j] + j;
      const Float pivot = *below, inverted = 1.0f / pivot;
      D[j] = pivot;
      inverse[j] = inverted;
      for (i = j + 1; i < n; ++i) {
        below += M;
        *below *= inverted;
      }
    }
  }

  // N rows of column j, before the division by D[j]: from the elements of S to the rows of L.
  template <size_t N>
  ANICODEC_INLINE void eliminate(const Float* from, Float* to, size_t j, bool diagonal,
                                 Float ridge) {
    Float u[N];
    ANICODEC_UNROLL for (size_t e = 0; e < N; ++e) u[e] = from[e * M];
    if (diagonal)
      u[0] += ridge;
    const Float* of_row = row;
    for (const Float* end = row + j; of_row != end; ++of_row, ++to)
      ANICODEC_UNROLL for (size_t e = 0; e < N; ++e) u[e] -= to[e * M] * *of_row;
    ANICODEC_UNROLL for (size_t e = 0; e < N; ++e) to[e * M] = u[e];
  }

  void solve(const Float* right, Float* x) const {
    for (size_t i = 0; i < n; ++i)
      x[i] = right[i];
    for (size_t p = 0; p < n; ++p) {
      const Float* below = L[p] + p;
      const Float known = x[p];
      for (size_t i = p + 1; i < n; ++i) {
        below += M;
        x[i] -= *below * known;
      }
    }
    for (size_t i = 0; i < n; ++i)
      x[i] *= inverse[i];
    for (size_t i = n; i-- > 0;) {
      const Float* below = L[i] + i;
      Float sum = x[i];
      for (size_t p = i + 1; p < n; ++p) {
        below += M;
        sum -= *below * x[p];
      }
      x[i] = sum;
    }
  }
};

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_REFIT_SOLVER_H_
