// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/peers/raw_cache.h"

#include "codec/sequence/error.h"

#include <span>
#include <vector>

#include <lzma.h>
#include <zstd.h>

namespace anicodec::peers {
namespace {

constexpr int kZstdLevel = 19;
constexpr uint32_t kXzPreset = 9;

uint64_t zstd_size(std::span<const float> values) {
  std::vector<char> out(ZSTD_compressBound(values.size_bytes()));
  const size_t size =
      ZSTD_compress(out.data(), out.size(), values.data(), values.size_bytes(), kZstdLevel);
  if (ZSTD_isError(size))
    throw Error(ErrorKind::kInternal, ZSTD_getErrorName(size));
  return size;
}

uint64_t xz_size(std::span<const float> values) {
  std::vector<uint8_t> out(lzma_stream_buffer_bound(values.size_bytes()));
  size_t size = 0;
  if (lzma_easy_buffer_encode(kXzPreset, LZMA_CHECK_CRC64, nullptr,
                              reinterpret_cast<const uint8_t*>(values.data()), values.size_bytes(),
                              out.data(), &size, out.size()) != LZMA_OK)
    throw Error(ErrorKind::kInternal, "xz cannot compress the positions");
  return size;
}

}  // namespace

RawCacheSize raw_cache_size(const MeshSequence& sequence) {
  const std::span<const float> positions = sequence.positions;
  return {positions.size_bytes(), zstd_size(positions), xz_size(positions)};
}

}  // namespace anicodec::peers
