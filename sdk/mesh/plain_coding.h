// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_PLAIN_CODING_H_
#define ANICODEC_SDK_MESH_PLAIN_CODING_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// Coder 0: integers as differences, folded to unsigned, split into four byte planes, one zstd
/// frame (spec/07-topology.md). The differences are taken between entries `stride` apart.
Bytes encode_plain_integers(const Vector<int32_t>& values, size_t stride);
Status decode_plain_integers(ByteView bytes, size_t count, size_t stride, Vector<int32_t>* values);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_PLAIN_CODING_H_
