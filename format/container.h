// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The container: header, flat chunk table, payloads (spec/05-file-layout.md). Knows bytes and
// checksums, not what a chunk means.
#ifndef ANICODEC_FORMAT_CONTAINER_H_
#define ANICODEC_FORMAT_CONTAINER_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <cstdint>
#include <string>
#include <tuple>

namespace anicodec {

inline constexpr uint8_t kMagic[8] = {0x89, 'A', 'N', 'I', '\r', '\n', 0x1A, '\n'};
inline constexpr uint16_t kVersionMajor = 1;
inline constexpr uint16_t kVersionMinor = 0;
inline constexpr size_t kHeaderBytes = 40;
inline constexpr size_t kLeastEntryBytes = 10;  // without mesh and segment, of a short payload

/// Features, as bits of the header (spec/13-extending.md, section 2). The meshes of a continuation are
/// those of a file before it in a live stream; the other three are the optional profile.
inline constexpr uint64_t kContinuation = 1, kDracoFeature = 2, kMsgiFeature = 4,
                          kLearningFeature = 8;

/// Chunk types are four ASCII characters, the first one in the lowest byte.
constexpr uint32_t chunk_type(const char (&name)[5]) {
  uint32_t type = 0;
  for (int i = 3; i >= 0; --i)
    type = type << 8 | static_cast<uint8_t>(name[i]);
  return type;
}

/// The four characters of a type; anything unprintable becomes '?'.
std::string chunk_name(uint32_t type);

inline constexpr uint16_t kNoMesh = 0xFFFF;
inline constexpr uint32_t kNoSegment = 0xFFFFFFFF;

struct Chunk {
  uint32_t type = 0;
  bool required = false;    ///< a reader that does not know the type refuses the file
  bool copied = false;      ///< an editor that does not know the type keeps it, whatever it changes
  uint16_t mesh = kNoMesh;  ///< the mesh it belongs to
  uint32_t segment = kNoSegment;  ///< the segment it belongs to
  uint32_t checksum = 0;          ///< low 32 bits of XXH64 of the payload
  uint64_t offset = 0;            ///< of the payload, from the start of the file
  uint64_t size = 0;              ///< of the payload
};

/// The key that finds chunks; see ContainerReader::by_key().
inline std::tuple<uint32_t, uint16_t, uint32_t> chunk_key(const Chunk& chunk) {
  return {chunk.type, chunk.mesh, chunk.segment};
}

/// Whether a chunk is of a mesh as a whole: continuations have none.
inline bool is_of_mesh(const Chunk& chunk) {
  return chunk.mesh != kNoMesh && chunk.segment == kNoSegment;
}

/// Header and table of a file of these chunks, whose offsets do not matter.
Bytes container_head(const Vector<Chunk>& chunks, uint64_t features);

/// Collects chunks in file order and lays out the file.
class ContainerWriter {
 public:
  void add(const char (&type)[5], bool required, uint16_t mesh, uint32_t segment, Bytes payload);

  /// A chunk that this version knows (chunk_kinds.h), marked as all of its kind.
  void add(const char (&type)[5], uint16_t mesh, uint32_t segment, Bytes payload);

  /// A chunk of another file, of this mesh and segment in this one.
  void add(const Chunk& chunk, uint16_t mesh, uint32_t segment, Bytes payload);

  /// The whole file. Deterministic.
  Bytes finish(uint64_t features = 0) const;

 private:
  Vector<Chunk> chunks_;
  Vector<Bytes> payloads_;
};

/// Reads header and table of a whole file in memory. The bytes must outlive the reader.
class ContainerReader {
 public:
  /// Checks magic, version, features, sizes, table, the checksum of header and table, and that the
  /// payloads end where the file does. Payload checksums are checked by payload(). Cost: O(chunks
  /// log chunks).
  Failure open(ByteView file) { return open(file, Extent::kWhole); }

  /// The same for the bytes that have arrived of a file, from the front: all checks but those
  /// against the number of bytes. kTruncated, with head_bytes(), until header and table are there.
  Failure open_prefix(ByteView bytes) { return open(bytes, Extent::kPrefix); }

  /// The same for a file of a live stream, a continuation perhaps: bytes of the next one may follow.
  Failure open_of_stream(ByteView bytes) { return open(bytes, Extent::kOfStream); }

  /// Adds the mesh chunks of the file before to an opened continuation, so that it is a complete
  /// file. `bytes`: the file before, followed by this one.
  void add_meshes(const ContainerReader& before, ByteView bytes);

  /// After open_prefix() or open_of_stream(): more of the same bytes are there, in another place perhaps.
  void extend(ByteView bytes) { file_ = bytes; }

  /// How many bytes from the front hold header and table, as far as the bytes tell.
  static uint64_t head_bytes(ByteView bytes);

  const Vector<Chunk>& chunks() const { return chunks_; }

  /// Numbers of the chunks, ascending by type, mesh and segment; equal ones in the order of the
  /// file.
  const Vector<uint32_t>& by_key() const { return by_key_; }

  /// The first chunk of this type, mesh and segment; null when there is none. O(log chunks).
  const Chunk* find(const char (&type)[5], uint16_t mesh = kNoMesh,
                    uint32_t segment = kNoSegment) const;

  /// Whether the payload is there in full.
  bool has(const Chunk& chunk) const { return chunk.offset + chunk.size <= file_.size; }

  /// The payload, which is there.
  ByteView unchecked(const Chunk& chunk) const {
    return {file_.data + chunk.offset, static_cast<size_t>(chunk.size)};
  }

  /// The payload after checking its checksum; kTruncated when it is not there.
  Failure payload(const Chunk& chunk, ByteView* out) const;

  uint16_t version_major() const { return version_major_; }

  uint16_t version_minor() const { return version_minor_; }

  /// The fields of the header.
  uint64_t file_size() const { return file_size_; }

  /// Features that the file needs, all known; a decoder may lack some.
  uint64_t features() const { return features_; }

  bool is_continuation() const { return (features_ & kContinuation) != 0; }

  /// Whether all bytes are there.
  bool is_complete() const { return file_.size >= file_size_; }

 private:
  /// The extent of the bytes: a file, the first bytes of a file, or the bytes of a stream from the
  /// start of one of its files.
  enum class Extent : uint8_t { kWhole, kPrefix, kOfStream };

  Failure open(ByteView file, Extent extent);
  void sort_by_key();

  ByteView file_;
  uint64_t file_size_ = 0;
  uint16_t version_major_ = 0, version_minor_ = 0;
  Vector<Chunk> chunks_;
  Vector<uint32_t> by_key_;
  uint64_t features_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CONTAINER_H_
