// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_BENCH_GPU_FRAMES_TEXTURE_H_
#define ANICODEC_TESTS_BENCH_GPU_FRAMES_TEXTURE_H_

#include "sample.h"

#include <cstdint>
#include <vector>

namespace anicodec::bench {

/// Clip 0 of a mesh as a vertex-animation texture: four float16 for each vertex and frame. An instance is a row of a texture of
/// states: its map to the world and two frames with the share of the second, 64 bytes.
class FramesTexture {
 public:
  /// Ends the program where frames are not even, the mesh is not there in one, or no texture holds them. Cost: a seek and
  /// positions of every frame.
  FramesTexture(const Model& model, uint32_t instances);

  /// Adds an instance, `seconds` after the first frame, in a loop.
  void stage(double seconds, const float map[12]);

  void clear() { staged_.clear(); }

  void upload() const;
  /// All staged instances.
  void draw(const float view[16], const float colour[3]) const;
  /// The vertices of the first staged instance, for transform feedback of "shown".
  void draw_points() const;

  uint64_t texture_bytes() const { return texture_bytes_; }

  uint64_t staged_bytes() const { return sizeof(float) * staged_.size(); }

 private:
  void bind() const;

  const Model* model_;
  uint32_t frames_ = 0, width_ = 0, rows_ = 0;
  double rate_ = 0, loop_ = 0;
  uint64_t texture_bytes_ = 0;
  GLuint program_ = 0, texture_ = 0, state_ = 0;
  std::vector<float> staged_;
};

}  // namespace anicodec::bench

#endif  // ANICODEC_TESTS_BENCH_GPU_FRAMES_TEXTURE_H_
