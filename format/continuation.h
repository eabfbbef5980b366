// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files of a live stream that lack their meshes (spec/05-file-layout.md, section 8).
#ifndef ANICODEC_FORMAT_CONTINUATION_H_
#define ANICODEC_FORMAT_CONTINUATION_H_

#include "format/bytes.h"
#include "format/container.h"

namespace anicodec {

/// Whether a chunk is of a mesh as a whole: continuations have none.
inline bool is_of_mesh(const Chunk& chunk) {
  return chunk.mesh != kNoMesh && chunk.segment == kNoSegment;
}

/// The continuation that a file becomes behind one with the same meshes.
Bytes without_meshes(const ContainerReader& file);

/// A container of the chunks that a file's meshes are in, all of which are there.
Bytes only_meshes(const ContainerReader& file);

/// The file that a continuation is with the meshes of the file that it continues, or of only_meshes() of it; of a
/// continuation that has not arrived in full, as many bytes as can be told, which are the first ones of that file.
/// Nothing is checked but where chunks are. O(bytes).
Bytes with_meshes(const ContainerReader& meshes, const ContainerReader& continuation);

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CONTINUATION_H_
