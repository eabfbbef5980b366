// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_CLIP_FILE_H_
#define ANICODEC_CODEC_FILE_CLIP_FILE_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/encoded_segment.h"
#include "format/records.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Puts a file of one mesh together: limits, record of the clips, mesh, maps as the order mode asks, and
/// for each segment its record, layers and corrections, in the order in which a reader needs them. The first
/// reference pose is the mesh's.
Bytes clip_file(const ClipsRecord& record, const MeshLayout& layout,
                const std::vector<const EncodedSegment*>& segments);

/// The bytes that it would have: without checksums and copies of streams.
size_t clip_file_bytes(const ClipsRecord& record, const MeshLayout& layout,
                       const std::vector<const EncodedSegment*>& segments);

/// Frames of a mesh that go to a file of several.
struct MeshRun {
  const MeshLayout* layout;  ///< of several runs of a mesh the first one's counts
  std::vector<const EncodedSegment*> segments;
  uint16_t mesh = 0;         ///< ascending from 0, none left out
  uint32_t first_frame = 0;  ///< of the file: its segments count from there
};

/// The same for several meshes, each of which is there in its runs alone. `frames`: of the file. Metadata are those of
/// the first layout.
Bytes scene_file(const ClipsRecord& record, uint32_t frames, const std::vector<MeshRun>& runs);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_CLIP_FILE_H_
