// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The chunks of a file and what all who read, write, join and stream files know of them: the registry of
// spec/06-chunks.md.
#ifndef ANICODEC_FORMAT_CHUNK_KINDS_H_
#define ANICODEC_FORMAT_CHUNK_KINDS_H_

#include "format/container.h"

#include <cstdint>

namespace anicodec {

/// The owner of chunks of a type. kEither: a mesh, or a segment that has its own.
enum class ChunkOwner : uint8_t { kClip, kMesh, kSegment, kEither };

/// The place of a chunk of a segment (spec/05-file-layout.md, section 6): boxes come before all meshes, what refines all
/// that plays behind all segments.
enum class ChunkPlace : uint8_t { kBeforeMeshes, kWithSegment, kBehindSegments };

struct ChunkKind {
  char name[5];
  ChunkOwner owner;
  bool required = true;  ///< chunks are marked so, and must be
  bool copied = false;   ///< chunks are marked so, and must be
  bool repeats = false;  ///< several of one segment: its layers
  bool refines = false;  ///< a segment plays without it
  ChunkPlace place = ChunkPlace::kWithSegment;
};

/// In the order of a file.
inline constexpr ChunkKind kChunkKinds[] = {
    {"LIMI", ChunkOwner::kClip},
    {"CLIP", ChunkOwner::kClip},
    {"ROOT", ChunkOwner::kClip},
    {"META", ChunkOwner::kClip, false, true},
    {"BNDS", ChunkOwner::kSegment, false, true, false, false, ChunkPlace::kBeforeMeshes},
    {"MESH", ChunkOwner::kMesh},
    {"VMAP", ChunkOwner::kMesh},
    {"FMAP", ChunkOwner::kMesh},
    {"ATTR", ChunkOwner::kMesh, false},
    {"POSE", ChunkOwner::kEither},
    {"SEGM", ChunkOwner::kSegment},
    {"BASI", ChunkOwner::kSegment, true, false, true, true},
    {"CORR", ChunkOwner::kSegment, true, false, false, true},
    {"DIFF", ChunkOwner::kSegment, true, false, false, true, ChunkPlace::kBehindSegments}};

/// Null for types that this version does not know.
inline const ChunkKind* find_chunk_kind(uint32_t type) {
  for (const ChunkKind& kind : kChunkKinds) {
    if (chunk_type(kind.name) == type)
      return &kind;
  }
  return nullptr;
}

inline bool is_of_meshes(const ChunkKind& kind) {
  return kind.owner == ChunkOwner::kMesh || kind.owner == ChunkOwner::kEither;
}

inline bool is_of_segments(const ChunkKind& kind) {
  return kind.owner == ChunkOwner::kSegment || kind.owner == ChunkOwner::kEither;
}

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CHUNK_KINDS_H_
