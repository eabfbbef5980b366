// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_ENCODED_SEGMENT_H_
#define ANICODEC_CODEC_SEGMENT_ENCODED_SEGMENT_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/sequence/frame_view.h"
#include "format/bounds_record.h"
#include "format/records.h"
#include "sdk/segment/segment.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

/// A reference pose, ready for the file.
struct EncodedPose {
  PoseGrid grid;
  Bytes stream;
};

/// How a segment of a live stream learns for the next one.
struct Learning {
  bool hands_on = false;                     ///< whether its decoder keeps what it learns
  const LearntSegment* continued = nullptr;  ///< where it may go on; null: it begins anew
};

/// The streams of one segment, ready for the file.
struct EncodedSegment {
  Limits::Segment sizes;
  Bytes parameters, pose, motion, weights;
  Vector<uint32_t> runs;         ///< frames of each clip; empty: of one
  std::vector<Bytes> layers;     ///< chunks BASI
  size_t coefficient_bytes = 0;  ///< of the layers, without weights
  size_t time_weights = 0;       ///< how many values they are, of bases and components
  Bytes corrections;             ///< chunk CORR
  Bytes exact;                   ///< chunk DIFF
  BoundsRecord bounds;           ///< chunk BNDS, of positions; without numbers until measured
  std::shared_ptr<const EncodedPose> reference;  ///< of linear bases; segments may share it
  /// The decoded weights and layers, if they were just encoded: opened once without decoding them.
  std::optional<DecodedBasis> decoded;
  /// The state that it was coded to go on with, as long as it is opened; may be null.
  const LearntSegment* continued = nullptr;
  uint64_t continued_identity = 0;  ///< SegmentRecord::continued
  uint64_t hash = 0;

  /// Bytes in the file but for what the reference pose takes.
  size_t bytes() const;
};

/// How far a decoded segment is from the coded vertices of the source.
struct SegmentError {
  double squared = 0;  ///< summed over the source's vertices and frames
  double max = 0;      ///< largest distance
  std::vector<double> squared_by_frame;
};

/// Opens a segment as a decoder does, from streams in memory, and stores its hash in `encoded`. Uses up
/// encoded.decoded.
Segment open_encoded(EncodedSegment& encoded, const MeshLayout& layout);

/// Plays every frame of a segment against `source` (coded vertices, the segment's frames). A coded
/// vertex counts as often as the source has it: `copies`.
SegmentError measure(const Segment& segment, const FrameView& source,
                     const std::vector<uint32_t>& copies);

/// Adds corrections so that no vertex is further from the source than the bound of its frame;
/// replaces earlier ones. `segment` is opened without corrections and gets them. The hash covers
/// them too: open_encoded() stores the new one. Throws Error(kUsage) when float32 is too coarse for
/// the bound.
void correct(const FrameView& source, const std::vector<uint32_t>& copies,
             const std::vector<double>& bounds, Segment& segment, EncodedSegment& encoded);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_ENCODED_SEGMENT_H_
