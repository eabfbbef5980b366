// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/container.h"

#include "format/checksum.h"
#include "format/chunk_kinds.h"
#include "format/sort.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace anicodec {
namespace {

constexpr size_t kChecksumAt = 32;
constexpr size_t kTableBytesAt = 36;
// Flags of an entry.
constexpr uint8_t kRequired = 1, kOfMesh = 2, kOfSegment = 4, kCopied = 8;

constexpr uint64_t kKnownFeatures = kContinuation | kDracoFeature | kMsgiFeature | kLearningFeature;

/// The texts of failures, one for each feature that is not known.
constexpr auto kUnknownFeature = [] {
  constexpr char kText[] = "the file needs feature 00, which this decoder does not know";
  constexpr size_t kNumberAt = 23;
  std::array<std::array<char, sizeof kText>, 64> texts{};
  for (size_t bit = 0; bit < texts.size(); ++bit) {
    for (size_t i = 0; i < sizeof kText; ++i)
      texts[bit][i] = kText[i];
    texts[bit][kNumberAt] = static_cast<char>('0' + bit / 10);
    texts[bit][kNumberAt + 1] = static_cast<char>('0' + bit % 10);
  }
  return texts;
}();

/// The number of the lowest bit that is set; there is one.
size_t lowest_feature(uint64_t bits) {
  size_t bit = 0;
  while (!(bits >> bit & 1))
    ++bit;
  return bit;
}

uint32_t low32(uint64_t hash) {
  return static_cast<uint32_t>(hash);
}

}  // namespace

std::string chunk_name(uint32_t type) {
  std::string name(4, '?');
  for (char& c : name) {
    auto b = static_cast<uint8_t>(type);
    if (b >= 0x20 && b < 0x7F)
      c = static_cast<char>(b);
    type >>= 8;
  }
  return name;
}

void ContainerWriter::add(const char (&type)[5], bool required, uint16_t mesh, uint32_t segment,
                          Bytes payload) {
  Chunk chunk;
  chunk.type = chunk_type(type);
  chunk.required = required;
  add(chunk, mesh, segment, std::move(payload));
}

void ContainerWriter::add(const char (&type)[5], uint16_t mesh, uint32_t segment, Bytes payload) {
  const ChunkKind* kind = find_chunk_kind(chunk_type(type));
  Chunk chunk;
  chunk.type = chunk_type(type);
  chunk.required = kind && kind->required;
  chunk.copied = kind && kind->copied;
  add(chunk, mesh, segment, std::move(payload));
}

void ContainerWriter::add(const Chunk& like, uint16_t mesh, uint32_t segment, Bytes payload) {
  Chunk chunk = like;
  chunk.mesh = mesh;
  chunk.segment = segment;
  chunk.checksum = low32(xxh64(payload));
  chunk.size = payload.size();
  chunks_.push_back(chunk);
  payloads_.push_back(std::move(payload));
}

Bytes container_head(const Vector<Chunk>& chunks, uint64_t features) {
  ByteWriter table;
  uint64_t payload_bytes = 0;
  for (const Chunk& chunk : chunks) {
    const bool of_mesh = chunk.mesh != kNoMesh, of_segment = chunk.segment != kNoSegment;
    table.u32(chunk.type);
    table.u32(chunk.checksum);
    table.u8(static_cast<uint8_t>((chunk.required ? kRequired : 0) | (of_mesh ? kOfMesh : 0) |
                                  (of_segment ? kOfSegment : 0) | (chunk.copied ? kCopied : 0)));
    if (of_mesh)
      table.varint(chunk.mesh);
    if (of_segment)
      table.varint(chunk.segment);
    table.varint(chunk.size);
    payload_bytes += chunk.size;
  }
  ByteWriter file;
  file.raw({kMagic, sizeof kMagic});
  file.u16(kVersionMajor);
  file.u16(kVersionMinor);
  file.u32(static_cast<uint32_t>(chunks.size()));
  file.u64(features);
  file.u64(kHeaderBytes + table.size() + payload_bytes);
  file.u32(0);
  file.u32(static_cast<uint32_t>(table.size()));
  file.raw(table.bytes());
  uint32_t checksum = low32(xxh64(file.bytes()));
  for (size_t i = 0; i < 4; ++i)
    file.bytes()[kChecksumAt + i] = static_cast<uint8_t>(checksum >> (8 * i));
  return std::move(file.bytes());
}

Bytes ContainerWriter::finish(uint64_t features) const {
  Bytes file = container_head(chunks_, features);
  for (const Bytes& payload : payloads_)
    file.insert(file.end(), payload.begin(), payload.end());
  return file;
}

uint64_t ContainerReader::head_bytes(ByteView bytes) {
  if (bytes.size < kHeaderBytes)
    return kHeaderBytes;
  ByteReader header({bytes.data + kTableBytesAt, 4});
  return uint64_t{kHeaderBytes} + header.u32();
}

Failure ContainerReader::open(ByteView file, Extent extent) {
  chunks_.clear();
  by_key_.clear();
  file_ = {};
  file_size_ = features_ = 0;
  auto failure = [](Status status, uint64_t offset, const char* detail, uint32_t type = 0) {
    return Failure{status, offset, type, detail};
  };
  if (file.size < sizeof kMagic || !std::equal(kMagic, kMagic + sizeof kMagic, file.data)) {
    size_t n = std::min(file.size, sizeof kMagic);
    if (n > 0 && std::equal(file.data, file.data + n, kMagic))
      return failure(Status::kTruncated, n, "the file ends inside the magic number");
    return failure(Status::kMagic, 0, "the first eight bytes are not those of an .anic file");
  }
  ByteReader header({file.data, std::min(file.size, kHeaderBytes)});
  header.raw(sizeof kMagic);
  const uint16_t major = header.u16(), minor = header.u16();
  uint32_t count = header.u32();
  const uint64_t features = header.u64();
  uint64_t size = header.u64();
  uint32_t checksum = header.u32();
  header.u32();  // of the table, see head_bytes()
  if (!header.ok())
    return failure(Status::kTruncated, file.size, "the file ends inside the header");
  if (major != kVersionMajor)
    return failure(Status::kVersion, 8,
                   major == 0 ? "the file is a draft of the format, 0.x, which is no longer read: "
                                "encode its source again"
                              : "the file is of a later major version of the format");
  uint64_t table_end = head_bytes(file);
  if (table_end > file.size)
    return failure(size > file.size ? Status::kTruncated : Status::kHeader, file.size,
                   "the file ends inside the chunk table");
  Bytes covered(file.data, file.data + table_end);
  std::fill_n(covered.begin() + kChecksumAt, 4, uint8_t{0});
  if (low32(xxh64(covered)) != checksum)
    return failure(Status::kHeaderChecksum, kChecksumAt, "header and table are damaged");
  if (const uint64_t unknown = features & ~kKnownFeatures; unknown != 0)
    return failure(Status::kFeature, 16, kUnknownFeature[lowest_feature(unknown)].data());
  if ((features & kContinuation) && extent != Extent::kOfStream)
    return failure(Status::kFeature, 16, "the file continues another one, which has its meshes");
  if (size > file.size && extent == Extent::kWhole)
    return failure(Status::kTruncated, file.size, "the file is shorter than its header says");
  if (size < file.size && extent != Extent::kOfStream)
    return failure(Status::kTrailingBytes, size, "bytes follow the end of the file");

  ByteReader table({file.data + kHeaderBytes, static_cast<size_t>(table_end - kHeaderBytes)});
  if (count > table.remaining() / kLeastEntryBytes)
    return failure(Status::kHeader, 12, "more chunks than the table has room for");
  uint64_t at = table_end;
  chunks_.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t entry = kHeaderBytes + table.position();
    Chunk chunk;
    chunk.type = table.u32();
    chunk.checksum = table.u32();
    const uint8_t flags = table.u8();
    chunk.required = flags & kRequired;
    chunk.copied = flags & kCopied;
    if (flags & kOfMesh)
      chunk.mesh = static_cast<uint16_t>(table.varint32(kNoMesh - 1));
    if (flags & kOfSegment)
      chunk.segment = table.varint32(kNoSegment - 1);
    chunk.size = table.varint();
    if (!table.ok())
      return failure(Status::kHeader, entry, "an entry of the table is damaged", chunk.type);
    if (flags & ~(kRequired | kOfMesh | kOfSegment | kCopied))
      return failure(Status::kHeader, entry + 8, "a reserved chunk flag is set", chunk.type);
    chunk.offset = at;
    if (at > size || chunk.size > size - at)
      return failure(Status::kChunkBounds, entry, "a chunk goes beyond the end of the file",
                     chunk.type);
    at += chunk.size;
    chunks_.push_back(chunk);
  }
  if (table.remaining() > 0)
    return failure(Status::kHeader, kHeaderBytes + table.position(),
                   "bytes follow the last entry of the table");
  if (at != size)
    return failure(Status::kFileSize, at, "the chunks end before the file does");
  sort_by_key();
  file_ = file;
  file_size_ = size;
  version_major_ = major;
  version_minor_ = minor;
  features_ = features;
  return {};
}

void ContainerReader::sort_by_key() {
  by_key_.resize(chunks_.size());
  std::iota(by_key_.begin(), by_key_.end(), 0U);
  sort_ascending(by_key_.begin(), by_key_.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(chunk_key(chunks_[a]), a) < std::pair(chunk_key(chunks_[b]), b);
  });
}

void ContainerReader::add_meshes(const ContainerReader& before, ByteView bytes) {
  for (Chunk& chunk : chunks_)
    chunk.offset += before.file_size_;
  Vector<Chunk> meshes;
  std::copy_if(before.chunks_.begin(), before.chunks_.end(), std::back_inserter(meshes),
               is_of_mesh);
  const auto at = std::find_if(chunks_.begin(), chunks_.end(),
                               [](const Chunk& chunk) { return chunk.segment != kNoSegment; });
  chunks_.insert(at, meshes.begin(), meshes.end());
  file_size_ += before.file_size_;
  file_ = bytes;
  sort_by_key();
}

const Chunk* ContainerReader::find(const char (&type)[5], uint16_t mesh, uint32_t segment) const {
  const std::tuple wanted(chunk_type(type), mesh, segment);
  auto found = std::partition_point(by_key_.begin(), by_key_.end(),
                                    [&](uint32_t i) { return chunk_key(chunks_[i]) < wanted; });
  return found != by_key_.end() && chunk_key(chunks_[*found]) == wanted ? &chunks_[*found]
                                                                        : nullptr;
}

Failure ContainerReader::payload(const Chunk& chunk, ByteView* out) const {
  if (!has(chunk))
    return {Status::kTruncated, chunk.offset, chunk.type, "the chunk has not arrived"};
  *out = unchecked(chunk);
  if (low32(xxh64(*out)) != chunk.checksum)
    return {Status::kChunkChecksum, chunk.offset, chunk.type, "the chunk is damaged"};
  return {};
}

}  // namespace anicodec
