// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// .anic files as inputs of commands: reading, opening, playing, and saying what is wrong with them.
#ifndef ANICODEC_TOOLS_CLIP_INPUT_H_
#define ANICODEC_TOOLS_CLIP_INPUT_H_

#include "codec/error.h"
#include "codec/frame_source.h"
#include "codec/mesh_sequence.h"
#include "format/bytes.h"
#include "format/status.h"
#include "sdk/clip.h"

#include <string>

namespace anicodec::tools {

/// True for names that end in .anic, in any case of letters.
bool is_anic(const std::string& path);

/// What a status of the SDK means for the exit status.
ErrorKind error_kind(Status status);

/// Throws the Error of a failure: "clip.anic: offset 0x1f40, chunk SEGM: reason (detail)".
[[noreturn]] void fail_clip(const std::string& path, const Failure& failure);

/// The bytes of a file, or of the standard input if the path is "-". Throws Error(kInput).
std::string read_bytes(const std::string& path);

inline format::ByteView view_of(const std::string& bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

/// Opens a clip of one mesh. Throws as fail_clip(); Error(kUnsupported) for several meshes.
void open_clip(const std::string& path, const std::string& bytes, const OpenOptions& options,
               Clip& clip);

/// The clip without its positions: counts, polygons, timing and metadata.
MeshSequence describe_clip(const Clip& clip);

/// Plays the clip, which must outlive the source. Frames are given in any order. Throws
/// Error(kCorrupt) naming the path.
FrameSource play(const std::string& path, const Clip& clip);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_CLIP_INPUT_H_
