// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PLAN_MESH_PLAN_H_
#define ANICODEC_CODEC_PLAN_MESH_PLAN_H_

#include "codec/connectivity/attribute_encode.h"
#include "codec/connectivity/mesh_layout.h"
#include "codec/plan/encode_options.h"
#include "codec/plan/target.h"
#include "codec/sequence/mesh_sequence.h"

#include <memory>
#include <optional>
#include <vector>

namespace anicodec {

class KeptLearning;

/// The encoding of one mesh. Nothing in it is relative any more.
struct MeshPlan : CodingOptions {
  std::vector<ClipGoal> goals;  ///< of each clip: what the file promises
  double diagonal = 0;          ///< of the box around all frames of all clips
  std::optional<FrameRun>
      run;  ///< the frames that are encoded, as by EncodeOptions::part; nothing: all
  /// The mesh and attributes of the file that the clip goes to. Attributes of the sequence are
  /// ignored, except for the moving ones that `stored` lists. Null: it is laid out.
  std::shared_ptr<const MeshLayout> layout;
  std::shared_ptr<const std::vector<StoredAttribute>> stored;
  /// Learnt from the files of a live stream before this one: its segment goes on there, and leaves what it learns
  /// itself. Null: segments begin anew.
  KeptLearning* learning = nullptr;

  /// Whether the source's positions come back bit for bit.
  bool is_lossless() const;
};

/// The plan of a mesh whose clips have these goals. `diagonal`: diagonal(sequence). Throws Error(kUsage) for options that
/// exclude one another, or that the sequence has too few frames for.
MeshPlan plan_mesh(const MeshSequence& sequence, const EncodeOptions& options,
                   std::vector<ClipGoal> goals, double diagonal);

/// The plan of a mesh that takes a target in per cent of its own size. Cost: O(vertices x frames).
/// @pre check(sequence) throws nothing
MeshPlan plan_mesh(const MeshSequence& sequence, const EncodeOptions& options);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PLAN_MESH_PLAN_H_
