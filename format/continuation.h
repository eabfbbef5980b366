// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files of a live stream, which lack their meshes (spec/05-file-layout.md, section 8), and what their segments continue.
#ifndef ANICODEC_FORMAT_CONTINUATION_H_
#define ANICODEC_FORMAT_CONTINUATION_H_

#include "format/bytes.h"
#include "format/container.h"

namespace anicodec {

/// Identifies the meshes of a file: XXH64 over the type, the mesh and the XXH64 of the payload of each chunk that
/// belongs to a mesh and to no segment, in the order of the file. All payloads are there. O(bytes of the meshes).
uint64_t mesh_hash(const ContainerReader& file);

/// Identifies a segment with all that it continues: XXH64 over the XXH64 of the payload of its chunk SEGM, then of those of its
/// chunks BASI in the order of the file. O(bytes).
uint64_t segment_identity(ByteView record, const Vector<ByteView>& layers);

/// Drops the meshes of a file, which then continues a file with the same meshes. @pre the limits of `file` are valid
Bytes without_meshes(const ContainerReader& file);

/// Returns the complete file that a continuation stands for: its own chunks and the mesh chunks of `before`. Both files
/// are there in full; only places of chunks are checked. ContainerReader::add_meshes() does without the file. O(bytes).
Bytes with_meshes(const ContainerReader& before, const ContainerReader& continuation);

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CONTINUATION_H_
