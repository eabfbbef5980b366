// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Mesh Massage of a sequence (thesis section 3.3.1, texture transfer): every frame keeps its own
// surface, its triangles take the shapes that they have in one frame.
#ifndef ANICODEC_CODEC_MASSAGE_MASSAGE_H_
#define ANICODEC_CODEC_MASSAGE_MASSAGE_H_

#include "codec/massage/denoise.h"
#include "codec/massage/sliding_solver.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct MassageOptions {
  uint32_t reference = 0;    ///< the frame whose shapes the others follow
  double strength = 0.5;     ///< of shape, or of what frames share, against distance, in (0, 1)
  double tolerance = 0;      ///< how far a surface may move, scene units (limit_distance()); 0: any
  bool remove_noise = true;  ///< what single frames have of their own (denoise())
};

struct MassagedFrame {
  Convergence sliding, fitting;
  uint32_t drawn_back = 0;  ///< vertices drawn back by the tolerance, or to turn no triangle
};

struct MassageResult {
  MeshSequence sequence;
  std::vector<MassagedFrame> frames;
  DenoiseReport noise;
};

/// Massages every frame but the reference: vertices slide on the surface of their frame
/// (SlidingSolver). Over all frames, the reference included, what is each frame's own is then
/// taken out (denoise()); where there are too few frames for it, or it is not asked for,
/// a few rounds of the combined optimisation (ShapeFit) lift the ridges that sliding cut.
/// Triangles that turned are turned again (untangle()); at last limit_distance() draws back what
/// went further than the tolerance, and triangles that are turned still. Vertices with
/// bit-identical trajectories move together. Frames in parallel; the result does not depend on the
/// number of threads. Throws Error(kInput) for a sequence without triangles, Error(kUsage) for
/// options out of range. Stages "massaging" and "settling".
MassageResult massage(const MeshSequence& sequence, const MassageOptions& options,
                      const Progress& progress = {});

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_MASSAGE_H_
