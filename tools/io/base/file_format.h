// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_FILE_FORMAT_H_
#define ANICODEC_TOOLS_IO_BASE_FILE_FORMAT_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/scene.h"
#include "tools/io/base/load_options.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/write_options.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

class AtomicFile;
struct AlembicTrack;
struct ByteSource;
struct VertexCache;

/// The contents of a file of a format.
enum class FileRole {
  kMesh,    ///< one frame
  kCache,   ///< positions of all frames, without faces
  kScene,   ///< a whole clip, which can be sampled at any rate
  kArchive  ///< a whole clip of frames
};

/// A file that a whole clip is read from.
struct InputFile {
  std::string name;                    ///< its path, or "-"
  const std::string* bytes = nullptr;  ///< those of the standard input, else null
};

/// A file, or a name of numbered ones, that a clip is written to.
struct OutputClip {
  const std::string& path;
  const MeshSequence& clip;   ///< but for its positions
  const FrameSource& frames;  ///< checked, and reported as "writing"
  const FrameSource& source;  ///< the same frames, neither checked nor reported
  const WriteOptions& options;
};

/// Refills a mesh, and `details`, where given, with what stands beside the positions. `libraries` receives the names of
/// files that describe its materials. Remembers the frames before where all have what the first decides.
using MeshParser = std::function<void(std::string_view bytes, const std::string& name, Mesh& mesh,
                                      MeshDetails* details, std::vector<std::string>* libraries)>;

/// Appends the file of one frame.
using FrameWriter = std::function<void(std::span<const float> positions, std::string& out)>;

/// A format of files: all that others know of it. Functions that are null are for other roles, or for what a
/// format is not read or written as.
struct FileFormat {
  std::string_view name;  ///< as in the tables of the README
  /// In small letters, with spaces between: ".dae .md2". Formats that are written, and those of meshes, have one.
  std::string_view extensions;
  FileRole role = FileRole::kMesh;

  /// The place of its mark in bytes of the standard input; npos: nowhere. Null: it is not read from there.
  size_t (*find_mark)(std::string_view bytes) = nullptr;
  MeshParser (*mesh_parser)(const LoadOptions& options) = nullptr;
  VertexCache (*open_cache)(const ByteSource& source) = nullptr;
  /// Reads scenes and archives.
  MeshSequence (*read_clip)(const InputFile& file, const LoadOptions& options) = nullptr;
  /// A mesh for each object and connectivity.
  Scene (*read_meshes)(const InputFile& file, const LoadOptions& options) = nullptr;

  /// Writes formats with a file per frame. Files that stand beside the first are added to `files`. The values of
  /// `attributes`, whose address stays, are those of the frame that is written.
  FrameWriter (*frame_writer)(const OutputClip& output, const std::string& first_path,
                              const std::vector<Attribute>& attributes,
                              std::vector<AtomicFile>& files) = nullptr;
  /// Writes all other formats.
  void (*write_clip)(const OutputClip& output) = nullptr;
  /// Several meshes on one clock, which need not be there in all frames.
  void (*write_tracks)(const std::string& path, const MeshSequence& clip,
                       std::span<const AlembicTrack> tracks, const WriteOptions& options) = nullptr;

  bool is_soup = false;        ///< a mesh of corners alone, without vertices
  bool counts_frames = false;  ///< a cache that counts frames of a rate which it does not carry
  /// A scene with room for an encoded clip, images, and several animations.
  bool carries_clip = false;
  bool frames_have_y_up = false;     ///< readers of a file per frame expect that
  bool has_room_for_origin = false;  ///< positions are written with the local origin of the clip
  bool text_has_room_for_origin = false;  ///< the same of files as text

  bool is_written() const { return frame_writer || write_clip; }
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FILE_FORMAT_H_
