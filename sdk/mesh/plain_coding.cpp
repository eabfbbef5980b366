// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/plain_coding.h"

#include "format/zstd_block.h"

namespace anicodec {
namespace {

uint32_t unfolded(uint32_t x) {
  return x >> 1 ^ (x & 1 ? 0xFFFFFFFFU : 0);
}

}  // namespace

#if !defined(ANICODEC_DECODER_ONLY)
Bytes encode_plain_integers(const Vector<int32_t>& values, size_t stride) {
  size_t n = values.size();
  Bytes planes(4 * n);
  for (size_t i = 0; i < n; ++i) {
    auto before = i < stride ? 0U : static_cast<uint32_t>(values[i - stride]);
    const uint32_t difference = static_cast<uint32_t>(values[i]) - before;
    const uint32_t x = difference << 1 ^ (difference >> 31 ? 0xFFFFFFFFU : 0);
    for (size_t b = 0; b < 4; ++b)
      planes[b * n + i] = static_cast<uint8_t>(x >> (8 * b));
  }
  return zstd_compress(planes);
}
#endif

Status decode_plain_integers(ByteView bytes, size_t count, size_t stride, Vector<int32_t>* values) {
  Bytes planes;
  if (Status s = zstd_decompress(bytes, 4 * count, &planes); s != Status::kOk)
    return s;
  values->resize(count);
  for (size_t i = 0; i < count; ++i) {
    uint32_t x = 0;
    for (size_t b = 0; b < 4; ++b)
      x |= uint32_t{planes[b * count + i]} << (8 * b);
    auto before = i < stride ? 0U : static_cast<uint32_t>((*values)[i - stride]);
    (*values)[i] = static_cast<int32_t>(before + unfolded(x));
  }
  return Status::kOk;
}

}  // namespace anicodec
