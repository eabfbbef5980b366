// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TOOLS_IO_ALEMBIC_TESTING_H_
#define ANICODEC_TESTS_TOOLS_IO_ALEMBIC_TESTING_H_

#include "codec/sequence/scene.h"
#include "tools/io/alembic/abc_archive.h"
#include "tools/io/alembic/abc_output.h"
#include "tools/io/alembic/alembic.h"
#include "tools/io/alembic/alembic_output.h"
#include "tools/io/base/frame_attributes.h"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace anicodec::tools {

/// A sink that fills a string.
inline AbcSink sink_to(std::string& bytes) {
  bytes.clear();
  return {[&bytes](std::string_view more) { bytes += more; },
          [&bytes](uint64_t offset, std::string_view other) {
            bytes.replace(offset, other.size(), other);
          }};
}

/// The meshes of a scene as tracks. The scene must outlive them.
inline std::vector<AlembicTrack> tracks_of(const Scene& scene) {
  std::vector<AlembicTrack> tracks;
  for (const SceneMesh& mesh : scene.meshes) {
    AlembicTrack track;
    static_cast<MeshDetails&>(track.mesh) = mesh.sequence;
    track.mesh.polygons = mesh.sequence.polygons;
    track.mesh.vertex_count = mesh.sequence.vertex_count;
    track.present_in = mesh.present_in;
    auto own = [&mesh](uint32_t frame) {
      uint32_t before = 0;
      for (const FrameRun& run : mesh.present_in) {
        if (frame < run.first + run.count)
          return before + frame - run.first;
        before += run.count;
      }
      return before;
    };
    track.frames = [&mesh, own](uint32_t frame) { return mesh.sequence.frame(own(frame)); };
    if (std::ranges::any_of(mesh.sequence.attributes,
                            [](const Attribute& a) { return a.frames > 1; }))
      track.attributes = [&mesh, own](uint32_t frame) {
        return attributes_of_frame(mesh.sequence.attributes, own(frame));
      };
    tracks.push_back(std::move(track));
  }
  return tracks;
}

inline std::string archive_of_scene(const Scene& scene, bool normals = false) {
  std::string bytes;
  AlembicWriteOptions options;
  options.normals = normals;
  write_alembic(sink_to(bytes), scene.clip, tracks_of(scene), options);
  return bytes;
}

/// An archive with the samplings of another one, and what `write` puts into it.
inline std::string rewritten(
    const std::string& archive,
    const std::function<void(const AbcArchive& from, AbcArchiveOutput& to)>& write) {
  const AbcArchive from(memory_source(archive, "plain.abc"));
  std::string bytes;
  AbcArchiveOutput to(sink_to(bytes), from.metadata);
  for (const AbcTime& sampling : from.samplings)
    to.shared().sampling(sampling);
  write(from, to);
  to.finish();
  return bytes;
}

/// Changes the bytes of a sample that is copied.
using ChangeSample = std::function<void(const AbcProperty& property, std::string& bytes)>;

inline void copy_properties(const AbcArchive& from, const AbcCompound& compound,
                            const ChangeSample& change, AbcCompoundOutput& to) {
  for (const AbcProperty& p : compound.properties) {
    if (p.shape == AbcShape::kCompound) {
      copy_properties(from, from.properties(p), change, to.compound(p.name, p.metadata));
      continue;
    }
    AbcPropertyOutput& out = p.shape == AbcShape::kScalar
                                 ? to.scalar(p.name, p.metadata, p.type, p.extent, p.sampling)
                                 : to.array(p.name, p.metadata, p.type, p.extent, p.sampling);
    const AbcSamples samples(from.file, p);
    for (uint32_t s = 0; s < p.samples; ++s) {
      std::string bytes = from.file.read(samples.block(s));
      if (change)
        change(p, bytes);
      out.add(bytes);
    }
  }
}

/// Copies an object with all below it, property by property.
inline void copy_object(const AbcArchive& from, uint32_t object, AbcObjectOutput& to,
                        const ChangeSample& change = {}) {
  copy_properties(from, from.properties(from.objects[object]), change, to.properties());
  for (uint32_t child : from.objects[object].children)
    copy_object(from, child, to.child(from.objects[child].name, from.objects[child].metadata),
                change);
}

inline MeshSequence read_bytes_of_archive(const std::string& bytes,
                                          const AlembicOptions& options = {}) {
  return read_alembic(memory_source(bytes, "test.abc"), options);
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_IO_ALEMBIC_TESTING_H_
