// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FBX_FBX_MESSAGE_H_
#define ANICODEC_TOOLS_IO_FBX_FBX_MESSAGE_H_

#include "codec/sequence/mesh_sequence.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace anicodec::tools {

/// Clips and notes as bytes. A clip is begun without positions, which follow frame by frame.
class FbxMessage {
 public:
  void note(const std::string& text) { notes_.push_back(text); }

  /// `clip`: all but positions; attributes have a frame each.
  void begin_clip(const MeshSequence& clip);

  void add_frame(std::span<const float> positions);

  /// Whether all frames of the clip begun last are the same.
  bool stands_still() const;

  /// Forgets the clip begun last, or its frames but the first.
  void drop_clip();
  void keep_first_frame();

  /// Empties the message.
  std::string finish();

 private:
  std::string bytes_;
  size_t clip_ = 0, frames_ = 0;  ///< where the last one begins, and its positions
  size_t frame_bytes_ = 0;
  std::vector<std::string> notes_;
};

/// The clips and notes of a message.
struct FbxResult {
  std::vector<MeshSequence> clips;
  std::vector<std::string> notes;
};

/// Takes a message apart, trusting nothing of it. Throws Error(kInput) naming `path`.
FbxResult read_fbx_message(std::string_view bytes, const std::string& path);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FBX_FBX_MESSAGE_H_
