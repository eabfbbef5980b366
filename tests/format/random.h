// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FORMAT_RANDOM_H_
#define ANICODEC_TESTS_FORMAT_RANDOM_H_

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

/// FNV-1a, to pin a stream by one number.
inline uint64_t hash(const Vector<uint8_t>& bytes) {
  uint64_t h = 14695981039346656037u;
  for (const uint8_t b : bytes)
    h = (h ^ b) * 1099511628211u;
  return h;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FORMAT_RANDOM_H_
