// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/surface/surface_frame.h"

namespace anicodec {

MeshSequence single_frame(const SurfaceFrame& mesh) {
  MeshSequence sequence;
  sequence.polygons = mesh.polygons;
  sequence.positions = mesh.positions;
  sequence.vertex_count = static_cast<uint32_t>(mesh.positions.size() / 3);
  sequence.frame_count = 1;
  check(sequence);
  return sequence;
}

}  // namespace anicodec
