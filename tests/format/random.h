// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FORMAT_RANDOM_H_
#define ANICODEC_TESTS_FORMAT_RANDOM_H_

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

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FORMAT_RANDOM_H_
