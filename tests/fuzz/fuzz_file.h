// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_FILE_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_FILE_H_

#include "format/container.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace anicodec {

/// A chunk as a table names it, and its bytes.
struct FuzzPart {
  Chunk chunk;
  Bytes payload;
};

/// A file taken apart, be its checksums and sizes right or wrong.
struct FuzzParts {
  uint64_t features = 0;
  std::vector<FuzzPart> parts;
  size_t taken = 0;  ///< bytes of the file, which others may follow

  /// False if there is no table. Payloads end where the bytes do.
  bool read(ByteView file) {
    ByteReader r(file);
    r.raw(12);
    const uint32_t count = r.u32();
    features = r.u64();
    r.raw(kHeaderBytes - 24);
    if (!r.ok() || count > r.remaining() / kLeastEntryBytes)
      return false;
    parts.resize(count);
    for (FuzzPart& part : parts) {
      Chunk& chunk = part.chunk;
      chunk.type = r.u32();
      r.u32();
      const uint8_t flags = r.u8();
      chunk.required = flags & 1;
      chunk.copied = flags & 8;
      if (flags & 2)
        chunk.mesh = static_cast<uint16_t>(r.varint());
      if (flags & 4)
        chunk.segment = static_cast<uint32_t>(r.varint());
      chunk.size = r.varint();
    }
    if (!r.ok())
      return false;
    taken = r.position();
    for (FuzzPart& part : parts) {
      const auto size = static_cast<size_t>(std::min<uint64_t>(part.chunk.size, file.size - taken));
      part.payload.assign(file.data + taken, file.data + taken + size);
      taken += size;
    }
    return true;
  }

  /// A file of the same chunks, with sizes and checksums made right.
  Bytes write() const {
    ContainerWriter writer;
    for (const FuzzPart& part : parts)
      writer.add(part.chunk, part.chunk.mesh, part.chunk.segment, part.payload);
    return writer.finish(features);
  }
};

/// The same chunks with the entries of the table made right, so that their contents get decoded; as
/// it is if there is no table.
inline Bytes repaired(ByteView file) {
  FuzzParts parts;
  return parts.read(file) ? parts.write() : Bytes(file.data, file.data + file.size);
}

/// Decisions, taken from bytes one after another; from zeros when they are used up.
class Script {
 public:
  Script(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }

  uint32_t byte() { return at_ < size_ ? data_[at_++] : 0; }

  /// In 0 .. limit - 1; 0 if there is none.
  uint32_t below(uint32_t limit) {
    const uint32_t high = byte();
    return limit == 0 ? 0 : (high << 8 | byte()) % limit;
  }

 private:
  const uint8_t* data_;
  size_t size_, at_ = 0;
};

/// The last bytes of an input, which decide what is done with it.
inline Script script_of(const uint8_t* data, size_t size) {
  const size_t length = std::min<size_t>(size, 24);
  return {data + size - length, length};
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_FILE_H_
