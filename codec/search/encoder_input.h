// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEARCH_ENCODER_INPUT_H_
#define ANICODEC_CODEC_SEARCH_ENCODER_INPUT_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/plan/encoding_memory.h"
#include "codec/plan/target.h"
#include "codec/search/search_progress.h"
#include "codec/segment/encoded_segment.h"
#include "codec/sequence/frame_view.h"
#include "codec/sequence/mesh_sequence.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace anicodec {

/// A clip of what is coded.
struct InputClip {
  explicit InputClip(const FrameRun& run) : frames(run) {}

  FrameRun frames;
  double kg_reference = 0;        ///< as that of the whole
  double largest_coordinate = 0;  ///< in magnitude
  /// The error that it may have for each of the whole; 0: no matter.
  double tolerance = 0;
  std::optional<double> cap;  ///< the maximum error to which it is corrected, scene units

  /// The smallest maximum error that float32 keeps at its coordinates, scene units.
  double smallest_bound() const;
};

/// The clip by coded vertices, and its way back to the source: shared by all ways of coding.
struct EncoderInput {
  /// Takes the positions over: they are put into coded order in place. For a part, only its frames
  /// remain; the mesh serves all parts. `laid_out`: the mesh, where a file has it; null: to be laid
  /// out.
  explicit EncoderInput(MeshSequence source, const std::optional<FrameRun>& part = {},
                        const MeshLayout* laid_out = nullptr);

  /// One of the clips alone, for another search with its own goal.
  EncoderInput(const EncoderInput& all, size_t clip);

  /// The trajectories of an attribute: frames of the clip x entries x 3, over its surface
  /// (StoredAttribute::surface).
  EncoderInput(const EncoderInput& clip, const Topology& surface, FrameArray trajectories);

  FrameView frames(size_t first, size_t count) const { return frames().frames(first, count); }

  FrameView frames() const {
    return {coded.data(), sequence.frame_count, layout.sizes.coded_vertices};
  }

  /// Root mean square over the source's vertices and some frames.
  double rmse(double squared, size_t frames) const;

  /// The frames that a decoder is to show.
  FrameView shown() const {
    return {whole.empty() ? coded.data() : whole.data(), sequence.frame_count,
            layout.sizes.coded_vertices};
  }

  /// Keeps the positions of the source, frames x vertices x 3, which `coded` has without the motion
  /// of the whole.
  void keep_whole(const FrameArray& positions);

  double rmse(double squared) const { return rmse(squared, sequence.frame_count); }

  /// The root mean square error, scene units, of a KG error in per cent.
  double rmse_of_kg(double kg) const;

  /// How many of `count` frames from `first` on each clip has (Limits::runs()).
  Vector<uint32_t> runs(uint32_t first, uint32_t count) const;

  /// Makes every clip keep its goal where the whole is coded to the largest of their targets, which are of one
  /// metric: a KG error or root mean square error, any length that is not the same for all, and maximum errors.
  /// Throws Error(kUsage) for a maximum error that float32 cannot keep.
  void bound_clips(const std::vector<ClipGoal>& goals);

  bool bounds_clips() const { return clips[0].tolerance > 0 && clips.size() > 1; }

  /// Whether the clips may have errors that differ by more than time weights of one basis can.
  bool bounds_differ() const;

  bool caps_errors() const { return clips[0].cap.has_value(); }

  /// The caps of some frames.
  std::vector<double> caps(uint32_t first, uint32_t count) const;

  /// The error of each clip that has frames from `first` on, as a multiple of what it may be if the
  /// whole may have `rmse`.
  std::vector<double> excesses(const SegmentError& error, uint32_t first, double rmse) const;

  /// The largest of those of the clips.
  double smallest_bound() const;

  /// `first_pose` around its centre, which goes to `origin`.
  Eigen::MatrixXd centred_first_pose(Eigen::Vector3d* origin) const;

  MeshSequence sequence;     ///< the source without its positions
  uint32_t first_frame = 0;  ///< of the source, that a part begins with
  MeshLayout layout;
  FrameArray coded;  ///< frames x coded vertices x 3
  /// The coded positions with the motion of the whole, if it was taken out. Else empty.
  FrameArray whole;
  std::vector<InputClip> clips;   ///< one at least, in the order of their frames
  std::vector<uint32_t> copies;   ///< source vertices of each coded one
  double kg_reference = 0;        ///< denominator of the KG error, squared; 1 where it is 0
  double largest_coordinate = 0;  ///< in magnitude, of all clips
  std::vector<float> first_pose;  ///< coded vertices x 3: frame 0 of the source, before any cut
  std::shared_ptr<const EncodedPose> pose;  ///< what a part must refer to, else null

  Learning learning;  ///< of segments of positions that lean on the pose that is given

  FileOptions described;  ///< for the size of trial files

  std::vector<std::string> without;  ///< CodingOptions::without

  std::shared_ptr<MemoryBudget> memory;  ///< null: no limit

  /// Takes memory for some of its frames, see EncodingMemory; `bytes` gives it by their counts. Throws OverMemory.
  template <class Bytes>
  MemoryShare take_memory(size_t frame_count, const char* stage, const Bytes& bytes) const {
    if (!memory)
      return {};
    return memory->take(
        bytes(EncodingMemory{static_cast<double>(copies.size()), static_cast<double>(frame_count)}),
        stage);
  }

  /// Whether a search may do what has this name among search_means().
  bool allows(const char* mean) const { return std::ranges::find(without, mean) == without.end(); }

  SearchProgress* progress = nullptr;  ///< told of all steps, in any thread; null: nobody is

  void begin(SearchStep step) const {
    if (progress)
      progress->begin(step);
  }

  void expect(const TrialsLeft& left) const {
    if (progress)
      progress->expect(left);
  }
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEARCH_ENCODER_INPUT_H_
