// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/mesh_input.h"

#include "codec/sequence/error.h"
#include "tools/io/load_sequence.h"

#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {

SurfaceFrame load_mesh(const std::string& path, const Progress& progress) {
  LoadOptions options;
  options.progress = progress;
  MeshSequence mesh = load_sequence({&path, 1}, options);
  if (mesh.frame_count != 1)
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: one mesh is needed, not {} frames", path, mesh.frame_count));
  return {std::move(mesh.polygons), std::move(mesh.positions)};
}

MeshSequence with_positions(const SurfaceFrame& mesh, std::vector<float> positions) {
  MeshSequence result;
  result.polygons = mesh.polygons;
  result.vertex_count = static_cast<uint32_t>(positions.size() / 3);
  result.frame_count = 1;
  result.positions = std::move(positions);
  return result;
}

}  // namespace anicodec::tools
