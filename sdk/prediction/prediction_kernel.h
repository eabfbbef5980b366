// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The exact arithmetic of the spatial prediction (spec/09-reconstruction.md) for W vertices at
// once.
//
// A lane is a vertex. Every sum runs over its index in ascending order in one accumulator, so that
// the number of lanes and the blocking of loops leave the bits alone. The including file is
// compiled once per instruction set: everything here has internal linkage and calls no inline
// function of another header, lest the linker pick a copy with the wrong instructions.
#ifndef ANICODEC_SDK_PREDICTION_PREDICTION_KERNEL_H_
#define ANICODEC_SDK_PREDICTION_PREDICTION_KERNEL_H_

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "sdk/base/lanes.h"
#include "sdk/prediction/prediction_job.h"
#include "sdk/prediction/prediction_rounding.h"
#include "sdk/prediction/refit_solver.h"

namespace anicodec {
namespace {

static_assert(kMaxRenewalSamples <= 32, "a decoder renews priors from its first window");

/// Rows of 4 or 8 lanes become columns; one lane stays what it is.
template <typename V>
ANICODEC_INLINE void transpose(V* r) {
  if constexpr (sizeof(V) == 16) {
    const V a = ANICODEC_SHUFFLE(r[0], r[1], 0, 4, 1, 5),
            b = ANICODEC_SHUFFLE(r[0], r[1], 2, 6, 3, 7);
    const V c = ANICODEC_SHUFFLE(r[2], r[3], 0, 4, 1, 5),
            d = ANICODEC_SHUFFLE(r[2], r[3], 2, 6, 3, 7);
    r[0] = ANICODEC_SHUFFLE(a, c, 0, 1, 4, 5);
    r[1] = ANICODEC_SHUFFLE(a, c, 2, 3, 6, 7);
    r[2] = ANICODEC_SHUFFLE(b, d, 0, 1, 4, 5);
    r[3] = ANICODEC_SHUFFLE(b, d, 2, 3, 6, 7);
  } else if constexpr (sizeof(V) == 32) {
    V t[8], u[8];
    ANICODEC_UNROLL for (size_t i = 0; i < 8; i += 2) {
      t[i] = ANICODEC_SHUFFLE(r[i], r[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
      t[i + 1] = ANICODEC_SHUFFLE(r[i], r[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    ANICODEC_UNROLL for (size_t i = 0; i < 8; i += 4)
        ANICODEC_UNROLL for (size_t h = 0; h < 2; ++h) {
      u[i + 2 * h] = ANICODEC_SHUFFLE(t[i + h], t[i + 2 + h], 0, 1, 8, 9, 4, 5, 12, 13);
      u[i + 2 * h + 1] = ANICODEC_SHUFFLE(t[i + h], t[i + 2 + h], 2, 3, 10, 11, 6, 7, 14, 15);
    }
    ANICODEC_UNROLL for (size_t i = 0; i < 4; ++i) {
      r[i] = ANICODEC_SHUFFLE(u[i], u[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
      r[i + 4] = ANICODEC_SHUFFLE(u[i], u[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
  }
}

/// Reconstructs all components of W vertices of one level.
template <size_t W, size_t M>
class BatchDecoder {
 public:
  explicit BatchDecoder(const PredictionJob& job) : job_(job) {
#if defined(ANICODEC_SMALL)
    solver_.n = job.neighbour_count;
#endif
  }

  /// count <= W ranks from `first`.
  void run(size_t first, size_t count) {
    first_ = first;
    count_ = count;
    solver_.begin();
    if (job_.continued) {
      solver_.continue_from(job_.continued + first, job_.vertices, count);
    } else {
      solver_.set_prior(job_, first, count);
      solver_.clear();
    }
    size_t next_refit = 0, next_renewal = 0;
    for (size_t begin = 0; begin < job_.samples; begin += kWindow) {
      const size_t end = begin + kWindow < job_.samples ? begin + kWindow : job_.samples;
      gather(begin, end);
      for (size_t s = begin; s < end;) {
        size_t stop = end;
        const bool refits = next_refit < job_.refit_count;
        if (refits && job_.refits[next_refit] < end)
          stop = job_.refits[next_refit];
        size_t t = s;
        for (; t + 2 <= stop; t += 2)
          reconstruct<2>(t, t - begin);
        if (t < stop)
          reconstruct<1>(t, t - begin);
        if (refits || job_.learnt) {
          solver_.accumulate(x_ + (s - begin), residual_ + (s - begin), job_.omega + s, stop - s);
          if (refits && stop == job_.refits[next_refit]) {
            if (next_renewal < job_.renewal_count && stop == job_.renewals[next_renewal]) {
              solver_.renew_prior(job_, first_, count_, x_, y_, stop);
              ++next_renewal;
            }
            solver_.refit();
            ++next_refit;
          }
        }
        s = stop;
      }
      scatter(begin, end);
    }
    if (job_.learnt)
      solver_.hand_on(count, job_.vertices, job_.learnt + first);
  }

 private:
  using Float = typename LaneTypes<W>::Float;
  static constexpr size_t kWindow = RefitSolver<W, M>::kMaxSamples;

  const float* row(size_t lane, size_t a) const {
    const size_t r = first_ + (lane < count_ ? lane : count_ - 1);
    const int32_t b = job_.neighbours[r * solver_.n + a];
    return job_.y + (b < 0 ? job_.vertices : static_cast<size_t>(b)) * job_.stride;
  }

  // W vertices by kTile samples are transposed as tiles of kTile by kTile.
  static constexpr size_t kTile = W < 8 ? W : 8;
  using Tile = typename LaneTypes<kTile>::Float;
  using UnalignedTile = typename LaneTypes<kTile>::Unaligned;

  static char* part_of(Float& lanes, size_t first) {
    return reinterpret_cast<char*>(&lanes) + first * sizeof(float);
  }

  void gather(size_t begin, size_t end) {
    for (size_t a = 0; a < solver_.n; ++a) {
      for (size_t part = 0; part < W; part += kTile) {
        const float* rows[kTile];
        for (size_t l = 0; l < kTile; ++l)
          rows[l] = row(part + l, a) + begin;
        for (size_t s = 0; s < end - begin; s += kTile) {  // rows are padded
          Tile tile[kTile];
          ANICODEC_UNROLL for (size_t l = 0; l < kTile; ++l) tile[l] =
              *reinterpret_cast<const UnalignedTile*>(rows[l] + s);
          transpose(tile);
          Float* const to = &x_[s][a];
          ANICODEC_UNROLL for (size_t e = 0; e < kTile; ++e)
              ANICODEC_COPY(part_of(to[e * M], part), &tile[e], sizeof(Tile));
        }
      }
    }
  }

  void scatter(size_t begin, size_t end) {
    for (size_t part = 0; part < count_; part += kTile) {
      const size_t rows = count_ - part < kTile ? count_ - part : kTile;
      for (size_t s = 0; s < end - begin; s += kTile) {
        Tile tile[kTile] = {};
        for (size_t e = 0; e < kTile && s + e < end - begin; ++e)
          ANICODEC_COPY(&tile[e], part_of(y_[s + e], part), sizeof(Tile));
        transpose(tile);
        for (size_t l = 0; l < rows; ++l)
          *reinterpret_cast<UnalignedTile*>(job_.y + (first_ + part + l) * job_.stride + begin +
                                            s) = tile[l];
      }
    }
  }

  template <typename Narrow>
  Float load(const Narrow* q) const {
#if defined(__wasm_simd128__)
    if constexpr (W == 4 && sizeof(Narrow) == 2) {
      if (count_ == W)
        return widened_four(q);
    }
#endif
    typedef Narrow Vector ANICODEC_VECTOR(sizeof(Narrow) * W);
    Vector v;
    if (count_ == W) {
      ANICODEC_COPY(&v, q, sizeof v);
    } else {
      for (size_t l = 0; l < W; ++l)
        v[l] = q[l < count_ ? l : count_ - 1];
    }
    return ANICODEC_CONVERT(v, Float);
  }

  /// N samples together, whose sums do not wait for one another.
  template <size_t N>
  ANICODEC_INLINE void reconstruct(size_t s, size_t in_window) {
    const Float* x = x_[in_window];
    Float p[N]{}, p0[N]{};
    for (size_t a = 0; a < solver_.n; ++a, ++x) {
      const Float w = solver_.weights[a], w0 = solver_.prior[a];
      ANICODEC_UNROLL for (size_t e = 0; e < N; ++e) {
        p[e] += w * x[e * M];
        p0[e] += w0 * x[e * M];
      }
    }
    for (size_t e = 0; e < N; ++e)
      finish(s + e, in_window + e, p[e], p0[e]);
  }

  /// A sample from its prediction, and from that of the prior.
  void finish(size_t s, size_t in_window, Float p, Float p0) {
    const Float q = s < job_.wide_samples
                        ? load(job_.wide + s * job_.vertices + first_)
                        : load(job_.narrow + (s - job_.wide_samples) * job_.vertices + first_);
    const Float y = limited_coefficient(rounded_prediction(p) + q);
    y_[in_window] = y;
    residual_[in_window] = y - p0;
  }

  const PredictionJob& job_;
  size_t first_ = 0, count_ = 0;
  RefitSolver<W, M> solver_;
  Float x_[kWindow + W][M], y_[kWindow], residual_[kWindow];
};

template <size_t W, size_t M>
void reconstruct_ranks(const PredictionJob& job, size_t first, size_t last) {
  BatchDecoder<W, M> decoder(job);
  for (size_t r = first; r < last; r += W)
    decoder.run(r, last - r < W ? last - r : W);
}

template <size_t W>
void reconstruct_any(const PredictionJob& job, size_t first, size_t last) {
#if defined(ANICODEC_SMALL)
  if (job.neighbour_count % 4 == 0 && job.neighbour_count <= 24)
    reconstruct_ranks<W, 24>(job, first, last);
#else
  switch (job.neighbour_count) {
    case 8:
      return reconstruct_ranks<W, 8>(job, first, last);
    case 12:
      return reconstruct_ranks<W, 12>(job, first, last);
    case 16:
      return reconstruct_ranks<W, 16>(job, first, last);
    case 20:
      return reconstruct_ranks<W, 20>(job, first, last);
    case 24:
      return reconstruct_ranks<W, 24>(job, first, last);
    default:
      return;
  }
#endif
}

/// The state of W vertices between two components of the encoder.
template <size_t W, size_t M>
class EncoderBlock {
 public:
  EncoderBlock(const EncoderJob& job, size_t block)
      : job_(job),
        first_(block * W),
        count_(job.vertices - first_ < W ? job.vertices - first_ : W),
        state_(job.state + block * encoder_block_rows(M) * W) {}

  void start() {
    if (job_.continued) {
      solver_.continue_from(job_.continued + first_, job_.vertices, count_);
    } else {
      solver_.set_prior(prediction_job(), first_, count_);
      solver_.clear();
    }
    float* to = state_;
    move<false>(solver_.weights, to);
    move<false>(solver_.prior, to);
    store_sums(to);
  }

  void update() {
    float* from = state_;
    move<true>(solver_.weights, from);
    move<true>(solver_.prior, from);
    float* const sums = from;
    move<true>(solver_.g, from);
    for (size_t a = 0; a < M; ++a)
      for (size_t b = 0; b <= a; ++b)
        load(solver_.A[a][b], from);
    Float x[3][M], residual[3];
    float omega[3];
    for (size_t c = 0; c < job_.channels; ++c) {
      Float value, p0{};
      gather(job_.y + c * (job_.vertices + 1), x[c], &value);
      for (size_t a = 0; a < M; ++a)
        p0 += solver_.prior[a] * x[c][a];
      residual[c] = value - p0;
      omega[c] = job_.omega;
    }
    solver_.accumulate(x, residual, omega, job_.channels);
    float* to = sums;
    store_sums(to);
    if (job_.refit) {
      to = state_;
      if (job_.renew)
        renew_prior();
      solver_.refit();
      move<false>(solver_.weights, to);
      if (job_.renew) {
        move<false>(solver_.prior, to);
        move<false>(solver_.g, to);
      }
    }
  }

 private:
  using Float = typename LaneTypes<W>::Float;

  static void load(Float& value, float*& at) {
    ANICODEC_COPY(&value, at, sizeof value);
    at += W;
  }

  static void store(const Float& value, float*& at) {
    ANICODEC_COPY(at, &value, sizeof value);
    at += W;
  }

  PredictionJob prediction_job() const {
    PredictionJob job;
    job.neighbours = job_.neighbours;
    job.positions = job_.positions;
    job.radius = job_.radius;
    job.alike = job_.alike;
    return job;
  }

  void renew_prior() {
    Float x[kMaxRenewalSamples][M], y[kMaxRenewalSamples];
    const size_t before = job_.earlier_samples, samples = before + job_.channels;
    for (size_t s = 0; s < samples; ++s) {
      const float* of_sample = s < before ? job_.earlier + s * (job_.vertices + 1)
                                          : job_.y + (s - before) * (job_.vertices + 1);
      gather(of_sample, x[s], &y[s]);
    }
    solver_.renew_prior(prediction_job(), first_, count_, x, y, samples);
  }

  /// A sample of the neighbours and of the vertices themselves.
  void gather(const float* of_sample, Float* x, Float* y) const {
    for (size_t l = 0; l < W; ++l) {
      const size_t r = first_ + (l < count_ ? l : count_ - 1);
      (*y)[l] = of_sample[r];
      for (size_t a = 0; a < M; ++a) {
        const int32_t b = job_.neighbours[r * M + a];
        x[a][l] = of_sample[b < 0 ? job_.vertices : static_cast<size_t>(b)];
      }
    }
  }

  template <bool kLoad>
  static void move(Float* values, float*& at) {
    for (size_t a = 0; a < M; ++a)
      kLoad ? load(values[a], at) : store(values[a], at);
  }

  void store_sums(float*& at) {
    move<false>(solver_.g, at);
    for (size_t a = 0; a < M; ++a)
      for (size_t b = 0; b <= a; ++b)
        store(solver_.A[a][b], at);
  }

  const EncoderJob& job_;
  size_t first_, count_;
  float* state_;
  RefitSolver<W, M> solver_;
};

template <size_t W, size_t M>
void start_all(const EncoderJob& job, size_t first, size_t last) {
  for (size_t b = first; b < last; ++b)
    EncoderBlock<W, M>(job, b).start();
}

template <size_t W, size_t M>
void update_all(const EncoderJob& job, size_t first, size_t last) {
  for (size_t b = first; b < last; ++b)
    EncoderBlock<W, M>(job, b).update();
}

template <size_t W>
void start_any(const EncoderJob& job, size_t first, size_t last) {
  switch (job.neighbour_count) {
    case 8:
      return start_all<W, 8>(job, first, last);
    case 12:
      return start_all<W, 12>(job, first, last);
    case 16:
      return start_all<W, 16>(job, first, last);
    case 20:
      return start_all<W, 20>(job, first, last);
    case 24:
      return start_all<W, 24>(job, first, last);
    default:
      return;
  }
}

template <size_t W>
void update_any(const EncoderJob& job, size_t first, size_t last) {
  switch (job.neighbour_count) {
    case 8:
      return update_all<W, 8>(job, first, last);
    case 12:
      return update_all<W, 12>(job, first, last);
    case 16:
      return update_all<W, 16>(job, first, last);
    case 20:
      return update_all<W, 20>(job, first, last);
    case 24:
      return update_all<W, 24>(job, first, last);
    default:
      return;
  }
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_PREDICTION_KERNEL_H_
