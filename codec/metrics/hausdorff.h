// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// How far two surfaces are apart whose connectivity may differ: the error of a massaged or
// retessellated clip.
#ifndef ANICODEC_CODEC_METRICS_HAUSDORFF_H_
#define ANICODEC_CODEC_METRICS_HAUSDORFF_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace anicodec {

/// From the samples of one surface to the closest points of the other, scene units.
struct SurfaceDistance {
  double mean = 0;
  double rms = 0;
  double max = 0;
};

/// Measured both ways; the larger distance of each kind counts, as in METRO (Cignoni, Rocchini and
/// Scopigno 1998).
struct HausdorffDistance {
  SurfaceDistance forward;   ///< from the first surface to the second
  SurfaceDistance backward;  ///< from the second to the first

  double mean() const { return std::max(forward.mean, backward.mean); }

  double rms() const { return std::max(forward.rms, backward.rms); }

  double max() const { return std::max(forward.max, backward.max); }
};

/// Polygons are cut into fans from their first corner. A surface is sampled at the vertices, edge
/// mid-points and centres of its triangles (degenerate ones too; unused vertices are not part of
/// it); mean and RMS weigh them by area with the seven-point rule that is exact for cubic functions
/// on a triangle, or equally if the area is 0. The maximum is that of the samples, a lower bound of
/// the true one. A mesh without triangles is the cloud of all its vertices. Distances are exact in
/// double (see ClosestPointQuery). Positions are x y z per vertex. Cost: about 6 queries a vertex,
/// on all threads; the result does not depend on their number. Throws Error(kInput) for a surface
/// without vertices or with positions that are not finite.
HausdorffDistance hausdorff(const Polygons& a, std::span<const float> a_positions,
                            const Polygons& b, std::span<const float> b_positions);

struct SurfaceComparison {
  HausdorffDistance total;  ///< means and RMS over all frames, maximum of all
  uint32_t max_frame = 0;   ///< the first frame with the maximum
  double diagonal = 0;      ///< of the box around all frames of the first clip, scene units
  std::vector<HausdorffDistance> frames;

  /// A length in per cent of the diagonal; infinite if the diagonal is 0 and the length is not.
  double percent(double length) const { return length == 0 ? 0 : 100 * length / diagonal; }
};

/// Compares two clips of equally many frames, frame by frame, each asked for once and in order.
/// Memory: one frame and its hierarchy. Throws as hausdorff(), and Error(kInput) for no frame.
SurfaceComparison compare_surfaces(const Polygons& a, const FrameSource& a_frames,
                                   const Polygons& b, const FrameSource& b_frames,
                                   uint32_t frame_count);

/// The same for two clips in memory. Throws Error(kInput) if the numbers of frames differ.
SurfaceComparison compare_surfaces(const MeshSequence& a, const MeshSequence& b);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_METRICS_HAUSDORFF_H_
