// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_REMESH_SUBDIVIDE_H_
#define ANICODEC_CODEC_REMESH_SUBDIVIDE_H_

#include "codec/remesh/sound_mesh.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/surface/surface_frame.h"

#include <cstdint>

namespace anicodec {

/// Loop subdivision (Loop 1987), boundaries as cubic curves: every level cuts each triangle into
/// four and smooths, so that the result lies inside of convex parts. The same connectivity in every
/// frame; rate, times, axis, unit and name are kept, attributes and labels are not. Cost:
/// O(result), the connectivity anew for each frame. Throws Error(kInput) as sound_mesh(), and for a
/// result of more than 2^30 positions.
MeshSequence subdivide(const MeshSequence& sequence, uint32_t levels);

/// The same for one mesh. `repairs` may be null.
SurfaceFrame subdivide(const SurfaceFrame& mesh, uint32_t levels, MeshRepairs* repairs = nullptr);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_REMESH_SUBDIVIDE_H_
