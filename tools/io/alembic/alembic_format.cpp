// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/alembic_format.h"

#include "tools/io/alembic/alembic.h"
#include "tools/io/alembic/alembic_output.h"
#include "tools/io/base/file_format.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/byte_source.h"

#include <string_view>

namespace anicodec::tools {
namespace {

ByteSource source_of(const InputFile& file) {
  return file.bytes ? memory_source(*file.bytes, file.name) : file_source(file.name);
}

AlembicOptions options_of(const LoadOptions& options) {
  AlembicOptions archive{.rate = options.rate, .mesh = options.mesh};
  archive.memory_limit = options.memory;
  archive.origin = options.origin.value_or(Point());
  archive.progress = options.progress;
  archive.note = options.note;
  return archive;
}

void write_tracks(const std::string& path, const MeshSequence& clip,
                  std::span<const AlembicTrack> tracks, const WriteOptions& options) {
  AtomicFile file(path, options.overwrite);
  const AbcSink sink{[&](std::string_view bytes) { file.write(bytes); },
                     [&](uint64_t offset, std::string_view bytes) { file.rewrite(offset, bytes); }};
  write_alembic(sink, clip, tracks, {.normals = options.normals, .progress = options.progress});
  file.commit();
}

/// The clip as the only mesh of an archive, there in all frames.
void write_clip(const OutputClip& output) {
  AlembicTrack track;
  MeshSequence& mesh = track.mesh;
  static_cast<MeshDetails&>(mesh) = output.clip;
  mesh.polygons = output.clip.polygons;
  mesh.vertex_count = output.clip.vertex_count;
  track.present_in = {{0, output.clip.frame_count}};
  track.frames = output.source;
  track.attributes = output.options.attributes;
  write_tracks(output.path, output.clip, {&track, 1}, output.options);
}

}  // namespace

const FileFormat kAlembic = {
    .name = "Alembic",
    .extensions = ".abc",
    .role = FileRole::kArchive,
    .find_mark = [](std::string_view bytes) { return bytes.starts_with("Ogawa") ? 0 : bytes.npos; },
    .read_clip =
        [](const InputFile& file, const LoadOptions& options) {
          return read_alembic(source_of(file), options_of(options));
        },
    .read_meshes =
        [](const InputFile& file, const LoadOptions& options) {
          return read_alembic_meshes(source_of(file), options_of(options));
        },
    .write_clip = write_clip,
    .write_tracks = write_tracks,
    .has_room_for_origin = true};

}  // namespace anicodec::tools
