// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_COMPARED_CLIP_H_
#define ANICODEC_TOOLS_INPUTS_COMPARED_CLIP_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "tools/inputs/attribute_difference.h"
#include "tools/inputs/played_clip.h"
#include "tools/words/quantity.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace anicodec::tools {

/// The part of an input that is compared, and how it is read.
struct ComparedPart {
  std::string frames = {};             ///< "A:B:STEP" of parse_frames, empty: all
  std::string clip = {};               ///< animation of a scene
  std::optional<FrameRate> rate = {};  ///< at which a scene is baked
};

/// One side of a comparison: an .anic file, frame files by a pattern, a vertex cache with its mesh,
/// or a scene. An .anic file is played, frame by frame.
class ComparedClip {
 public:
  /// `mesh` is that of a vertex cache, empty: same stem. Throws Error.
  ComparedClip(const std::string& path, const std::string& mesh, const Progress& progress,
               const ComparedPart& part = {});

  const std::string& path() const { return path_; }

  /// Counts, polygons and timing; has positions only if it is no .anic file.
  const MeshSequence& sequence() const { return sequence_; }

  /// Size of the .anic file, 0 for all else.
  uint64_t bytes() const { return bytes_; }

  /// Throws as PlayedClip::check_empty_frames(), for an .anic file.
  void check_empty_frames() const;

  /// True for an .anic file that does not keep the order of the source's vertices.
  bool has_free_order() const;

  /// The clip must outlive the source.
  FrameSource frames() const;

  /// Attributes as numbers. The clip must outlive the source.
  AttributeSource attributes() const;

 private:
  std::string path_;
  uint64_t bytes_ = 0;
  FrameRange range_;
  std::unique_ptr<PlayedClip> clip_;
  MeshSequence sequence_;
};

/// True when the polygons are the same but for their order and the corner they start at.
bool same_faces(const Polygons& a, const Polygons& b);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_COMPARED_CLIP_H_
