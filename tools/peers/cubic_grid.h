// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Positions on a cubic grid, the same for all frames: what codecs without a basis store.
#ifndef ANICODEC_TOOLS_PEERS_CUBIC_GRID_H_
#define ANICODEC_TOOLS_PEERS_CUBIC_GRID_H_

#include "codec/metrics/metrics.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec::peers {

struct GriddedClip {
  double origin[3] = {0, 0, 0};  ///< smallest position
  double step = 0;               ///< scene units
  uint32_t largest = 0;          ///< largest of the integers
  std::vector<uint32_t> values;  ///< frames x vertices x 3
  Comparison error;              ///< of origin + step * value, in float, without STED
};

/// Rounds all positions to the nearest grid point. Throws Error(kUsage) if the step is too fine for
/// 31 bits.
GriddedClip on_grid(const MeshSequence& sequence, double step);

/// The same with nearly the largest step whose KG error is at most `kg` per cent: the error is at
/// least 99.5 % of what is asked unless the clip does not move at all.
GriddedClip on_grid_at_kg(const MeshSequence& sequence, double kg);

}  // namespace anicodec::peers

#endif  // ANICODEC_TOOLS_PEERS_CUBIC_GRID_H_
