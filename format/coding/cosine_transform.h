// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Inverse discrete cosine transform of any length in integers, the same everywhere
// (spec/08-entropy.md, section 6.4).
#ifndef ANICODEC_FORMAT_CODING_COSINE_TRANSFORM_H_
#define ANICODEC_FORMAT_CODING_COSINE_TRANSFORM_H_

#include "format/memory.h"

#include <cstdint>

namespace anicodec {

/// The orthonormal transform of `length` values (type III is the inverse of type II).
/// Memory: 16 bytes per value.
class CosineTransform {
 public:
  static constexpr uint32_t kMaxLength = 1024;
  static constexpr int32_t kLimit = 1 << 22;       ///< |coefficient| is at most this
  static constexpr int kFractionBits = 4;          ///< of what inverse() returns
  static constexpr int64_t kValueLimit = 1 << 26;  ///< |value| is limited to this

  /// @pre 0 < length <= kMaxLength
  explicit CosineTransform(uint32_t length);

  uint32_t length() const { return length_; }

  /// Values in 1/16 from integer coefficients within +-kLimit. O(length x non-zero coefficients).
  void inverse(const int32_t* coefficients, int32_t* values) const;

  /// Coefficients of real values, for encoders: not bit-exact. O(length^2): a third of the
  /// products of the definition where the length is a power of two, half of them where it is odd.
  void forward(const double* values, double* coefficients) const;

 private:
  uint32_t length_;
  int shift_;              ///< table entries are scaled by 2^shift_
  int32_t constant_;       ///< of coefficient 0
  Vector<int32_t> table_;  ///< sqrt(2 / length) cos(pi m / (2 length)), m = 0 .. 4 length - 1
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_COSINE_TRANSFORM_H_
