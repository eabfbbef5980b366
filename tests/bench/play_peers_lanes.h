// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Rivals of playing. The including file is compiled once per instruction set, and gives Eigen
// another name there, lest the linker mix its functions with those for other vectors.
#ifndef ANICODEC_TESTS_BENCH_PLAY_PEERS_LANES_H_
#define ANICODEC_TESTS_BENCH_PLAY_PEERS_LANES_H_

#include "tests/bench/play_peers.h"

#include <cstring>

#include <Eigen/Core>

#if defined(__FMA__)
#include <immintrin.h>
#endif

namespace anicodec::bench {
namespace {

#if defined(__AVX512F__)
constexpr size_t kLanes = 16;
#elif defined(__AVX2__)
constexpr size_t kLanes = 8;
#else
constexpr size_t kLanes = 4;
#endif
typedef float Floats __attribute__((vector_size(4 * kLanes)));
typedef int32_t Ints __attribute__((vector_size(4 * kLanes)));

inline Floats multiply_add(Floats a, Floats b, Floats c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_ps(a, b, c);
#elif defined(__FMA__)
  return _mm256_fmadd_ps(a, b, c);
#else
  return a * b + c;
#endif
}

inline Ints load(const int16_t* q) {
  Ints v;
  std::memcpy(&v, q, sizeof v);
  return v;
}

int32_t read_all(const int16_t* q, size_t count) {
  Ints a{}, b{}, c{}, d{};
  constexpr size_t kStep = 2 * kLanes;
  for (size_t i = 0; i + 4 * kStep <= count; i += 4 * kStep) {
    a += load(q + i);
    b += load(q + i + kStep);
    c += load(q + i + 2 * kStep);
    d += load(q + i + 3 * kStep);
  }
  const Ints sum = (a + b) + (c + d);
  int32_t total = 0;
  for (size_t l = 0; l < kLanes; ++l)
    total += sum[l];
  return total;
}

size_t multiply_adds(size_t count, float* result) {
  const Floats one = Floats{} + 1.0F, m = one * 0.999F, c = one * 0.001F;
  // Different ones, lest the compiler make one of them.
  Floats a0 = one, a1 = one * 2, a2 = one * 3, a3 = one * 4, a4 = one * 5, a5 = one * 6,
         a6 = one * 7, a7 = one * 8, a8 = one * 9, a9 = one * 10;
  size_t done = 0;
  for (; done < count; done += 10 * kLanes) {
    a0 = multiply_add(a0, m, c);
    a1 = multiply_add(a1, m, c);
    a2 = multiply_add(a2, m, c);
    a3 = multiply_add(a3, m, c);
    a4 = multiply_add(a4, m, c);
    a5 = multiply_add(a5, m, c);
    a6 = multiply_add(a6, m, c);
    a7 = multiply_add(a7, m, c);
    a8 = multiply_add(a8, m, c);
    a9 = multiply_add(a9, m, c);
  }
  *result = (a0 + a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9)[0];
  return done;
}

class EigenProduct final : public Product {
 public:
  EigenProduct(size_t vertices, size_t components, bool trajectories)
      : trajectories_(trajectories) {
    auto n = static_cast<Eigen::Index>(vertices), k = static_cast<Eigen::Index>(components);
    if (trajectories) {
      rows_.setConstant(n, k, 0.5F);
      weights_.setConstant(k, 3, 0.25F);
      points_.resize(n, 3);
    } else {
      shapes_.setConstant(3 * n, k, 0.5F);
      weight_.setConstant(k, 0.25F);
      point_.resize(3 * n);
    }
  }

  void run() override {
    if (trajectories_)
      points_.noalias() = rows_ * weights_;
    else
      point_.noalias() = shapes_ * weight_;
  }

 private:
  bool trajectories_;
  Eigen::MatrixXf shapes_;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> weights_, points_;
  Eigen::VectorXf weight_, point_;
};

std::unique_ptr<Product> eigen_product(size_t vertices, size_t components, bool trajectories) {
  return std::make_unique<EigenProduct>(vertices, components, trajectories);
}

}  // namespace
}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_PLAY_PEERS_LANES_H_
