// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/formats/cache_output.h"

#include "tools/io/base/byte_order.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/frame_rate.h"
#include "tools/io/files/atomic_file.h"
#include "tools/io/formats/cache_record.h"
#include "tools/io/formats/obj.h"
#include "tools/io/formats/vertex_cache.h"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace anicodec::tools {
namespace {

void append_positions(std::span<const float> positions, std::endian order, std::string& out) {
  if (order == std::endian::native) {
    out.append(reinterpret_cast<const char*>(positions.data()), positions.size_bytes());
    return;
  }
  for (float x : positions)
    append(x, order, out);
}

/// `bytes`: the header.
void write_cache(const OutputClip& output, std::endian order, std::string bytes) {
  const MeshSequence& clip = output.clip;
  const bool overwrite = output.options.overwrite;
  const std::string mesh = mesh_of_cache(output.path);
  std::vector<AtomicFile> files;
  files.emplace_back(output.path, overwrite);
  files.emplace_back(mesh, overwrite);
  CacheHash hash;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    std::span<const float> positions = output.frames(f);
    append_positions(positions, order, bytes);
    hash.add(bytes);
    files[0].write(bytes);
    bytes.clear();
    if (f == 0) {
      ObjDetails details(clip, output.options.group_faces);
      add_library(mesh, output, details, files);
      append_obj(clip.polygons, positions, bytes, &details);
      files[1].write(bytes);
      bytes.clear();
    }
  }
  files[1].write(cache_record(output.path, hash.digest()));
  commit_all(files);
}

}  // namespace

std::string mesh_of_cache(const std::string& cache) {
  return std::filesystem::path(cache).replace_extension(".obj").string();
}

const FileFormat kPc2 = {.name = "PC2",
                         .extensions = ".pc2",
                         .role = FileRole::kCache,
                         .open_cache = open_pc2,
                         .write_clip =
                             [](const OutputClip& output) {
                               std::string header;
                               append_pc2_header(output.clip.vertex_count, output.clip.frame_count,
                                                 header);
                               write_cache(output, std::endian::little, std::move(header));
                             },
                         .counts_frames = true};

const FileFormat kMdd = {.name = "MDD",
                         .extensions = ".mdd",
                         .role = FileRole::kCache,
                         .open_cache = open_mdd,
                         .write_clip = [](const OutputClip& output) {
                           std::string header;
                           append_mdd_header(output.clip.vertex_count, times_of(output.clip),
                                             header);
                           write_cache(output, std::endian::big, std::move(header));
                         }};

}  // namespace anicodec::tools
