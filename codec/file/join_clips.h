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

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_JOIN_CLIPS_H_
