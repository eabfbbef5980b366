// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/live_stream.h"

#include "codec/file/part_chunks.h"
#include "codec/sequence/error.h"
#include "format/continuation.h"
#include "format/records.h"

#include <algorithm>
#include <string>

namespace anicodec {

namespace {

/// Fails unless a file continues one with the meshes of `before`.
void check_continues(const ContainerReader& file, const ContainerReader& before,
                     const ClipPart& stream, const std::string& place) {
  Limits limits;
  const Chunk* chunk = file.find("LIMI");
  const Status read = chunk ? Limits::read(file.unchecked(*chunk), &limits) : Status::kChunkMissing;
  const Status status = read != Status::kOk                             ? read
                        : !limits.continued_meshes                      ? Status::kRecord
                        : *limits.continued_meshes != mesh_hash(before) ? Status::kMeshes
                                                                        : Status::kOk;
  if (status != Status::kOk)
    fail(stream, ErrorKind::kCorrupt, place + status_string(status));
}

}  // namespace

bool is_live_stream(ByteView bytes) {
  ContainerReader reader;
  if (!reader.open_of_stream(bytes).ok() || bytes.size <= reader.file_size())
    return false;
  const size_t more = bytes.size - static_cast<size_t>(reader.file_size());
  return std::equal(kMagic, kMagic + std::min(more, sizeof kMagic),
                    bytes.data + reader.file_size());
}

LiveStream read_live_stream(const ClipPart& stream) {
  LiveStream out;
  ContainerReader before;  // the last file with meshes
  bool is_first = true;
  ByteView left = stream.file;
  while (left.size > 0) {
    ContainerReader file;
    const Failure failure = file.open_of_stream(left);
    if (failure.status == Status::kTruncated || (failure.ok() && !file.is_complete()))
      break;
    const std::string place = "at byte " + std::to_string(stream.file.size - left.size) + ": ";
    if (!failure.ok())
      fail(stream, ErrorKind::kCorrupt, place + status_string(failure.status));
    if (file.is_continuation()) {
      if (is_first)
        fail(stream, ErrorKind::kCorrupt,
             place + "the stream begins with a file that continues another one");
      check_continues(file, before, stream, place);
      out.files.push_back(with_meshes(before, file));
    } else {
      const auto size = static_cast<size_t>(file.file_size());
      out.files.push_back(copy({left.data, size}));
      before = file;
    }
    out.places.push_back({stream.file.size - left.size, file.file_size(), file.is_continuation()});
    is_first = false;
    left.data += file.file_size();
    left.size -= static_cast<size_t>(file.file_size());
  }
  out.incomplete = left.size;
  return out;
}

}  // namespace anicodec
