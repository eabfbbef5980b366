// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_PLAY_PEERS_H_
#define ANICODEC_TESTS_BENCH_PLAY_PEERS_H_

#include <cstddef>
#include <cstdint>
#include <memory>

namespace anicodec::bench {

/// What playing is compared with, built for the instruction set of the fastest playing kernels.

/// Whether this machine runs them.
bool peers_run_here();

/// Reads all numbers once, from the first to the last; returns their sum.
int32_t read_all(const int16_t* q, size_t count);

/// Independent multiply-adds in registers, so many or a few more; returns how many.
size_t multiply_adds(size_t count, float* result);

/// Eigen's product of a float matrix, the basis, with the weights of a frame, as fast as its layout
/// allows: eigenshapes as columns (times a vector), or eigentrajectories as columns of row-major
/// rows (times three vectors).
class EigenProduct {
 public:
  EigenProduct(size_t vertices, size_t components, bool trajectories);
  ~EigenProduct();

  void run();

 private:
  struct Matrices;
  std::unique_ptr<Matrices> matrices_;
};

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_PLAY_PEERS_H_
