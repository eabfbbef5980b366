// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/continuation.h"

#include "format/checksum.h"
#include "format/records.h"

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

  /// `limits`: in place of the chunk LIMI; empty: as it is.
  Bytes bytes(uint64_t features, const Bytes& limits = {}) {
    const auto is_replaced = [&](const Chunk& chunk) {
      return !limits.empty() && chunk.type == chunk_type("LIMI");
    };
    for (Chunk& chunk : chunks) {
      if (is_replaced(chunk)) {
        chunk.size = limits.size();
        chunk.checksum = static_cast<uint32_t>(xxh64(limits));
      }
    }
    Bytes out = container_head(chunks, features);
    for (size_t i = 0; i < chunks.size(); ++i) {
      const ByteView payload =
          is_replaced(chunks[i]) ? ByteView(limits) : files[i]->unchecked(chunks[i]);
      out.insert(out.end(), payload.data, payload.data + payload.size);
    }
    return out;
  }
};

}  // namespace

uint64_t mesh_hash(const ContainerReader& file) {
  ByteWriter meshes;
  for (const Chunk& chunk : file.chunks()) {
    if (!is_of_mesh(chunk))
      continue;
    meshes.u32(chunk.type);
    meshes.u32(chunk.mesh);
    meshes.u64(xxh64(file.unchecked(chunk)));
  }
  return xxh64(meshes.bytes());
}

uint64_t segment_identity(ByteView record, const Vector<ByteView>& layers) {
  ByteWriter payloads;
  payloads.u64(xxh64(record));
  for (ByteView layer : layers)
    payloads.u64(xxh64(layer));
  return xxh64(payloads.bytes());
}

Bytes without_meshes(const ContainerReader& file) {
  Spliced out;
  out.add_if(file, false);
  Limits limits;
  if (const Chunk* chunk = file.find("LIMI"))
    Limits::read(file.unchecked(*chunk), &limits);
  limits.continued_meshes = mesh_hash(file);
  return out.bytes(file.features() | kContinuation, limits.write());
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
  return out.bytes(continuation.features() & ~kContinuation);
}

}  // namespace anicodec
