// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// .anic files as inputs of commands: reading them, and saying what is wrong with them.
#ifndef ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_

#include "codec/sequence/error.h"
#include "format/bytes.h"
#include "format/status.h"

#include <cstdint>
#include <string>

namespace anicodec::tools {

/// True for names that end in .anic, in any case of letters.
bool is_anic(const std::string& path);

/// Throws Error(kUsage) for an output with an extension other than .anic.
void check_anic_output(const std::string& path);

/// The exit status for a status of the SDK.
ErrorKind error_kind(Status status);

/// Throws the Error of a failure: "clip.anic: offset 0x1f40, chunk SEGM: reason (detail)".
[[noreturn]] void fail_clip(const std::string& path, const Failure& failure);

/// The bytes of a file, or of the standard input if the path is "-"; of a GLB that moves by a clip
/// (clip_of_glb), those of the clip. Throws Error(kInput).
std::string read_clip_bytes(const std::string& path);

/// The bytes of the clip that the files of a live stream make; a file that has not arrived in full is left out, and named.
std::string join_stream(const std::string& path, const std::string& stream);

/// The bytes of a clip: of a live stream, join_stream(). Throws Error(kInput).
std::string read_bytes(const std::string& path);

inline ByteView view_of(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_
