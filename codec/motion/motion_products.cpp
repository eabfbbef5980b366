// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/motion/motion_products.h"

#include "codec/motion/frame_products.h"
#include "codec/motion/motion_sketch.h"
#include "codec/motion/vertex_products.h"
#include "codec/parallel/parallel.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace anicodec {

double motion_energy(const FrameView& clip, const Eigen::Vector3d& origin) {
  std::vector<double> squares(clip.frame_count, 0);
  parallel_for(size_t{0}, clip.frame_count, [&](size_t f) {
    const float* p = clip.frame(f);
    for (size_t v = 0; v < clip.vertex_count; ++v, p += 3)
      squares[f] += (Eigen::Vector3d(p[0], p[1], p[2]) - origin).squaredNorm();
  });
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

std::unique_ptr<const MotionProducts> motion_products(const FrameView& clip,
                                                      const Eigen::Vector3d& origin,
                                                      const Eigen::VectorXd& sums) {
  if (std::min(clip.frame_count, clip.vertex_count) > kMostMultiplied)
    return std::make_unique<MotionSketch>(clip, origin, sums);
  // An empty region has no products of vertices to decompose.
  if (clip.frame_count <= clip.vertex_count || clip.vertex_count == 0)
    return std::make_unique<FrameProducts>(clip, origin, sums);
  const auto vertices = static_cast<Eigen::Index>(clip.vertex_count);
  return std::make_unique<VertexProducts>(clip, origin, Eigen::VectorXd::Ones(vertices),
                                          clip.vertex_count);
}

}  // namespace anicodec
