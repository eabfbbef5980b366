// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_JOIN_CLIPS_H_
#define ANICODEC_CODEC_JOIN_CLIPS_H_

#include "format/bytes.h"

#include <string>
#include <vector>

namespace anicodec {

/// A file to be joined.
struct ClipPart {
  std::string name;  ///< for messages
  format::ByteView file;
};

/// Makes one file of parts that were encoded with EncodeOptions::part from one clip, in the order
/// of time. Their segments are taken as they are; mesh, maps and reference pose, which must be the
/// same bytes in all, are stored once. The promise is the largest error of any part, and RMSE and
/// KG error over all frames. The result has been opened and its hashes checked. Throws Error:
/// kCorrupt for a damaged part, kInput naming the first part that does not fit.
format::Bytes join_clips(const std::vector<ClipPart>& parts);

/// Makes one file of clips of one mesh each, in the order of time, whose meshes need not be alike:
/// each is there in its frames alone. Errors, promise and checks as of join_clips().
format::Bytes join_topologies(const std::vector<ClipPart>& parts);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_JOIN_CLIPS_H_
