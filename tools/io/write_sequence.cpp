// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/write_sequence.h"

#include "codec/sequence/error.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/package_hint.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/name_pattern.h"
#include "tools/io/files/output_folder.h"
#include "tools/io/formats/cache_output.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace anicodec::tools {
namespace {

/// The frames of a clip, checked and reported. The arguments must outlive them.
FrameSource checked(const MeshSequence& clip, const FrameSource& source, const Progress& progress) {
  return [&](uint32_t f) {
    if (progress)
      progress("writing", static_cast<double>(f) / clip.frame_count);
    std::span<const float> positions = source(f);
    if (positions.size() != size_t{clip.vertex_count} * 3)
      throw Error(ErrorKind::kInternal,
                  "frame " + std::to_string(f) + " has " + std::to_string(positions.size()) +
                      " coordinates, not 3 x " + std::to_string(clip.vertex_count));
    return positions;
  };
}

/// Values of a frame, in place: what refers to the attributes goes on doing so.
void set_values(std::vector<Attribute> from, std::vector<Attribute>& to) {
  for (size_t i = 0; i < to.size(); ++i)
    to[i].values = std::move(from[i].values);
}

void write_frames(const FileFormat& format, const OutputClip& output) {
  const WriteOptions& options = output.options;
  const NamePattern pattern = parse_name_pattern(output.path);
  std::vector<AtomicFile> files;
  std::vector<Attribute> attributes = output.clip.attributes;
  const FrameWriter append =
      format.frame_writer(output, pattern.name(options.first_number), attributes, files);
  std::string bytes;
  for (uint32_t f = 0; f < output.clip.frame_count; ++f) {
    AtomicFile& file =
        files.emplace_back(pattern.name(uint64_t{options.first_number} + f), options.overwrite);
    if (options.attributes)
      set_values(options.attributes(f), attributes);
    append(output.frames(f), bytes);
    file.write(bytes);
    file.close();
    bytes.clear();
  }
  commit_all(files);
}

}  // namespace

bool keeps_origin(const std::string& path, bool ascii) {
  const FileFormat* format = format_of(path);
  return format && (format->has_room_for_origin || (ascii && format->text_has_room_for_origin));
}

const FileFormat& output_format(const std::string& path) {
  const FileFormat* format = format_of(path);
  if (format && format->carries_clip && !format->is_written())
    fail_usage(path, "glTF is written in one file; name it .glb");
  if (!format || !format->is_written())
    fail_usage(path,
               std::string(format ? "is of a kind that is not written" : "is of unknown kind") +
                   "; " + list_formats([](const FileFormat& f) { return f.is_written(); }) +
                   " can be written" + package_hint(path));
  return *format;
}

void check_sequence_output(const std::string& path, uint32_t frame_count,
                           const WriteOptions& options) {
  if (!output_format(path).frame_writer) {
    check_output(path, options.overwrite);
    if (is_cache(path))
      check_output(mesh_of_cache(path), options.overwrite);
    return;
  }
  NamePattern pattern = parse_name_pattern(path);
  if (!pattern.has_number && frame_count > 1)
    fail_usage(path, std::to_string(frame_count) +
                         " frames need a pattern with a number, such as frame_%04d.obj");
  for (uint32_t f = 0; f < frame_count; ++f)
    check_output(pattern.name(uint64_t{options.first_number} + f), options.overwrite);
}

void write_sequence(const std::string& path, const MeshSequence& clip, const FrameSource& source,
                    const WriteOptions& options) {
  check_sequence_output(path, clip.frame_count, options);
  if (clip.frame_count == 0)
    throw Error(ErrorKind::kInput, "the sequence has no frame");
  WriteOptions own = options;
  if (!own.attributes &&
      std::ranges::any_of(clip.attributes, [](const Attribute& a) { return a.frames > 1; }))
    own.attributes = [&clip](uint32_t f) { return attributes_of_frame(clip.attributes, f); };
  OutputFolder folder(path);
  const FrameSource frames = checked(clip, source, options.progress);
  const OutputClip output{path, clip, frames, source, own};
  const FileFormat& format = output_format(path);
  if (format.write_clip)
    format.write_clip(output);
  else
    write_frames(format, output);
  folder.keep();
  if (options.progress)
    options.progress("writing", 1);
}

void write_tracks(const std::string& path, const MeshSequence& clip,
                  std::span<const AlembicTrack> tracks, const WriteOptions& options) {
  check_sequence_output(path, clip.frame_count, options);
  OutputFolder folder(path);
  output_format(path).write_tracks(path, clip, tracks, options);
  folder.keep();
  if (options.progress)
    options.progress("writing", 1);
}

void write_sequence(const std::string& path, const MeshSequence& clip,
                    const WriteOptions& options) {
  write_sequence(path, clip, frames_of(clip), options);
}

}  // namespace anicodec::tools
