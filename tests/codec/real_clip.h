// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_CODEC_REAL_CLIP_H_
#define ANICODEC_TESTS_CODEC_REAL_CLIP_H_

#include "codec/sequence/frame_view.h"
#include "tests/real_data.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace anicodec {

/// Positions of a PC2 point cache; no frames where the file is absent or short.
struct RealClip {
  std::vector<float> positions;
  size_t frame_count = 0;
  size_t vertex_count = 0;

  FrameView view() const { return {positions.data(), frame_count, vertex_count}; }
};

inline RealClip read_real_clip(const std::string& name) {
  std::ifstream file(real_data_folder() + "/" + name, std::ios::binary);
  char head[32];
  RealClip clip;
  if (!file.read(head, sizeof head) || std::memcmp(head, "POINTCACHE2", 12) != 0) {
    return clip;
  }
  int32_t points = 0;
  int32_t samples = 0;
  std::memcpy(&points, head + 16, 4);
  std::memcpy(&samples, head + 28, 4);
  clip.vertex_count = static_cast<size_t>(points);
  clip.positions.resize(3 * clip.vertex_count * static_cast<size_t>(samples));
  if (file.read(reinterpret_cast<char*>(clip.positions.data()),
                static_cast<std::streamsize>(clip.positions.size() * sizeof(float)))) {
    clip.frame_count = static_cast<size_t>(samples);
  }
  return clip;
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_CODEC_REAL_CLIP_H_
