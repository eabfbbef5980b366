// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_RENDER_SHADED_VIEW_H_
#define ANICODEC_TOOLS_RENDER_SHADED_VIEW_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/render/image.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace anicodec::tools {

/// The box around everything that a camera is to show.
struct Box {
  std::array<float, 3> low{}, high{};
  bool empty = true;

  void add(std::span<const float> positions);
};

/// The view of the clip. Angles in degrees: azimuth about the up axis, from the front.
struct Camera {
  double azimuth = 30;
  double elevation = 15;
  bool z_up = false;
};

/// Pictures of a surface by a depth buffer: two lights, both sides visible, four samples per pixel,
/// smooth but for the edges that the clip says are hard. The same camera distance for every frame, so
/// that motion stays motion.
class ShadedView {
 public:
  /// Takes polygons and hard edges, as known_shared_normals() has them. Throws Error(kInput) when there is
  /// no triangle.
  ShadedView(const MeshSequence& sequence, const Box& box, uint32_t width, uint32_t height);
  ~ShadedView();

  /// One frame: vertices x 3. `colours`, if any: red, green, blue within [0, 1] of each vertex.
  Image draw(std::span<const float> positions, const Camera& camera,
             std::span<const float> colours = {});

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// Colour of a share of the largest error, from grey over yellow and red to black.
std::array<float, 3> error_colour(double share);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_RENDER_SHADED_VIEW_H_
