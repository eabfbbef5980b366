// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_ENCODE_LIVE_H_
#define ANICODEC_CODEC_ENCODE_LIVE_H_

#include "codec/encode_mesh.h"
#include "codec/plan/encode_result.h"
#include "codec/plan/mesh_plan.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "format/bytes.h"
#include "sdk/clip/kept_learning.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace anicodec {

/// Seconds between files of a live stream that begin anew.
inline constexpr double kKeyEvery = 4;

/// A file of a live stream.
struct LivePiece : EncodeResult {
  bool is_key = false;    ///< it begins anew: whoever has the meshes goes on here
  bool has_mesh = false;  ///< it is no continuation: whoever joins begins here
};

/// Encodes frames while they come, as a live stream (spec/05-file-layout.md, section 8): a file for each few of
/// them. Mesh, attributes, order and reference pose are those of the first one, which alone has them as a rule.
class LiveEncoder {
 public:
  /// `mesh`: all but the frames, with the clock of the clip. Its attributes are kept as they are in it, but for those that
  /// have no frame (`frames` 0): each piece brings their values. A largest error in per cent is one of the diagonal
  /// `box` in scene units, or where that is 0 of the first file's frames; that of an attribute one of the range that it
  /// has there (of 1 where it rests). Effort::kFast takes the first file that keeps the
  /// target, others search as one less does for a whole clip. Files go on learning where the one before ended; the first
  /// that starts `key_every` seconds after one that began anew does so again, and whoever joins late or has lost a file
  /// goes on there; 0: each does. Throws Error(kUsage) for what needs all frames:
  /// sizes, key-frames, lossless files, massage, the motion of the whole.
  LiveEncoder(MeshSequence mesh, const EncodeOptions& options, double key_every = kKeyEvery,
              double box = 0);

  /// The next file of the stream: of frames x vertices x 3 floats, one frame at least, and for each attribute that moves, in their order,
  /// frames x elements x components. Elements at one vertex that moved alike and part begin a new mesh. Errors as of encode().
  /// Time and memory do not grow with the stream.
  LivePiece encode(FrameArray positions, std::vector<FrameArray> values = {},
                   const Progress& progress = {});

  /// All but the frames.
  const MeshSequence& mesh() const { return mesh_; }

 private:
  MeshSequence sequence_of(FrameArray positions, std::vector<FrameArray> values) const;
  bool fits(const MeshSequence& sequence) const;
  void begin(const MeshSequence& sequence);
  MeshPlan plan(const MeshSequence& sequence);

  MeshSequence mesh_;  ///< without frames; start_time: of the next file
  EncodeOptions options_;
  double box_;
  std::optional<ClipGoal> goal_;  ///< of all files; nothing before the first
  std::shared_ptr<const MeshLayout> layout_;
  std::shared_ptr<const std::vector<StoredAttribute>> stored_;
  Bytes base_;  ///< the file that continuations continue; empty: the next file brings the mesh
  double key_every_;
  /// Seconds of the files since the last one that began anew, this included.
  double since_key_ = 0;
  KeptLearning learning_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_ENCODE_LIVE_H_
