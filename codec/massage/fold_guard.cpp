// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/fold_guard.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace anicodec {

uint32_t fold_guarded_step(const SurfaceTopology& topology, const Positions& old, Positions step,
                           const std::function<void(uint32_t, const Eigen::Vector3d&)>& move_to,
                           const std::function<Eigen::Vector3d(uint32_t)>& facing,
                           const Positions& v) {
  constexpr double kShares[] = {0.5, 0.5, 0.5, 0.0};
  std::vector<uint32_t> pending(topology.vertex_count);
  std::iota(pending.begin(), pending.end(), 0U);
  std::vector<bool> shortened(topology.vertex_count, false);
  for (size_t attempt = 0;; ++attempt) {
    for (uint32_t i : pending)
      move_to(i, row(old, i) + row(step, i));
    if (attempt == std::size(kShares))
      break;
    pending.clear();
    for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
      const SurfaceTopology::Triangle& triangle = topology.triangles[t];
      const Eigen::Vector3d direction = facing(t);
      if (!(area_normal(v, triangle).dot(direction) < 0 &&
            area_normal(old, triangle).dot(direction) > 0))
        continue;
      pending.insert(pending.end(), triangle.begin(), triangle.end());
    }
    if (pending.empty())
      break;
    std::sort(pending.begin(), pending.end());
    pending.erase(std::unique(pending.begin(), pending.end()), pending.end());
    for (uint32_t i : pending) {
      step.row(static_cast<Eigen::Index>(i)) *= kShares[attempt];
      shortened[i] = true;
    }
  }
  return static_cast<uint32_t>(std::count(shortened.begin(), shortened.end(), true));
}

}  // namespace anicodec
