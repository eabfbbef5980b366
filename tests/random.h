// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_RANDOM_H_
#define ANICODEC_TESTS_RANDOM_H_

#include "format/memory.h"

#include <cstdint>
#include <random>

namespace anicodec {

/// 32 random bits per call, the same with every standard library (its distributions are not).
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}

  uint32_t operator()() { return static_cast<uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

/// A linear congruential generator: cheap, and its numbers are easy to reproduce elsewhere.
class SmallRandom {
 public:
  explicit SmallRandom(uint32_t seed) : state_(seed) {}

  uint32_t bits() { return state_ = state_ * 1664525u + 1013904223u; }

  /// In [-1, 1), a multiple of 2^-23.
  double symmetric() { return static_cast<double>(bits() >> 8) / (1 << 23) - 1; }

  /// In [0, range).
  uint32_t below(uint32_t range) { return static_cast<uint32_t>((uint64_t{bits()} * range) >> 32); }

 private:
  uint32_t state_;
};

/// FNV-1a, to pin a stream by one number.
inline uint64_t hash(const Vector<uint8_t>& bytes) {
  uint64_t h = 14695981039346656037u;
  for (const uint8_t b : bytes)
    h = (h ^ b) * 1099511628211u;
  return h;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_RANDOM_H_
