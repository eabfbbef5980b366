// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// What joining and editing files have in common: their chunks are compared and copied as they are.
#ifndef ANICODEC_CODEC_FILE_PART_CHUNKS_H_
#define ANICODEC_CODEC_FILE_PART_CHUNKS_H_

#include "codec/file/join_clips.h"
#include "codec/sequence/error.h"
#include "format/bytes.h"
#include "format/container.h"

#include <algorithm>
#include <string>

namespace anicodec {

/// The chunks that a mesh has once.
inline constexpr const char (*kMeshChunks[])[5] = {&"MESH", &"VMAP", &"FMAP", &"ATTR", &"POSE"};

/// Whether a chunk of a segment comes behind those of all segments: what refines all that plays.
inline bool is_last(const Chunk& chunk) {
  return chunk.type == chunk_type("DIFF");
}

[[noreturn]] inline void fail(const ClipPart& part, ErrorKind kind, const std::string& text) {
  throw Error(kind, part.name + ": " + text);
}

inline bool equal(ByteView a, ByteView b) {
  return a.size == b.size && std::equal(a.data, a.data + a.size, b.data);
}

inline Bytes copy(ByteView view) {
  return Bytes(view.data, view.data + view.size);
}

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_PART_CHUNKS_H_
