// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_SEGMENT_H_
#define ANICODEC_SDK_SEGMENT_SEGMENT_H_

#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"
#include "sdk/base/host_progress.h"
#include "sdk/base/parallel_for.h"
#include "sdk/mesh/topology.h"
#include "sdk/msgi/msgi.h"
#include "sdk/pose/pose_coding.h"
#include "sdk/pose/reference_pose.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/decoded_integers.h"

#include <cstdint>

namespace anicodec {

/// Vertices are played in blocks: one coefficient of all vertices of a block is contiguous.
inline constexpr uint32_t kBlock = 16;

inline uint32_t block_count(uint32_t vertices) {
  return (vertices + kBlock - 1) / kBlock;
}

/// A row-major 3 x 4 matrix: rotation or linear part and translation of an affine map.
struct Affine {
  float m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

/// A segment, opened: every coefficient resident as an integer, every time weight as a float, so
/// that any frame costs the same (spec/09-reconstruction.md). All three basis kinds have this one
/// form:
///
///   x(v, f) = M_f * (A_f * pose(v) + sum_j weight(f, j) * coefficient(j, v)) + correction(v, f)
///
/// with A_f affine, M_f rigid, both optional. With regions, A_f and the weights are those of the
/// vertex' region. Its vertices are those of the user, in the user's order, or the coded ones
/// (SegmentContext::vertex_coded).
struct Segment {
  BasisKind kind = BasisKind::kKeyframes;
  Reconstruction reconstruction = Reconstruction::kLinear;
  uint32_t mesh = 0;
  uint32_t attribute = kPositions;  ///< that it moves, else the positions
  uint32_t first_component = 0;     ///< of the attribute: x(v, f) is added to three of them
  uint32_t first_frame = 0;
  uint32_t frames = 0;
  uint32_t vertices = 0;
  uint32_t components = 0;  ///< all resident ones; fewer than coded when opened at lower quality
  uint32_t wide_components = 0;  ///< the first ones, 32-bit; the others are 16-bit
  uint32_t regions = 1;          ///< of the surface, at most kMaxRegions

  /// Scalars per vertex of a component: 3 (a vector; one weight per frame) or, for trajectories, 1
  /// (and three weights per frame).
  uint32_t channels() const { return traits_of(kind).channels; }

  uint32_t weight_channels() const { return traits_of(kind).weight_channels; }

  Vector<float> pose;      ///< blocks x 3 x 16, empty when there is none
  Vector<int32_t> wide;    ///< blocks x wide_components x channels x 16
  Vector<int16_t> narrow;  ///< blocks x the other components x channels x 16
  /// frames x regions x components x weight_channels, coefficient scale included
  Vector<float> weights;
  Vector<Affine> pose_maps;  ///< A_f, frames x regions; empty when there is no pose
  /// Region of each vertex, blocks x 16, places past the last vertex repeat it; empty: all are of
  /// region 0.
  Vector<uint8_t> vertex_region;
  Vector<Affine> motions;  ///< M_f; empty when there are none

  Vector<uint32_t> keyframe_frames;  ///< source frame of each key-frame
  double origin[3] = {0, 0, 0};      ///< key-frame kind: offset of every coefficient vector

  /// Corrections of frame f are correction_begin[f] .. correction_begin[f+1]-1, ascending by
  /// vertex; empty when there are none. Added last, in scene units.
  struct Correction {
    uint32_t vertex;
    float delta[3];
  };

  Vector<uint32_t> correction_begin;
  Vector<Correction> corrections;

  /// The source's positions bit for bit, frames x coded vertices x 3, in place of what the basis
  /// makes of whole frames; empty when they are not there or not wanted.
  Vector<float> exact;

  /// Key-frames rebuilt by multi-scale geometry interpolation: one element, else empty. It makes
  /// the coded vertices, by the weights over weight_scale; vertex v is coded vertex
  /// vertex_coded[v], or v when that is empty. The same holds of `exact`.
  Vector<Msgi> msgi;
  double weight_scale = 1;
  Vector<uint32_t> vertex_coded;

  uint64_t stored_hash = 0;
  uint64_t decoded_hash = 0;
  uint64_t stored_exact_hash = 0;  ///< of `exact`
  uint64_t decoded_exact_hash = 0;

  size_t resident_bytes() const;
};

/// The decoded streams of a linear segment.
struct DecodedBasis {
  /// Regions x functions x 3 x frames; empty: the base keeps still.
  Vector<int32_t> affine_weights;
  Vector<int32_t> weights;     ///< components x regions x weight channels x frames
  Vector<uint32_t> order;      ///< coded vertex of each rank
  Vector<float> coefficients;  ///< in steps, by rank: rows of coefficient_stride()
};

/// The last order of vertices that a segment made by a pose, for others that are alike.
struct SharedOrder {
  VertexOrder order;
  int colours = 0;          ///< that a level was split into
  Vector<uint8_t> regions;  ///< of the vertices; empty: one

  bool is_of(int neighbours, int wanted_colours, const Vector<uint8_t>& wanted_regions) const {
    return order.neighbour_count == neighbours && colours == wanted_colours &&
           regions == wanted_regions;
  }
};

struct LearntSegment;

/// The surroundings that opening a segment needs besides its own record.
struct SegmentContext {
  const Limits::Segment* sizes = nullptr;
  const Limits::Mesh* mesh_sizes = nullptr;
  const Topology* topology = nullptr;
  /// Coded vertex of each vertex of the opened segment; null: it holds the coded vertices.
  const Vector<uint32_t>* vertex_coded = nullptr;
  const PoseGrid* pose = nullptr;    ///< null when the file has none for the segment
  const MeshGraph* graph = nullptr;  ///< edges of the topology's triangles; null: made when needed
  const CornerTable* corners = nullptr;  ///< of the topology; null: made when needed
  SharedOrder* order = nullptr;  ///< of the segments with this pose; null: the segment has its own
  /// The decoded weights and layers, if an encoder knows them; null: they are decoded.
  const DecodedBasis* decoded = nullptr;
  Vector<ByteView> layers;  ///< chunks BASI in file order
  ByteView corrections;     ///< chunk CORR, empty when there is none
  /// The segment's frames cut where a clip ends (Limits::runs()); empty: they are one run.
  Vector<uint32_t> runs;
  /// The models of the segment that this one continues; null: it begins anew.
  const LearntSegment* continued = nullptr;
  /// Receives what this one learns, in the memory that it was made in; may be null.
  LearntSegment* learnt = nullptr;
  double quality = 1;  ///< share of the components wanted
  /// Layers or corrections are still to come: as many components as are there are opened.
  bool partial = false;
  HostThreads threads;               ///< predict the vertices of a level; nothing depends on them
  DecodingTrace* trace = nullptr;    ///< sees every integer decoded; may be null
  HostProgress* progress = nullptr;  ///< gets segment_work() in all; may be null

  /// Tells the host of coefficients that were decoded; false when it wants to stop.
  bool advance(size_t coefficients) const {
    return !progress || progress->advance(static_cast<double>(coefficients));
  }
};

/// How many of its components are opened at a quality in (0, 1].
uint32_t wanted_components(double quality, uint32_t components);

/// The cost of opening a segment, about, in coefficients to decode.
double segment_work(const Limits::Segment& segment, const Limits::Mesh& mesh, double quality);

/// Opens a segment of any kind. Errors: kCancelled by the host; others are the file's. The counts
/// in `context` have been checked against the host's limits.
Status open_segment(const SegmentRecord& record, const SegmentContext& context, Segment* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_SEGMENT_H_
