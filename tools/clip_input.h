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

#include <functional>
#include <string>
#include <vector>

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

/// Which clips a command can work on.
enum class Topologies { kOne, kAny };

/// Opens a clip. Throws as fail_clip(); Error(kUnsupported) for several meshes where there must be
/// one.
void open_clip(const std::string& path, const std::string& bytes, const OpenOptions& options,
               Clip& clip, Topologies allowed = Topologies::kOne);

/// The frames that have a mesh, from the first to one past the last.
struct MeshFrames {
  uint32_t first = 0, end = 0;
};

MeshFrames frames_of_mesh(const Clip& clip, uint32_t mesh);

/// The clip as one of a mesh, without its positions: counts, polygons, metadata, and the timing of
/// all frames.
MeshSequence describe_clip(const Clip& clip, uint32_t mesh = 0);

/// Attributes of a frame of a mesh as numbers, moving or not, in the form of those of
/// describe_clip(); empty when none moves. The clip must outlive it.
std::function<std::vector<Attribute>(uint32_t frame)> play_attributes(const Clip& clip,
                                                                      uint32_t mesh = 0);

/// Plays a mesh of the clip, which must outlive the source. Frames are given in any order. Throws
/// Error(kCorrupt) naming the path.
FrameSource play(const std::string& path, const Clip& clip, uint32_t mesh = 0);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_CLIP_INPUT_H_
