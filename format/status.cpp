// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/status.h"

namespace anicodec {

const char* status_string(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kArgument:
      return "invalid argument";
    case Status::kState:
      return "call not allowed in this state";
    case Status::kBufferSize:
      return "buffer too small";
    case Status::kFrameRange:
      return "frame out of range";
    case Status::kAbsent:
      return "the mesh is not there at this time";
    case Status::kMagic:
      return "not an anicodec file";
    case Status::kVersion:
      return "unsupported format version";
    case Status::kFeature:
      return "unsupported required feature";
    case Status::kTruncated:
      return "file is truncated";
    case Status::kHeader:
      return "malformed header or chunk table";
    case Status::kHeaderChecksum:
      return "header checksum mismatch";
    case Status::kChunkBounds:
      return "chunk out of bounds or out of order";
    case Status::kChunkChecksum:
      return "chunk checksum mismatch";
    case Status::kChunkDuplicate:
      return "duplicate chunk";
    case Status::kChunkMissing:
      return "required chunk missing";
    case Status::kChunkUnknown:
      return "unknown required chunk";
    case Status::kTrailingBytes:
      return "trailing bytes";
    case Status::kFileSize:
      return "file size does not match the header";
    case Status::kRecord:
      return "malformed record";
    case Status::kEntropy:
      return "malformed entropy-coded data";
    case Status::kZstd:
      return "malformed zstd data";
    case Status::kTopology:
      return "inconsistent connectivity";
    case Status::kIndexRange:
      return "index out of range";
    case Status::kQuantizer:
      return "quantisation parameter out of range";
    case Status::kNonFinite:
      return "value is not finite";
    case Status::kDraco:
      return "malformed Draco data";
    case Status::kSegment:
      return "inconsistent segment";
    case Status::kHash:
      return "decoded integers do not match the stored hash";
    case Status::kMeshes:
      return "the file continues a file with other meshes";
    case Status::kSegmentMissing:
      return "a segment continues one that is missing";
    case Status::kLimit:
      return "file exceeds the caller's limits";
    case Status::kMemory:
      return "out of memory";
    case Status::kRead:
      return "read callback failed";
    case Status::kCancelled:
      return "cancelled by the caller";
    case Status::kInternal:
      return "internal error";
  }
  return "unknown status";
}

}  // namespace anicodec
