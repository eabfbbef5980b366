// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Mesh Massage of a sequence (thesis section 3.3.1, texture transfer): every frame keeps its own
// surface, its triangles take the shapes that they have in one frame.
#ifndef ANICODEC_CODEC_MASSAGE_H_
#define ANICODEC_CODEC_MASSAGE_H_

#include "codec/mesh_sequence.h"
#include "codec/progress.h"
#include "codec/sliding_solve.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct MassageOptions {
  uint32_t reference = 0;  ///< the frame whose shapes the others follow; it stays as it is
  double strength = 0.5;   ///< of shape against distance in the last stage, in (0, 1)
  double tolerance = 0;    ///< how far a surface may move, scene units (limit_distance()); 0: any
  int sliding_rounds = 6;
  int fitting_rounds = 3;
};

struct MassagedFrame {
  Convergence sliding, fitting;
  uint32_t drawn_back = 0;  ///< vertices that the tolerance drew back
};

struct MassageResult {
  MeshSequence sequence;
  std::vector<MassagedFrame> frames;
};

/// Massages every frame but the reference: first vertices slide on the surface of their frame
/// (SlidingSolver), then a few rounds of the combined optimisation (SurfaceFitter) lift the ridges
/// that sliding cut, and the tolerance draws back what went too far. Vertices with bit-identical
/// trajectories move together. Frames in parallel; the result does not depend on the number of
/// threads. Throws Error(kInput) for a sequence without triangles, Error(kUsage) for options out of
/// range. Stage "massaging".
MassageResult massage(const MeshSequence& sequence, const MassageOptions& options,
                      const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_H_
