// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_LEFT_OUT_H_
#define ANICODEC_CODEC_FILE_LEFT_OUT_H_

#include "codec/file/join_clips.h"
#include "format/bytes.h"

#include <string>
#include <vector>

namespace anicodec {

/// Says what join_clips(), add_clips() or remove_clips() has left out of files (spec/13-extending.md, section 5), a line for
/// each: chunks of types that this version does not know and without the flag *copied*, those that hold of the whole or of
/// the mesh in another file than the first, and optional fields of records that are written anew. None as a rule. `made`: of these
/// files. O(bytes of the files).
std::vector<std::string> list_left_out(const std::vector<ClipPart>& files, ByteView made);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_LEFT_OUT_H_
