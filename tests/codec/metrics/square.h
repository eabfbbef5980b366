// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_METRICS_SQUARE_H_
#define ANICODEC_TESTS_CODEC_METRICS_SQUARE_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// A unit square in two triangles, the same in every frame.
inline MeshSequence square(uint32_t frames) {
  MeshSequence s;
  s.vertex_count = 4;
  s.frame_count = frames;
  s.polygons.add(std::vector<uint32_t>{0, 1, 2});
  s.polygons.add(std::vector<uint32_t>{0, 2, 3});
  for (uint32_t f = 0; f < frames; ++f) {
    for (float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F})
      s.positions.push_back(x);
  }
  return s;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_METRICS_SQUARE_H_
