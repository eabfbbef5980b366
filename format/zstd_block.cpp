// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/zstd_block.h"

#include <algorithm>

// The context in memory of ours is in the part of zstd's interface that may still change.
#define ZSTD_STATIC_LINKING_ONLY
#include <zstd.h>

namespace anicodec {
namespace {

constexpr uint8_t kFrame[] = {0x28, 0xB5, 0x2F, 0xFD};  // the magic number of a frame

}  // namespace

#if !defined(ANICODEC_DECODER_ONLY)
Bytes zstd_compress(ByteView bytes) {
  Bytes out(ZSTD_compressBound(bytes.size));
  size_t n = ZSTD_compress(out.data(), out.size(), bytes.data, bytes.size, 19);
  out.resize(ZSTD_isError(n) ? 0 : n);
  return out;
}
#endif

Status zstd_decompress(ByteView compressed, size_t size, Bytes* out) {
  // A plain frame that says how long its content is; not a skippable one, not an old one.
  if (compressed.size < sizeof kFrame ||
      !std::equal(kFrame, kFrame + sizeof kFrame, compressed.data) ||
      ZSTD_getFrameContentSize(compressed.data, compressed.size) != size)
    return Status::kZstd;
  size_t frame = ZSTD_findFrameCompressedSize(compressed.data, compressed.size);
  if (ZSTD_isError(frame) || frame != compressed.size)
    return Status::kZstd;
  out->resize(size);
  Vector<uint64_t> memory((ZSTD_estimateDCtxSize() + 7) / 8);
  ZSTD_DCtx* context = ZSTD_initStaticDCtx(memory.data(), 8 * memory.size());
  if (!context)
    return Status::kInternal;
  size_t n = ZSTD_decompressDCtx(context, out->data(), size, compressed.data, compressed.size);
  return ZSTD_isError(n) || n != size ? Status::kZstd : Status::kOk;
}

}  // namespace anicodec
