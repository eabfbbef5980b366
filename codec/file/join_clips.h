// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_JOIN_CLIPS_H_
#define ANICODEC_CODEC_FILE_JOIN_CLIPS_H_

#include "format/bytes.h"
#include "format/records.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec {

/// A file to be joined.
struct ClipPart {
  std::string name;  ///< for messages
  ByteView file;
};

/// Makes one file of parts that were encoded with EncodeOptions::part from one clip, given in any
/// order. Their segments are taken as they are; mesh, maps and reference pose, which must be the
/// same bytes in all, are stored once. The promise is the largest error of any part, and RMSE and
/// KG error over all frames. The result has been opened and its hashes checked. Throws Error:
/// kCorrupt for a damaged part, kInput naming the first part that does not fit.
Bytes join_clips(const std::vector<ClipPart>& parts);

/// A clip of one mesh, and where it goes.
struct PlacedPart {
  ClipPart part;
  uint16_t mesh = 0;         ///< parts of one mesh are encoded with EncodeOptions::part
  uint32_t first_frame = 0;  ///< of the joined clip
};

/// Makes one file of clips of one mesh each, of several meshes: each is there in the frames of its
/// parts alone. Meshes are numbered from 0, none left out. `record` describes the clips of the
/// file; its promised errors must be true. Checks and errors as of join_clips().
Bytes join_meshes(const std::vector<PlacedPart>& parts, uint32_t frames, const ClipsRecord& record);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_JOIN_CLIPS_H_
