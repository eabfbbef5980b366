// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_RANDOM_H_
#define ANICODEC_CODEC_SEQUENCE_RANDOM_H_

#include <cstdint>

namespace anicodec {

/// SplitMix64 (Steele, Lea and Flood 2014): the same numbers on every machine and in every library.
class SplitMix64 {
 public:
  explicit SplitMix64(uint64_t seed) : state_(seed) {}

  /// 64 random bits.
  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// In [low, high), a multiple of (high - low) / 2^32.
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 32) / 4294967296.0;
  }

 private:
  uint64_t state_;
};

/// The linear congruential generator of Knuth's MMIX, for numbers that need not be good.
class LinearCongruence {
 public:
  explicit LinearCongruence(uint64_t seed) : state_(seed) {}

  /// In [-1, 1), a multiple of 2^-23.
  double symmetric() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 40) / (1 << 23) - 1;
  }

 private:
  uint64_t state_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_RANDOM_H_
