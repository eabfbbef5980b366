// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// .anic files as inputs of commands: reading, opening, playing, and saying what is wrong with them.
#ifndef ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_

#include "codec/sequence/error.h"
#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"
#include "format/status.h"
#include "sdk/clip/clip.h"

#include <cstdint>
#include <string>
#include <vector>

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

/// Which clips a command can work on: kOne, only clips of one connectivity.
enum class Topologies { kOne, kAny };

/// True for several meshes that no frame shows together: a clip whose connectivity changes.
bool takes_turns(const Clip& clip);

/// Opens a clip. Throws as fail_clip(); Error(kUnsupported) for meshes that take turns where that
/// is not allowed.
void open_clip(const std::string& path, const std::string& bytes, const OpenOptions& options,
               Clip& clip, Topologies allowed = Topologies::kOne);

/// Makes one clip of a file the only one (Clip::take_clip()), by its name; without a name there must
/// be no other, "all" takes all. Throws Error(kUsage) that lists the clips.
void choose_clip(const std::string& path, const std::string& name, Clip& clip);

/// Numbers of all meshes of a clip.
std::vector<uint32_t> meshes_of(const Clip& clip);

/// The runs of frames that show a mesh.
std::vector<FrameRun> frames_of_mesh(const Clip& clip, uint32_t mesh);

/// Some meshes of the clip as one, see merge_meshes(): counts, polygons, metadata, and the timing
/// of all frames: of several clips, at the rate of the first.
MeshSequence describe_clip(const Clip& clip, const std::vector<uint32_t>& meshes);

/// The clips of a file as those of a sequence; none where there is one alone.
std::vector<ClipTiming> clip_timings(const Clip& clip);

/// Plays some meshes of the clip, which must outlive the source, as one. Frames are given in any
/// order. In those that do not show a mesh, all its vertices are where its first one was last, or
/// will be first. Throws Error(kCorrupt) naming the path.
FrameSource play(const std::string& path, const Clip& clip, const std::vector<uint32_t>& meshes);

/// The same of their attributes, moving or not, in the form of those of describe_clip(); empty when
/// none moves. A mesh that a frame does not show has those it had last, or will have first.
AttributeSource play_attributes(const Clip& clip, const std::vector<uint32_t>& meshes);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_CLIP_INPUT_H_
