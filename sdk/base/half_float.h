// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_BASE_HALF_FLOAT_H_
#define ANICODEC_SDK_BASE_HALF_FLOAT_H_

#include "sdk/base/lanes.h"

#include <cstdint>

namespace anicodec {
namespace {

/// IEEE binary32 to binary16, rounded to nearest even, as F16C does it; the result is in the low 16
/// bits. `Float` and `Int` are float and int32_t, or vectors of them.
template <typename Float, typename Int>
ANICODEC_INLINE Int half_bits(Float x) {
  Int bits;
  ANICODEC_COPY(&bits, &x, sizeof bits);
  const Int sign = (bits >> 16) & 0x8000;
  const Int magnitude = bits & 0x7fffffff;
  // The exponent moves from bias 127 to 15, 13 bits of the mantissa are rounded off. A carry into
  // the exponent is right, up to infinity.
  const Int normal = (magnitude - (112 << 23) + 0xfff + ((magnitude >> 13) & 1)) >> 13;
  // A multiple of 2^-24, as the spacing of floats from 0.5 on is 2^-24 too.
  Float shifted;
  ANICODEC_COPY(&shifted, &magnitude, sizeof shifted);
  shifted += 0.5F;
  Int subnormal;
  ANICODEC_COPY(&subnormal, &shifted, sizeof subnormal);
  subnormal -= 126 << 23;
  const Int nan = (magnitude >> 13 & 0x3ff) | 0x7e00;
  Int result = magnitude < (113 << 23) ? subnormal : normal;
  result = magnitude >= (143 << 23) ? Int{} + 0x7c00 : result;
  result = magnitude > 0x7f800000 ? nan : result;
  return sign | result;
}

}  // namespace
}  // namespace anicodec

#endif  // ANICODEC_SDK_BASE_HALF_FLOAT_H_
