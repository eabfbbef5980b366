// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_
#define ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_

#include "codec/surface/surface.h"

#include <cstdint>
#include <functional>

namespace anicodec {

/// Moves vertices from `old` by `step`, and where that turns a triangle over, its three vertices by
/// half of it, at most three times, and then not at all. `put(i, q)` moves vertex i of `v` to q or
/// near it; `up(t)` is the direction that triangle t should face, of any length, zero if unknown. A
/// triangle that was turned before is none of the guard's business. Returns the number of vertices
/// whose step was shortened.
uint32_t guarded_step(const SurfaceTopology& topology, const Positions& old, Positions step,
                      const std::function<void(uint32_t, const Eigen::Vector3d&)>& put,
                      const std::function<Eigen::Vector3d(uint32_t)>& up, const Positions& v);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_MASSAGE_FOLD_GUARD_H_
