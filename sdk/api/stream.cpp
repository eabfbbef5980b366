// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: files that are read through a callback, or arrive piece by piece, one after the other.
#include "format/chunk_kinds.h"
#include "format/continuation.h"
#include "sdk/api/objects.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/kept_learning.h"
#include "sdk/clip/kept_meshes.h"

#include <algorithm>

struct anic_stream {
  explicit anic_stream(const anic_options& wanted) : options(wanted) {}

  anic_options options;
  /// In a live stream the last file before the one at hand that had meshes, then the file at hand and what follows.
  anicodec::Bytes bytes;
  anicodec::ContainerReader meshes;  ///< of that file, which has `begin` bytes; 0: there is none
  size_t begin = 0;
  uint64_t mesh_hash = 0;          ///< of that file
  anicodec::ContainerReader file;  ///< the one at hand, with its meshes
  anicodec::KeptMeshes kept;       ///< of the assets that were opened
  anicodec::KeptLearning learning;
  /// The file at hand is a continuation with chunks of meshes of its own.
  bool adds_to_meshes = false;
  bool has_table = false;  ///< header and table are there
  bool has_limits = false;
  size_t arrived = 0;  ///< chunks, from the front of the table
  /// Chunks that have not arrived: those that all segments need, those that a segment needs.
  uint32_t common_missing = 0;
  uint32_t ready = 0;            ///< segments that miss nothing of their own
  uint32_t ready_positions = 0;  ///< of those, the ones of positions
  anicodec::Vector<uint8_t> of_positions;
  anicodec::Vector<uint32_t> missing;
  anicodec::Failure failure;
  anic_stream_info info = ANIC_INIT(anic_stream_info);
};

namespace anicodec {
namespace {

/// Takes more bytes; room is made as they come, so that a header's word for the size costs nothing.
void append(const void* bytes, size_t size, uint64_t file_bytes, Bytes* to) {
  const size_t wanted = to->size() + size;
  if (wanted > to->capacity()) {
    const bool ends_soon = file_bytes >= wanted && file_bytes / 2 < wanted;
    to->reserve(ends_soon ? static_cast<size_t>(file_bytes) : 2 * wanted);
  }
  const auto* from = static_cast<const uint8_t*>(bytes);
  to->insert(to->end(), from, from + size);
}

/// The meshes that the stream keeps, if it opens more than one asset of them: for layers that will arrive, or of a live
/// stream.
KeptMeshes* kept_of(anic_stream* stream) {
  const anic_stream_info& info = stream->info;
  const bool ends = info.complete && info.waiting_bytes == 0 && !stream->file.is_continuation();
  return stream->adds_to_meshes || (ends && stream->kept.empty()) ? nullptr : &stream->kept;
}

/// Calls visit(owner) for chunks begin .. end - 1 of the table that are needed to play anything:
/// owner is the segment's counter of missing chunks, or that of all. Layers make a segment finer.
template <class Visit>
void each_needed(anic_stream* stream, size_t begin, size_t end, Visit visit) {
  for (size_t i = begin; i < end; ++i) {
    const Chunk& chunk = stream->file.chunks()[i];
    const ChunkKind* kind = find_chunk_kind(chunk.type);
    if (!chunk.required)
      continue;
    if (chunk.segment == kNoSegment)
      visit(&stream->common_missing);
    else if (chunk.segment < stream->missing.size() && !(kind && kind->refines))
      visit(&stream->missing[chunk.segment]);
  }
}

/// The bytes that `file` reads: those of the file at hand; for a continuation, its meshes' bytes
/// come first.
ByteView bytes_at_hand(const anic_stream& stream) {
  const size_t from = stream.file.is_continuation() ? 0 : stream.begin;
  return {stream.bytes.data() + from, stream.bytes.size() - from};
}

/// Reads header and table once they are there, then the limits.
Failure read_head(anic_stream* stream) {
  ContainerReader& file = stream->file;
  anic_stream_info& info = stream->info;
  if (!stream->has_table) {
    Failure failure = file.open_of_stream(bytes_at_hand(*stream));
    if (failure.status == Status::kTruncated)
      return {};
    if (!failure.ok())
      return failure;
    stream->has_table = true;
    info.file_bytes = file.file_size();
    if (file.is_continuation() && stream->begin == 0)
      return {Status::kFeature, 16, 0, "the file continues another one, which has its meshes"};
    stream->adds_to_meshes =
        file.is_continuation() && std::any_of(file.chunks().begin(), file.chunks().end(),
                                              [](const Chunk& chunk) { return is_of_mesh(chunk); });
    if (file.is_continuation()) {
      file.add_meshes(stream->meshes, stream->bytes);
    } else {
      stream->kept.clear();
      stream->learning.clear();
    }
  }
  const Chunk* chunk = file.find("LIMI");
  if (chunk && !file.has(*chunk))
    return {};
  Limits limits;
  const OpenOptions options = open_options(stream->options, file.file_size());
  if (Failure failure = read_limits(file, options, &limits); !failure.ok())
    return failure;
  if (file.is_continuation() && limits.continued_meshes != stream->mesh_hash)
    return limits.continued_meshes
               ? failure_in(*chunk, Status::kMeshes, "the file continues a file with other meshes")
               : failure_in(*chunk, Status::kRecord,
                            "the file does not say which meshes it continues");
  stream->has_limits = true;
  const size_t segments = limits.segments.size(), chunks = file.chunks().size();
  stream->missing.assign(segments, 0);
  stream->of_positions.reserve(segments);
  for (const Limits::Segment& s : limits.segments)
    stream->of_positions.push_back(s.attribute == kPositions);
  each_needed(stream, 0, chunks, [](uint32_t* missing) { ++*missing; });
  info.segment_count = static_cast<uint32_t>(segments);
  for (const Chunk& c : file.chunks())
    info.layers += c.type == chunk_type("BASI");
  return {};
}

/// Checks the payloads that have arrived since the last time, and counts them.
Failure take_chunks(anic_stream* stream) {
  const ContainerReader& file = stream->file;
  anic_stream_info& info = stream->info;
  const size_t before = stream->arrived;
  for (; stream->arrived < file.chunks().size(); ++stream->arrived) {
    const Chunk& chunk = file.chunks()[stream->arrived];
    if (!file.has(chunk))
      break;
    ByteView payload;
    if (Failure failure = file.payload(chunk, &payload); !failure.ok())
      return failure;
    info.arrived_layers += chunk.type == chunk_type("BASI");
  }
  each_needed(stream, before, stream->arrived, [&](uint32_t* missing) {
    if (--*missing > 0 || missing == &stream->common_missing)
      return;
    ++stream->ready;
    stream->ready_positions += stream->of_positions[size_t(missing - stream->missing.data())];
  });
  info.playable_segments = stream->common_missing == 0 ? stream->ready : 0;
  info.playable = stream->common_missing == 0 && stream->ready_positions > 0;
  return {};
}

/// Looks at all bytes that are there of the file at hand.
Failure read_bytes(anic_stream* stream) {
  anic_stream_info& info = stream->info;
  const ByteView there = {stream->bytes.data() + stream->begin,
                          stream->bytes.size() - stream->begin};
  info.received_bytes = there.size;
  if (stream->has_table)
    stream->file.extend(bytes_at_hand(*stream));
  if (!stream->has_limits) {
    if (Failure failure = read_head(stream); !failure.ok())
      return failure;
  }
  if (stream->has_table && there.size > info.file_bytes) {
    const auto end = static_cast<size_t>(info.file_bytes), more = there.size - end;
    info.received_bytes = end;
    info.waiting_bytes = more;
    if (!std::equal(kMagic, kMagic + std::min(more, sizeof kMagic), there.data + end))
      return {Status::kTrailingBytes, end, 0, "bytes follow the end of the file"};
  }
  if (!stream->has_limits)
    return {};
  if (Failure failure = take_chunks(stream); !failure.ok())
    return failure;
  info.complete = stream->file.is_complete();
  return {};
}

Failure push(anic_stream* stream, const void* bytes, size_t size) {
  const MemoryScope scope(&memory_of_object(stream));
  append(bytes, size, stream->begin + stream->info.file_bytes, &stream->bytes);
  return read_bytes(stream);
}

/// Makes the next file of a live stream the one at hand.
Failure advance(anic_stream* stream) {
  const MemoryScope scope(&memory_of_object(stream));
  const auto size = static_cast<size_t>(stream->info.file_bytes);
  if (!stream->file.is_continuation())
    stream->mesh_hash = mesh_hash(stream->file);
  const bool keeps = !stream->file.is_continuation();  // its meshes, instead of those before
  const auto gone = stream->bytes.begin() + static_cast<ptrdiff_t>(keeps ? 0 : stream->begin);
  stream->bytes.erase(gone, gone + static_cast<ptrdiff_t>(keeps ? stream->begin : size));
  if (keeps) {
    stream->meshes = stream->file;
    stream->begin = size;
  }
  stream->file = ContainerReader();
  stream->has_table = stream->has_limits = false;
  stream->arrived = 0;
  stream->common_missing = stream->ready = stream->ready_positions = 0;
  stream->of_positions.clear();
  const uint32_t number = stream->info.file_number + 1;
  stream->info = ANIC_INIT(anic_stream_info);
  stream->info.file_number = number;
  return stream->bytes.size() == stream->begin ? Failure{} : read_bytes(stream);
}

/// Reads a whole file into `to`: its head first, so that limits are checked before the rest.
Failure read_file(const anic_reader& reader, uint64_t size, const anic_options& options,
                  Bytes* to) {
  if (size > SIZE_MAX / 2)
    return {Status::kLimit, 0, 0, "a file that fits no memory"};
  auto read_to = [&](uint64_t end) {
    const size_t begin = to->size();
    to->resize(static_cast<size_t>(end));
    return end == begin ||
           reader.read(reader.user, begin, to->data() + begin, to->size() - begin) == 0;
  };
  const Failure failed = {Status::kRead, 0, 0, "the read callback failed"};
  constexpr uint64_t kHead = 4096;
  if (!read_to(std::min(size, kHead)))
    return failed;
  // Until the limits are checked, only as much is read as they are known to need.
  for (;;) {
    anic_requirements requirements = ANIC_INIT(anic_requirements);
    const anic_status status =
        anic_get_requirements(to->data(), to->size(), &options, &requirements);
    if (status != ANIC_E_TRUNCATED || requirements.head_bytes > size ||
        requirements.head_bytes <= to->size())
      break;
    if (!read_to(requirements.head_bytes))
      return failed;
  }
  // Opening will say what is wrong with the head; what the head says of the limits comes before the
  // rest.
  ContainerReader file;
  if (Failure failure = file.open_prefix(*to); failure.ok()) {
    Limits limits;
    const OpenOptions opening = open_options(options, size);
    if (Failure f = read_limits(file, opening, &limits); f.status == Status::kLimit)
      return f;
  } else if (failure.status != Status::kTruncated) {
    return failure;
  }
  to->reserve(static_cast<size_t>(size));
  return read_to(size) ? Failure{} : failed;
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_open_asset_from_reader(const anic_reader* reader, uint64_t file_size,
                                        const anic_options* options, anic_asset** out,
                                        anic_failure* failure) {
  if (out)
    *out = nullptr;
  if (!is_failure(failure))
    return ANIC_E_ARGUMENT;
  anic_options wanted;
  if (!reader || !reader->read || !out || !take_options(options, &wanted))
    return report(kBadArgument, failure);
  auto open = [&]() -> Failure {
    Memory memory = memory_of(&wanted.allocator);
    const MemoryScope scope(&memory);
    Bytes bytes;
    if (Failure f = read_file(*reader, file_size, wanted, &bytes); !f.ok())
      return f;
    return open_asset(bytes, wanted, nullptr, out);
  };
  return report(guarded(open), failure);
}

anic_status anic_create_stream(const anic_options* options, anic_stream** out) {
  if (out)
    *out = nullptr;
  anic_options wanted;
  if (!out || !take_options(options, &wanted))
    return ANIC_E_ARGUMENT;
  auto make = [&]() -> Failure {
    *out = create<anic_stream>(memory_of(&wanted.allocator), 0, wanted);
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_destroy_stream(anic_stream* stream) {
  destroy(stream);
}

anic_status anic_push_bytes(anic_stream* stream, const void* bytes, size_t size) {
  if (!stream || (!bytes && size > 0))
    return ANIC_E_ARGUMENT;
  if (stream->failure.ok() && size > 0)
    stream->failure = guarded([&] { return push(stream, bytes, size); });
  return c_status(stream->failure.status);
}

anic_status anic_advance_stream(anic_stream* stream) {
  if (!stream)
    return ANIC_E_ARGUMENT;
  if (stream->failure.ok() && !stream->info.complete)
    return ANIC_E_STATE;
  if (stream->failure.ok())
    stream->failure = guarded([&] { return advance(stream); });
  return c_status(stream->failure.status);
}

anic_status anic_get_stream_info(const anic_stream* stream, anic_stream_info* out) {
  if (!stream || !is_sized(out))
    return ANIC_E_ARGUMENT;
  give(stream->info, out);
  return ANIC_OK;
}

anic_status anic_get_stream_failure(const anic_stream* stream, anic_failure* out) {
  if (!stream || !is_sized(out))
    return ANIC_E_ARGUMENT;
  report(stream->failure, out);
  return ANIC_OK;
}

anic_status anic_open_asset_from_stream(anic_stream* stream, anic_asset** out,
                                        anic_failure* failure) {
  if (out)
    *out = nullptr;
  if (!is_failure(failure))
    return ANIC_E_ARGUMENT;
  if (!stream || !out)
    return report(kBadArgument, failure);
  if (!stream->failure.ok())
    return report(stream->failure, failure);
  if (!stream->info.playable)
    return report({Status::kState, stream->bytes.size(), 0, "nothing can be played yet"}, failure);
  const size_t size = bytes_at_hand(*stream).size - static_cast<size_t>(stream->info.waiting_bytes);
  Failure what = guarded([&] {
    return open_asset(stream->file, size, stream->options, kept_of(stream), &stream->learning, out);
  });
  // A prefix may be too short for what the whole file is allowed.
  if (what.status == Status::kLimit && !stream->info.complete)
    what = {Status::kState, stream->bytes.size(), what.chunk, "too little has arrived"};
  return report(what, failure);
}
