// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FRAME_NOISE_H_
#define ANICODEC_CODEC_FRAME_NOISE_H_

#include "codec/mesh_sequence.h"
#include "codec/welded_clip.h"

#include <cstdint>
#include <vector>

namespace anicodec {

struct FrameNoiseOptions {
  double slide_level = 5;  ///< of PatchFilter, for where vertices slide to
  double last_level = 1;   ///< the same for positions, at last
  double share = 0.8;      ///< how far from the surface the last filter may take the vertices
  int rounds = 2;
};

struct FrameNoiseReport {
  double sagitta = 0;     ///< mean height of the smooth surface over the triangles, scene units
  double moved = 0;       ///< mean distance of the vertices from it afterwards
  double components = 0;  ///< of the motion of a patch that are left, in the mean; 0: untouched
};

/// Whether there are enough frames to tell noise from motion.
bool can_remove_frame_noise(const MeshSequence& sequence);

/// Takes out of a massaged sequence what every frame has of its own: where its vertices slid to,
/// and that its polygons show a smooth surface from other samples. First where they are along the
/// surface: round by round all frames are filtered strongly (PatchFilter) and put back on the
/// curved surfaces of `source`, so that the vertices take the places that they share. Then heights
/// are fitted (fit_heights()) and the frames filtered once more, as strongly as asked and as keeps
/// the vertices, in the mean over eight sample frames, within `share` sagittas of those surfaces:
/// so far the polygons themselves do not know their surface; eight times as strongly where that
/// takes them at most a tenth further. Whole frames are filtered at last (SequenceFilter), as
/// strongly as adds at most a tenth to that distance. Vertices of the boundary stay on it, those
/// that `freedom` (sliding_freedom()) pins stay in place. Leaves fewer than eight frames alone.
/// Cost: that of PatchFilter and about 20 queries a vertex. Works on runs of at most 512 frames.
FrameNoiseReport remove_frame_noise(const MeshSequence& source, const WeldedClip& clip,
                                    const std::vector<uint8_t>& freedom,
                                    const FrameNoiseOptions& options, MeshSequence* massaged);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FRAME_NOISE_H_
