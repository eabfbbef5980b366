// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_DENOISE_H_
#define ANICODEC_CODEC_MASSAGE_DENOISE_H_

#include "codec/massage/welded_surface.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct DenoiseOptions {
  double slide_level = 5;         ///< of PatchFilter, for where vertices slide to
  double patch_allowance = 0.08;  ///< by how many sagittas PatchFilter may take vertices further
  double frame_allowance = 0.1;   ///< the same for SequenceFilter
  int rounds = 2;
};

struct DenoiseReport {
  double sagitta = 0;     ///< mean height of the smooth surface over the triangles, scene units
  double fitted = 0;      ///< mean distance of the vertices from it before positions are filtered
  double moved = 0;       ///< and afterwards
  double components = 0;  ///< of the motion of a patch that are left, in the mean; 0: untouched
};

/// Whether there are enough frames to tell noise from motion.
bool can_denoise(const MeshSequence& sequence);

/// Takes out of a massaged sequence what every frame has of its own: where its vertices slid to,
/// and that its polygons show a smooth surface from other samples. First where they are along the
/// surface: round by round all frames are filtered strongly (PatchFilter) and put back on the
/// curved surfaces of `source`, so that the vertices take the places that they share. Then heights
/// are fitted (fit_normals()) and the positions filtered, patches and at last whole frames
/// (SequenceFilter), each as strongly as takes the vertices, in the mean over eight sample frames,
/// further from those surfaces by no more than is allowed: a part of the sagitta, as far as the
/// polygons themselves do not know their surface. Vertices of the boundary stay on it, those
/// that `freedom` (sliding_freedom()) pins stay in place. Leaves fewer than eight frames alone.
/// Cost: that of PatchFilter and about 20 queries a vertex. Works on runs of at most 512 frames.
DenoiseReport denoise(const MeshSequence& source, const WeldedSurface& clip,
                      const std::vector<uint8_t>& freedom, const DenoiseOptions& options,
                      MeshSequence* massaged);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_DENOISE_H_
