// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SURFACE_SURFACE_FRAME_H_
#define ANICODEC_CODEC_SURFACE_SURFACE_FRAME_H_

#include "codec/sequence/mesh_sequence.h"

#include <vector>

namespace anicodec {

/// A mesh by itself.
struct SurfaceFrame {
  Polygons polygons;
  FrameArray positions;  ///< vertices x 3
};

/// The mesh as a sequence of one frame. Throws as check().
MeshSequence single_frame(const SurfaceFrame& mesh);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SURFACE_SURFACE_FRAME_H_
