// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FRAME_NOISE_H_
#define ANICODEC_CODEC_FRAME_NOISE_H_

#include "codec/mesh_sequence.h"
#include "codec/welded_clip.h"

namespace anicodec {

struct FrameNoiseReport {
  double sagitta = 0;     ///< mean height of the smooth surface over the triangles, scene units
  double moved = 0;       ///< mean distance of the vertices from it afterwards
  double components = 0;  ///< how many principal components' worth of motion is left; 0: untouched
};

/// Takes out of a massaged sequence what every frame has of its own: where its vertices slid to,
/// and that its polygons show a smooth surface from other samples. Filters all frames as strongly
/// (SequenceFilter) as keeps the vertices, in the mean over eight sample frames, within `share`
/// sagittas of the curved surfaces of `source`: so far the polygons themselves do not know their
/// surface. Leaves fewer than eight frames alone, they do not tell noise from motion. Cost: that of
/// SequenceFilter. Works on runs of at most 512 frames.
FrameNoiseReport remove_frame_noise(const MeshSequence& source, const WeldedClip& clip,
                                    double share, MeshSequence* massaged);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FRAME_NOISE_H_
