// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Live streams as inputs of commands: file by file, as a program that plays them gets them.
#ifndef ANICODEC_TOOLS_INPUTS_STREAM_INPUT_H_
#define ANICODEC_TOOLS_INPUTS_STREAM_INPUT_H_

#include "format/bytes.h"
#include "sdk/clip/clip.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A file of a live stream.
struct StreamedFile {
  std::string name;     ///< for messages: "take.anic, file 3 (at byte 20313)"
  uint64_t offset = 0;  ///< in the stream
  uint64_t size = 0;
  uint32_t frames = 0;
  double start = 0, end = 0;  ///< seconds
  bool has_mesh = false;      ///< it is no continuation
  bool is_key = false;        ///< it continues no segment of a file before it
  bool plays = true;          ///< what it continues is there
};

struct StreamContents {
  std::vector<StreamedFile> files;
  uint64_t incomplete = 0;          ///< bytes at the end, of a file that has not arrived in full
  std::vector<std::string> losses;  ///< a line for each time that no file plays
};

/// Opens the files of a live stream one after the other, and shows those that play, each as the file that it is with its meshes. Throws
/// as read_live_stream(), and as fail_clip() for a file that is damaged.
StreamContents read_stream(const std::string& path, ByteView bytes,
                           const std::function<void(const StreamedFile& file,
                                                    const std::string& whole, Clip& clip)>& show);

/// Throws Error(kCorrupt) that names the losses, if there are any.
void check_losses(const std::string& path, const StreamContents& stream);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_STREAM_INPUT_H_
