// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_FORMAT_ZSTD_BLOCK_H_
#define ANICODEC_FORMAT_ZSTD_BLOCK_H_

#include "format/bytes.h"
#include "format/status.h"

namespace anicodec {

/// One zstd frame (RFC 8878) at the highest ordinary level. The size before compression is not in
/// the result: the caller stores it. Not in builds of the decoder alone.
Bytes zstd_compress(ByteView bytes);

/// Decompresses exactly one zstd frame into exactly `size` bytes, else kZstd. `out` is resized; the
/// caller has checked `size` against its limits. Memory: about 96 kB beside that.
Status zstd_decompress(ByteView compressed, size_t size, Bytes* out);

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_ZSTD_BLOCK_H_
