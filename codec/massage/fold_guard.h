// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_
#define ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <functional>

namespace anicodec {

/// Moves vertices from `old` by `step`. The three vertices of a triangle that would fold go half as
/// far, at most three times, and then not at all; triangles already folded are ignored.
/// `move_to(i, q)` moves vertex i of `v` to q or near it; `facing(t)` is the direction that
/// triangle t should face, of any length, zero if unknown. Returns the number of vertices whose
/// step was shortened.
uint32_t fold_guarded_step(const SurfaceTopology& topology, const Positions& old, Positions step,
                           const std::function<void(uint32_t, const Eigen::Vector3d&)>& move_to,
                           const std::function<Eigen::Vector3d(uint32_t)>& facing,
                           const Positions& v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_
