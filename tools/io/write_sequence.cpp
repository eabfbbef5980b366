// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/write_sequence.h"

#include "codec/sequence/error.h"
#include "codec/sequence/triangulate.h"
#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_kind.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/base/mesh.h"
#include "tools/io/base/package_hint.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/files/name_pattern.h"
#include "tools/io/files/output_folder.h"
#include "tools/io/formats/cache_record.h"
#include "tools/io/formats/mtl.h"
#include "tools/io/formats/obj.h"
#include "tools/io/formats/off.h"
#include "tools/io/formats/ply.h"
#include "tools/io/formats/stl.h"
#include "tools/io/formats/vertex_cache.h"
#include "tools/io/gltf/glb_output.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <optional>
#include <vector>

namespace anicodec::tools {
namespace {

void append_mesh(FileKind kind, const Polygons& polygons, std::span<const float> positions,
                 const Point& origin, bool ascii, const ObjDetails* details,
                 const PlyProperties* properties, std::string& out) {
  switch (kind) {
    case FileKind::kPly:
      return append_ply(polygons, positions, ascii, out, properties, origin);
    case FileKind::kOff:
      return append_off(polygons, positions, out, origin);
    case FileKind::kStl:
      return append_stl(polygons, positions, ascii, out, origin);
    default:
      return append_obj(polygons, positions, out, details, origin);
  }
}

/// The frames of a clip, checked and reported.
class Frames {
 public:
  Frames(const MeshSequence& clip, const FrameSource& source, const Progress& progress)
      : clip_(clip), source_(source), progress_(progress) {}

  std::span<const float> operator()(uint32_t f) const {
    if (progress_)
      progress_("writing", static_cast<double>(f) / clip_.frame_count);
    std::span<const float> positions = source_(f);
    if (positions.size() != size_t{clip_.vertex_count} * 3)
      throw Error(ErrorKind::kInternal,
                  "frame " + std::to_string(f) + " has " + std::to_string(positions.size()) +
                      " coordinates, not 3 x " + std::to_string(clip_.vertex_count));
    return positions;
  }

 private:
  const MeshSequence& clip_;
  const FrameSource& source_;
  const Progress& progress_;
};

std::vector<float> times_of(const MeshSequence& clip) {
  std::vector<float> times;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    double t = clip.times.empty() ? f / clip.rate.value() : clip.times[f];
    times.push_back(static_cast<float>(clip.start_time + t));
  }
  return times;
}

void append_positions(std::span<const float> positions, std::endian order, std::string& out) {
  if (order == std::endian::native) {
    out.append(reinterpret_cast<const char*>(positions.data()), positions.size_bytes());
    return;
  }
  for (float x : positions)
    append(x, order, out);
}

std::string mesh_of_cache(const std::string& cache) {
  return std::filesystem::path(cache).replace_extension(".obj").string();
}

/// The library of materials beside an OBJ.
std::string library_of_mesh(const std::string& mesh) {
  return std::filesystem::path(mesh).replace_extension(".mtl").string();
}

/// Writes the library of materials whose looks are known beside an OBJ, which then names it.
void add_library(const std::string& mesh, const MeshSequence& clip, const WriteOptions& options,
                 ObjDetails& details, std::vector<AtomicFile>& files) {
  if (!has_looks(clip.materials))
    return;
  const std::string library = library_of_mesh(mesh);
  details.set_library(std::filesystem::path(library).filename().string());
  std::string text;
  append_mtl(clip.materials, text);
  files.emplace_back(library, options.overwrite).write(text);
  files.back().close();
}

void write_cache(const std::string& path, const MeshSequence& clip, const Frames& frames,
                 const WriteOptions& options) {
  std::vector<AtomicFile> files;
  files.emplace_back(path, options.overwrite);
  files.emplace_back(mesh_of_cache(path), options.overwrite);

  bool is_pc2 = kind_of(path) == FileKind::kPc2;
  std::string bytes;
  CacheHash hash;
  if (is_pc2)
    append_pc2_header(clip.vertex_count, clip.frame_count, bytes);
  else
    append_mdd_header(clip.vertex_count, times_of(clip), bytes);
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    std::span<const float> positions = frames(f);
    append_positions(positions, is_pc2 ? std::endian::little : std::endian::big, bytes);
    hash.add(bytes);
    files[0].write(bytes);
    bytes.clear();
    if (f == 0) {
      ObjDetails details(clip, options.group_faces);
      add_library(mesh_of_cache(path), clip, options, details, files);
      append_obj(clip.polygons, positions, bytes, &details);
      files[1].write(bytes);
      bytes.clear();
    }
  }
  files[1].write(cache_record(path, hash.digest()));
  commit_all(files);
}

void write_abc(const std::string& path, const MeshSequence& clip,
               std::span<const AlembicTrack> tracks, const WriteOptions& options) {
  AtomicFile file(path, options.overwrite);
  const AbcSink sink{[&](std::string_view bytes) { file.write(bytes); },
                     [&](uint64_t offset, std::string_view bytes) { file.rewrite(offset, bytes); }};
  write_alembic(sink, clip, tracks, {.normals = options.normals, .progress = options.progress});
  file.commit();
}

/// The clip as the only mesh of an archive, there in all frames.
AlembicTrack only_track(const MeshSequence& clip, const FrameSource& source,
                        const AttributeSource& attributes) {
  AlembicTrack track;
  MeshSequence& mesh = track.mesh;
  static_cast<MeshDetails&>(mesh) = clip;
  mesh.polygons = clip.polygons;
  mesh.vertex_count = clip.vertex_count;
  track.present_in = {{0, clip.frame_count}};
  track.frames = source;
  track.attributes = attributes;
  return track;
}

void write_glb(const std::string& path, const MeshSequence& clip, const Frames& frames,
               const WriteOptions& options) {
  AtomicFile file(path, options.overwrite);
  std::vector<Attribute> all = options.attributes ? options.attributes(0) : clip.attributes;
  for (uint32_t f = 1; options.attributes && f < clip.frame_count; ++f)
    add_frame(options.attributes(f), f, all);
  GlbOutput glb(clip, options.step, options.images, &all);
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    std::vector<Attribute> attributes;
    if (options.attributes)
      attributes = options.attributes(f);
    else if (f == 0)
      attributes = clip.attributes;
    glb.add_frame(frames(f), attributes);
  }
  file.write(glb.finish(times_of(clip)));
  file.commit();
}

/// Values of a frame, in place: what refers to the attributes goes on doing so.
void set_values(std::vector<Attribute> from, std::vector<Attribute>& to) {
  for (size_t i = 0; i < to.size(); ++i)
    to[i].values = std::move(from[i].values);
}

void write_frames(const NamePattern& pattern, FileKind kind, const MeshSequence& clip,
                  const Frames& frames, const WriteOptions& options) {
  std::vector<AtomicFile> files;
  std::string bytes;
  std::optional<ObjDetails> details;
  if (kind == FileKind::kObj) {
    details.emplace(clip, options.group_faces);
    add_library(pattern.name(options.first_number), clip, options, *details, files);
  }
  std::vector<Attribute> attributes = clip.attributes;
  const PlyProperties properties(attributes);
  // The triangles of all frames are those of the first, so that they correspond.
  const Polygons triangles =
      kind == FileKind::kStl ? triangulated(clip.polygons, frames(0)) : Polygons();
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    AtomicFile& file =
        files.emplace_back(pattern.name(uint64_t{options.first_number} + f), options.overwrite);
    if (options.attributes) {
      set_values(options.attributes(f), attributes);
      if (details)
        details->set_attributes(attributes);
    }
    append_mesh(kind, kind == FileKind::kStl ? triangles : clip.polygons, frames(f), clip.origin,
                options.ascii, details ? &*details : nullptr, &properties, bytes);
    file.write(bytes);
    file.close();
    bytes.clear();
  }
  commit_all(files);
}

}  // namespace

bool keeps_origin(const std::string& path, bool ascii) {
  const FileKind kind = kind_of(path);
  return !is_cache(kind) && (kind != FileKind::kStl || ascii);
}

void check_sequence_output(const std::string& path, uint32_t frame_count,
                           const WriteOptions& options) {
  FileKind kind = kind_of(path);
  if (kind == FileKind::kGltf)
    fail_usage(path, "glTF is written in one file; name it .glb");
  if (!is_output(kind))
    fail_usage(path, std::string(kind == FileKind::kUnknown ? "is of unknown kind"
                                                            : "is of a kind that is not written") +
                         "; .obj, .ply, .off, .stl, .pc2, .mdd, .glb and .abc can be written" +
                         package_hint(path));
  if (kind == FileKind::kGlb || kind == FileKind::kAlembic)
    return check_output(path, options.overwrite);
  if (is_cache(kind)) {
    check_output(path, options.overwrite);
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
  Frames frames(clip, source, options.progress);
  FileKind kind = kind_of(path);
  if (is_cache(kind))
    write_cache(path, clip, frames, options);
  else if (kind == FileKind::kGlb)
    write_glb(path, clip, frames, own);
  else if (kind == FileKind::kAlembic)
    write_abc(path, clip, std::vector{only_track(clip, source, own.attributes)}, own);
  else
    write_frames(parse_name_pattern(path), kind, clip, frames, own);
  folder.keep();
  if (options.progress)
    options.progress("writing", 1);
}

void write_tracks(const std::string& path, const MeshSequence& clip,
                  std::span<const AlembicTrack> tracks, const WriteOptions& options) {
  check_sequence_output(path, clip.frame_count, options);
  OutputFolder folder(path);
  write_abc(path, clip, tracks, options);
  folder.keep();
  if (options.progress)
    options.progress("writing", 1);
}

void write_sequence(const std::string& path, const MeshSequence& clip,
                    const WriteOptions& options) {
  write_sequence(path, clip, frames_of(clip), options);
}

}  // namespace anicodec::tools
