// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/checksum.h"

#include "format/compiler.h"

#include <new>

#include <xxhash.h>

namespace anicodec {

uint64_t xxh64(ByteView view) {
  return XXH64(view.data, view.size, 0);
}

IntegerHash::IntegerHash() {
  static_assert(sizeof(XXH64_state_t) <= sizeof(state_), "XXH64 state");
  XXH64_reset(new (state_) XXH64_state_t, 0);
}

void IntegerHash::add(const int32_t* values, size_t count) {
  auto* state = reinterpret_cast<XXH64_state_t*>(state_);
#if !defined(ANICODEC_BIG_ENDIAN)
  XXH64_update(state, values, count * sizeof *values);
#else
  uint8_t piece[1024];
  for (size_t i = 0; i < count;) {
    size_t n = 0;
    for (; n < sizeof piece && i < count; ++i, n += 4) {
      auto x = static_cast<uint32_t>(values[i]);
      for (size_t b = 0; b < 4; ++b)
        piece[n + b] = static_cast<uint8_t>(x >> (8 * b));
    }
    XXH64_update(state, piece, n);
  }
#endif
}

uint64_t IntegerHash::digest() const {
  return XXH64_digest(reinterpret_cast<const XXH64_state_t*>(state_));
}

}  // namespace anicodec
