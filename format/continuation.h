// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Files of a live stream that lack their meshes (spec/05-file-layout.md, section 8).
#ifndef ANICODEC_FORMAT_CONTINUATION_H_
#define ANICODEC_FORMAT_CONTINUATION_H_

#include "format/bytes.h"
#include "format/container.h"

namespace anicodec {

/// The continuation that a file becomes behind one with the same meshes.
Bytes without_meshes(const ContainerReader& file);

/// The file that a continuation is with the meshes of the file before it. Both are complete; nothing is checked but where
/// chunks are. ContainerReader::add_meshes() does without the file. O(bytes).
Bytes with_meshes(const ContainerReader& before, const ContainerReader& continuation);

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CONTINUATION_H_
