// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Built with -mavx2 -mfma on x86. Eigen gets another namespace, lest the linker mix its functions
// with those that the rest of the program has for other vectors.
#define Eigen EigenOfPeers
#include "tests/bench/play_peers.h"

#include <cstring>

#include <Eigen/Core>

#if defined(__FMA__)
#include <immintrin.h>
#endif

namespace anicodec::bench {
namespace {

#if defined(__AVX2__)
constexpr size_t kLanes = 8;
#else
constexpr size_t kLanes = 4;
#endif
typedef float Floats __attribute__((vector_size(4 * kLanes)));
typedef int32_t Ints __attribute__((vector_size(4 * kLanes)));

inline Floats multiply_add(Floats a, Floats b, Floats c) {
#if defined(__FMA__)
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

}  // namespace

bool peers_run_here() {
#if defined(__AVX2__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
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

struct EigenProduct::Matrices {
  bool trajectories;
  Eigen::MatrixXf shapes;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows;
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> weights, points;
  Eigen::VectorXf weight, point;
};

EigenProduct::EigenProduct(size_t vertices, size_t components, bool trajectories)
    : matrices_(std::make_unique<Matrices>()) {
  Matrices& m = *matrices_;
  m.trajectories = trajectories;
  auto n = static_cast<Eigen::Index>(vertices), k = static_cast<Eigen::Index>(components);
  if (trajectories) {
    m.rows.setConstant(n, k, 0.5F);
    m.weights.setConstant(k, 3, 0.25F);
    m.points.resize(n, 3);
  } else {
    m.shapes.setConstant(3 * n, k, 0.5F);
    m.weight.setConstant(k, 0.25F);
    m.point.resize(3 * n);
  }
}

EigenProduct::~EigenProduct() = default;

void EigenProduct::run() {
  Matrices& m = *matrices_;
  if (m.trajectories)
    m.points.noalias() = m.rows * m.weights;
  else
    m.point.noalias() = m.shapes * m.weight;
}

}  // namespace anicodec::bench
