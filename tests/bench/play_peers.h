// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_PLAY_PEERS_H_
#define ANICODEC_TESTS_BENCH_PLAY_PEERS_H_

#include <cstddef>
#include <cstdint>
#include <memory>

namespace anicodec::bench {

class Product {
 public:
  virtual ~Product() = default;
  virtual void run() = 0;
};

/// Rivals of playing, built for one instruction set.
struct PlayPeers {
  /// Reads all numbers once, from the first to the last; returns their sum.
  int32_t (*read_all)(const int16_t* q, size_t count);

  /// Independent multiply-adds in registers, so many or a few more; returns how many.
  size_t (*multiply_adds)(size_t count, float* result);

  /// Eigen's product of a float matrix, the basis, with the weights of a frame, as fast as its
  /// layout allows: eigenshapes as columns (times a vector), or eigentrajectories as columns of
  /// row-major rows (times three vectors).
  std::unique_ptr<Product> (*eigen_product)(size_t vertices, size_t components, bool trajectories);
};

extern const PlayPeers kPlayPeers256;  // AVX2 and FMA on x86, else what the build is for
extern const PlayPeers kPlayPeers512;  // AVX-512 (F, DQ, VL) on x86

/// The rivals for the instruction set of the fastest playing kernels, or null where they cannot
/// run.
const PlayPeers* play_peers();

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_PLAY_PEERS_H_
