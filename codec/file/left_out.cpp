// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/left_out.h"

#include "codec/file/part_chunks.h"
#include "format/container.h"
#include "format/records.h"

#include <algorithm>

namespace anicodec {
namespace {

/// Whether a file has a chunk of the same type, of the mesh or the whole, and of the same bytes.
bool has_same(const ContainerReader& file, const Chunk& wanted, ByteView payload) {
  return std::ranges::any_of(file.chunks(), [&](const Chunk& chunk) {
    return chunk_key(chunk) == chunk_key(wanted) && equal(file.unchecked(chunk), payload);
  });
}

/// The records that are written anew and have fields which this version does not know.
std::vector<std::string> records_with_fields(const ContainerReader& file) {
  std::vector<std::string> found;
  Limits limits;
  ClipsRecord clips;
  for (const Chunk& chunk : file.chunks()) {
    const ByteView payload = file.unchecked(chunk);
    if (chunk.type == chunk_type("LIMI") && Limits::read(payload, &limits) == Status::kOk &&
        limits.write().size() != payload.size)
      found.emplace_back("LIMI");
    if (chunk.type == chunk_type("CLIP") &&
        ClipsRecord::read(payload, limits, &clips) == Status::kOk &&
        clips.write().size() != payload.size)
      found.emplace_back("CLIP");
  }
  return found;
}

}  // namespace

std::vector<std::string> list_left_out(const std::vector<ClipPart>& files, ByteView made) {
  std::vector<std::string> lines;
  ContainerReader result;
  result.open(made);
  for (const ClipPart& part : files) {
    ContainerReader file;
    file.open(part.file);
    for (const Chunk& chunk : file.chunks()) {
      const std::string start = part.name + ": leaves out chunk " + chunk_name(chunk.type);
      if (!chunk.copied && !find_chunk_kind(chunk.type))
        lines.push_back(start + ", which this version does not know");
      else if (chunk.copied && chunk.segment == kNoSegment &&
               !has_same(result, chunk, file.unchecked(chunk)))
        lines.push_back(start + ": only that of the first file is kept");
    }
    for (const std::string& record : records_with_fields(file))
      lines.push_back(part.name + ": leaves out fields of chunk " + record +
                      " that this version does not know");
  }
  return lines;
}

}  // namespace anicodec
