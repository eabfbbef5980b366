// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_FRAME_CHANGES_H_
#define ANICODEC_TOOLS_IO_BASE_FRAME_CHANGES_H_

#include "codec/sequence/mesh_sequence.h"

#include <functional>
#include <set>
#include <string>

namespace anicodec::tools {

/// Tells what stands beside the positions of frames and changes, where a clip keeps that of the first frame:
/// each thing once, with the file of the first frame that differs. Normals are none: those of a clip follow its
/// surface.
class FrameChanges {
 public:
  explicit FrameChanges(std::function<void(const std::string& text)> note)
      : note_(std::move(note)) {}

  /// Compares a frame with the first. Costs a pass over the values.
  void compare(const MeshDetails& first, const MeshDetails& now, const std::string& path);

 private:
  void tell(const std::string& what, const std::string& path);
  void compare_attributes(const MeshDetails& first, const MeshDetails& now,
                          const std::string& path);
  void compare_materials(const PolygonLabels& first, const PolygonLabels& now,
                         const std::string& path);

  std::function<void(const std::string& text)> note_;
  std::set<std::string> told_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FRAME_CHANGES_H_
