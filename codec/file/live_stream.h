// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_LIVE_STREAM_H_
#define ANICODEC_CODEC_FILE_LIVE_STREAM_H_

#include "codec/file/join_clips.h"
#include "format/bytes.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// The files of a live stream (spec/05-file-layout.md, section 8).
struct LiveStream {
  /// A file as it stands in the stream.
  struct Place {
    uint64_t offset = 0;
    uint64_t size = 0;
    bool is_continuation = false;
  };

  std::vector<Bytes> files;   ///< in their order, each with its meshes
  std::vector<Place> places;  ///< of each
  uint64_t incomplete = 0;    ///< bytes at the end, of a file that has not arrived in full
};

/// Whether the bytes are those of several files.
bool is_live_stream(ByteView bytes);

/// Takes them apart. Throws Error(kCorrupt) for bytes that are no file of a stream.
LiveStream read_live_stream(const ClipPart& stream);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_LIVE_STREAM_H_
