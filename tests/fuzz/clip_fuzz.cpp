// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// Any chunks through the opening of a file: checksums and places are repaired first, so that what
// is inside the chunks gets decoded. What opens, plays, with finite positions, in the memory that
// the limits announce.
#include "format/container.h"
#include "sdk/clip.h"
#include "sdk/memory.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

using namespace anicodec;

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

/// The same chunks with what the table says of them made right; as it is if there is no table.
format::Bytes repaired(format::ByteView file) {
  format::ByteReader r(file);
  r.raw(12);
  uint32_t count = r.u32();
  r.raw(format::kHeaderBytes - 16);
  if (!r.ok() || count > r.remaining() / format::kEntryBytes)
    return {file.data, file.data + file.size};

  struct Entry {
    std::string type;
    uint16_t flags, mesh;
    uint32_t segment;
    uint64_t size;
  };

  std::vector<Entry> entries;
  for (uint32_t i = 0; i < count; ++i) {
    Entry e;
    e.type = format::chunk_name(r.u32());
    e.flags = r.u16();
    e.mesh = r.u16();
    e.segment = r.u32();
    r.u32();
    r.u64();
    e.size = r.u64();
    entries.push_back(e);
  }
  format::ContainerWriter writer;
  size_t at = r.position();
  for (const Entry& e : entries) {
    at = std::min((at + 7) / 8 * 8, file.size);
    auto size = static_cast<size_t>(std::min<uint64_t>(e.size, file.size - at));
    const char type[5] = {e.type[0], e.type[1], e.type[2], e.type[3], 0};
    writer.add(type, e.flags & 1, e.mesh, e.segment, {file.data + at, file.data + at + size});
    at += size;
  }
  return writer.finish();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const format::Bytes file = repaired({data, size});
  OpenOptions options;
  options.limits.vertices = 20000;
  options.limits.resident_bytes = 64 << 20;
  Clip clip;
  if (!clip.open(file, options).ok())
    return 0;
  require(clip.resident_bytes() <= estimate_memory(clip.limits()).resident);
  for (uint32_t m = 0; m < clip.meshes().size(); ++m) {
    std::vector<float> frame(size_t{3} * clip.vertex_count(m));
    for (uint32_t f = 0; f < clip.frame_count() && f < 4; ++f) {
      if (clip.positions(m, f, frame.data()) != Status::kOk)
        continue;
      for (float x : frame)
        require(std::isfinite(x));
    }
  }
  return 0;
}
