// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_CLIP_FILE_H_
#define ANICODEC_CODEC_FILE_CLIP_FILE_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/encoded_segment.h"
#include "format/records.h"

#include <vector>

namespace anicodec {

/// Puts a file of one mesh together: limits, record of the clips, mesh, maps as the order mode asks, and
/// for each segment its record, layers and corrections, in the order in which a reader needs them;
/// segments come in the order of the file. The first reference pose is the mesh's.
Bytes clip_file(const ClipsRecord& record, const MeshLayout& layout,
                const std::vector<const EncodedSegment*>& segments);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_CLIP_FILE_H_
