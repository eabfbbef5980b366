// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TWO_BOXES_H_
#define ANICODEC_TESTS_TWO_BOXES_H_

#include "codec/sequence/mesh_sequence.h"
#include "corpus/clips.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace anicodec {

inline constexpr uint32_t kBoxFrames = 12;

/// A box that turns and moves, "still" beside it, which is hidden (all at one point) in frames 4 to
/// 7; vertices of the first come before those of the second.
inline MeshSequence two_boxes() {
  const MeshSequence box = corpus::make_clip("painted_box");
  MeshSequence scene;
  scene.name = "boxes";
  scene.frame_count = kBoxFrames;
  scene.vertex_count = 2 * box.vertex_count;
  scene.parts.names = {"turning", "still"};
  scene.materials = {box.materials.names, {}};
  for (uint32_t part = 0; part < 2; ++part) {
    for (size_t p = 0; p < box.polygons.size(); ++p) {
      std::vector<uint32_t> polygon(box.polygons[p].begin(), box.polygons[p].end());
      for (uint32_t& v : polygon)
        v += part * box.vertex_count;
      scene.polygons.add(polygon);
      scene.parts.of_polygon.push_back(part);
      scene.materials.of_polygon.push_back(box.materials.of_polygon[p]);
    }
  }
  for (uint32_t f = 0; f < kBoxFrames; ++f) {
    const float angle = 0.3F * static_cast<float>(f);
    for (uint32_t v = 0; v < box.vertex_count; ++v) {
      const float *p = &box.positions[size_t{3} * v], c = std::cos(angle), s = std::sin(angle);
      scene.positions.insert(scene.positions.end(),
                             {c * p[0] - s * p[1] + angle, s * p[0] + c * p[1], p[2]});
    }
    const bool hidden = f >= 4 && f < 8;
    for (uint32_t v = 0; v < box.vertex_count; ++v) {
      const float* p = &box.positions[hidden ? 0 : size_t{3} * v];
      scene.positions.insert(scene.positions.end(), {p[0] + 5, p[1], p[2]});
    }
  }
  return scene;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_TWO_BOXES_H_
