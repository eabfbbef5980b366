// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_FILE_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_FILE_H_

#include "format/container.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace anicodec {

/// The same chunks with what the table says of them made right, so that what is inside them gets
/// decoded; as it is if there is no table.
inline Bytes repaired(ByteView file) {
  ByteReader r(file);
  r.raw(12);
  uint32_t count = r.u32();
  const uint64_t features = r.u64();
  r.raw(kHeaderBytes - 24);
  if (!r.ok() || count > r.remaining() / kLeastEntryBytes)
    return {file.data, file.data + file.size};

  struct Entry {
    std::string type;
    bool required = false;
    uint16_t mesh = kNoMesh;
    uint32_t segment = kNoSegment;
    uint64_t size = 0;
  };

  std::vector<Entry> entries;
  for (uint32_t i = 0; i < count; ++i) {
    Entry e;
    e.type = chunk_name(r.u32());
    r.u32();
    const uint8_t flags = r.u8();
    e.required = flags & 1;
    if (flags & 2)
      e.mesh = static_cast<uint16_t>(r.varint());
    if (flags & 4)
      e.segment = static_cast<uint32_t>(r.varint());
    e.size = r.varint();
    entries.push_back(e);
  }
  if (!r.ok())
    return {file.data, file.data + file.size};
  ContainerWriter writer;
  size_t at = r.position();
  for (const Entry& e : entries) {
    auto size = static_cast<size_t>(std::min<uint64_t>(e.size, file.size - at));
    const char type[5] = {e.type[0], e.type[1], e.type[2], e.type[3], 0};
    writer.add(type, e.required, e.mesh, e.segment, {file.data + at, file.data + at + size});
    at += size;
  }
  return writer.finish(features);
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
