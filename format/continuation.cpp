// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/continuation.h"

namespace anicodec {
namespace {

/// Chunks, and the file that each is of.
struct Spliced {
  Vector<Chunk> chunks;
  Vector<const ContainerReader*> files;

  void add(const ContainerReader& file, const Chunk& chunk) {
    chunks.push_back(chunk);
    files.push_back(&file);
  }

  void add_if(const ContainerReader& file, bool of_mesh) {
    for (const Chunk& chunk : file.chunks()) {
      if (is_of_mesh(chunk) == of_mesh)
        add(file, chunk);
    }
  }

  Bytes bytes(uint64_t features) const {
    Bytes out = container_head(chunks, features);
    for (size_t i = 0; i < chunks.size(); ++i) {
      const ByteView payload = files[i]->unchecked(chunks[i]);
      out.insert(out.end(), payload.data, payload.data + payload.size);
    }
    return out;
  }
};

}  // namespace

Bytes without_meshes(const ContainerReader& file) {
  Spliced out;
  out.add_if(file, false);
  return out.bytes(kContinuation);
}

Bytes with_meshes(const ContainerReader& before, const ContainerReader& continuation) {
  Spliced out;
  const Vector<Chunk>& chunks = continuation.chunks();
  size_t next = 0;
  for (; next < chunks.size() && chunks[next].segment == kNoSegment; ++next)
    out.add(continuation, chunks[next]);
  out.add_if(before, true);
  for (; next < chunks.size(); ++next)
    out.add(continuation, chunks[next]);
  return out.bytes(0);
}

}  // namespace anicodec
