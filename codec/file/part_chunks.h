// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Shared by joining and editing of files: their chunks are compared and copied as they are.
#ifndef ANICODEC_CODEC_FILE_PART_CHUNKS_H_
#define ANICODEC_CODEC_FILE_PART_CHUNKS_H_

#include "codec/file/join_clips.h"
#include "codec/sequence/error.h"
#include "format/bytes.h"
#include "format/chunk_kinds.h"
#include "format/container.h"
#include "sdk/clip/file_checks.h"

#include <algorithm>
#include <string>

namespace anicodec {

/// The place of a chunk of a segment; an unknown chunk stands with its segment.
inline ChunkPlace place_of(const Chunk& chunk) {
  const ChunkKind* kind = find_chunk_kind(chunk.type);
  return kind ? kind->place : ChunkPlace::kWithSegment;
}

/// Whether a chunk goes along with its segment to another file.
inline bool goes_along(const Chunk& chunk) {
  const ChunkKind* kind = find_chunk_kind(chunk.type);
  return chunk.copied || (kind && is_of_segments(*kind));
}

[[noreturn]] inline void fail(const ClipPart& part, ErrorKind kind, const std::string& text) {
  throw Error(kind, part.name + ": " + text);
}

/// Fails where a part has a chunk that no program but one that knows it may leave out.
template <class Part>
void check_known_chunks(const Part& opened, const ClipPart& part) {
  const Failure failure = check_chunks(opened.reader);
  if (failure.status == Status::kChunkUnknown)
    fail(part, ErrorKind::kUnsupported,
         "has a chunk " + chunk_name(failure.chunk) + " that this version does not know");
  if (!failure.ok())
    fail(part, ErrorKind::kCorrupt, status_string(failure.status));
}

inline bool equal(ByteView a, ByteView b) {
  return a.size == b.size && std::equal(a.data, a.data + a.size, b.data);
}

inline Bytes copy(ByteView view) {
  return Bytes(view.data, view.data + view.size);
}

/// Adds the chunks marked as copied that a part has for a mesh, or for the file as a whole (kNoMesh). Part: has `reader`
/// and payload().
template <class Part>
void add_copied(const Part& part, uint16_t mesh, ContainerWriter& file) {
  for (const Chunk& chunk : part.reader.chunks()) {
    if (chunk.copied && chunk.mesh == mesh && chunk.segment == kNoSegment)
      file.add(chunk, mesh, kNoSegment,
               Bytes(part.payload(chunk).data, part.payload(chunk).data + chunk.size));
  }
}

/// Adds the chunks of the only mesh of a part as a whole.
template <class Part>
void add_mesh(const Part& part, ContainerWriter& file) {
  for (const ChunkKind& kind : kChunkKinds) {
    const Chunk* chunk = is_of_meshes(kind) ? part.reader.find(kind.name, 0) : nullptr;
    if (chunk)
      file.add(*chunk, 0, kNoSegment, copy(part.payload(*chunk)));
  }
  add_copied(part, 0, file);
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_PART_CHUNKS_H_
