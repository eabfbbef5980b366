// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// How far a decoded clip of the same connectivity is from its original, p original, q decoded.
#ifndef ANICODEC_CODEC_METRICS_METRICS_H_
#define ANICODEC_CODEC_METRICS_METRICS_H_

#include "codec/metrics/sted.h"
#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct FrameError {
  double rmse = 0;          ///< over the vertices of the frame, scene units
  double max = 0;           ///< largest |p - q|, scene units
  uint32_t max_vertex = 0;  ///< where
  double sted_spatial = 0;  ///< the frame's part of STED, 0 if not asked for
};

struct Comparison {
  /// KG error (Karni and Gotsman 2004) in per cent: 100 |p - q| / |p - m|, norms over all frames,
  /// vertices and coordinates, m the mean of the original frame's vertices. A denominator of 0
  /// counts as 1.
  double kg = 0;
  double rmse = 0;          ///< sqrt of the mean over frames and vertices of |p - q|^2, scene units
  double max_error = 0;     ///< largest |p - q|, scene units
  uint32_t max_frame = 0;   ///< the first frame that has it
  uint32_t max_vertex = 0;  ///< and its first vertex
  double diagonal = 0;      ///< of the box around all frames of the original, scene units
  double psnr = 0;          ///< 20 log10(diagonal / rmse), dB; infinite if equal
  /// sqrt of the mean over frames 1.. and vertices of the squared length of the difference of the
  /// moves since the frame before, scene units; 0 for one frame.
  double displacement_error = 0;
  double max_displacement_error = 0;  ///< the largest of these lengths
  bool has_sted = false;
  Sted sted;  ///< if has_sted
  std::vector<FrameError> frames;

  /// A length in per cent of the diagonal; infinite if the diagonal is 0 and the length is not.
  double percent(double length) const;
};

struct CompareOptions {
  bool sted = true;  ///< about ten times the cost of all the rest
};

/// Compares two clips frame by frame; both sources are asked for each frame once, in order. Sums
/// are in double and in a fixed order. Memory: two frames of floats, with STED what StedMeter
/// needs. Cost: one pass, limited by memory. Throws Error(kInput) for no frame, no vertex, a frame
/// of the wrong size, and positions that are not finite, naming clip, frame and vertex.
Comparison compare(const Polygons& polygons, uint32_t vertex_count, uint32_t frame_count,
                   const FrameSource& original, const FrameSource& decoded,
                   const CompareOptions& options = {});

/// The same for two clips in memory. Throws Error(kInput) if the counts of vertices or frames
/// differ; faces are taken from the original.
Comparison compare(const MeshSequence& original, const MeshSequence& decoded,
                   const CompareOptions& options = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_METRICS_METRICS_H_
