// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/turn_guard.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace anicodec {

uint32_t guarded_step(const SurfaceTopology& topology, const Positions& old, Positions step,
                      const std::function<void(uint32_t, const Eigen::Vector3d&)>& put,
                      const std::function<Eigen::Vector3d(uint32_t)>& up, const Positions& v) {
  constexpr double kShares[] = {0.5, 0.5, 0.5, 0.0};
  std::vector<uint32_t> todo(topology.vertex_count);
  std::iota(todo.begin(), todo.end(), 0U);
  std::vector<bool> shortened(topology.vertex_count, false);
  for (size_t attempt = 0;; ++attempt) {
    for (uint32_t i : todo)
      put(i, row(old, i) + row(step, i));
    if (attempt == std::size(kShares))
      break;
    todo.clear();
    for (uint32_t t = 0; t < topology.triangles.size(); ++t) {
      const SurfaceTopology::Triangle& triangle = topology.triangles[t];
      const Eigen::Vector3d direction = up(t);
      if (!(area_normal(v, triangle).dot(direction) < 0 &&
            area_normal(old, triangle).dot(direction) > 0))
        continue;
      todo.insert(todo.end(), triangle.begin(), triangle.end());
    }
    if (todo.empty())
      break;
    std::sort(todo.begin(), todo.end());
    todo.erase(std::unique(todo.begin(), todo.end()), todo.end());
    for (uint32_t i : todo) {
      step.row(static_cast<Eigen::Index>(i)) *= kShares[attempt];
      shortened[i] = true;
    }
  }
  return static_cast<uint32_t>(std::count(shortened.begin(), shortened.end(), true));
}

}  // namespace anicodec
