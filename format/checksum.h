// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_CHECKSUM_H_
#define ANICODEC_FORMAT_CHECKSUM_H_

#include "format/bytes.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// XXH64 with seed 0.
uint64_t xxh64(ByteView view);

/// XXH64 of a sequence of little-endian integers, fed in pieces: the hash by which a segment proves
/// that it was decoded bit-exactly.
class IntegerHash {
 public:
  IntegerHash();
  IntegerHash(const IntegerHash&) = delete;
  IntegerHash& operator=(const IntegerHash&) = delete;

  void add(const int32_t* values, size_t count);
  uint64_t digest() const;

 private:
  alignas(8) unsigned char state_[96];
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CHECKSUM_H_
