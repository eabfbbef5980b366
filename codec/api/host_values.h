// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Values of the host. Functions throw EncoderFailure(ANIC_E_ARGUMENT).
#ifndef ANICODEC_CODEC_API_HOST_VALUES_H_
#define ANICODEC_CODEC_API_HOST_VALUES_H_

#include "codec/api/guarded.h"

#include <anicodec/encode.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace anicodec {

[[noreturn]] inline void refuse(const std::string& text) {
  throw EncoderFailure(ANIC_E_ARGUMENT, text);
}

/// An enumerator of the host as one of ours. Throws for a number that is not in the table.
template <class Ours, class Theirs, size_t kCount>
Ours chosen(Theirs value, const Ours (&table)[kCount], const char* what) {
  const auto i = static_cast<size_t>(value);
  if (static_cast<int32_t>(value) < 0 || i >= kCount)
    refuse(std::string(what) + ": there is no choice " +
           std::to_string(static_cast<int32_t>(value)));
  return table[i];
}

/// A number up to `most`; 0 stands for the default.
inline uint32_t within(uint32_t value, uint32_t standard, uint32_t most, const char* what) {
  if (value > most)
    refuse(std::string(what) + " must be from 1 to " + std::to_string(most) + ", not " +
           std::to_string(value));
  return value == 0 ? standard : value;
}

/// A number that is finite and not negative.
inline double amount(double value, const char* what) {
  if (!(std::isfinite(value) && value >= 0))
    refuse(std::string(what) + " must be finite and not negative");
  return value;
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_API_HOST_VALUES_H_
