// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The one enum of status codes. Numbers are pinned: never reused, never renumbered
// (spec/12-errors.md).
#ifndef ANICODEC_FORMAT_STATUS_H_
#define ANICODEC_FORMAT_STATUS_H_

#include <cstdint>

namespace anicodec {

enum class Status : int32_t {
  kOk = 0,
  // 1-9: the caller
  kArgument = 1,
  kState = 2,
  kBufferSize = 3,
  kFrameRange = 4,
  kAbsent = 5,
  // 10-19: not this format, version or feature
  kMagic = 10,
  kVersion = 11,
  kFeature = 12,
  // 20-39: container
  kTruncated = 20,
  kHeader = 21,
  kHeaderChecksum = 22,
  kChunkBounds = 23,
  kChunkChecksum = 24,
  kChunkDuplicate = 25,
  kChunkMissing = 26,
  kChunkUnknown = 27,
  kTrailingBytes = 29,
  kFileSize = 30,
  // 40-59: payload
  kRecord = 40,
  kEntropy = 41,
  kZstd = 42,
  kTopology = 43,
  kIndexRange = 44,
  kQuantizer = 45,
  kNonFinite = 46,
  kDraco = 47,
  kSegment = 48,
  kHash = 49,
  kMeshes = 50,
  kSegmentMissing = 51,
  // 60-69: limits
  kLimit = 60,
  // 70-79: the host: memory, callbacks
  kMemory = 70,
  kRead = 71,
  kCancelled = 72,
  // 90-: internal
  kInternal = 90,
};

/// Static English text for a status, without a full stop. Never null.
const char* status_string(Status status);

/// An error and its place: filled by the function that first noticed it.
struct Failure {
  Status status = Status::kOk;
  uint64_t offset = 0;      ///< byte offset in the file, as exact as the reader knows it
  uint32_t chunk = 0;       ///< chunk type (four characters), 0 outside any chunk
  const char* detail = "";  ///< static text

  bool ok() const { return status == Status::kOk; }
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_STATUS_H_
