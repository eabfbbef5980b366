// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/mesh.h"

#include "codec/sequence/error.h"

namespace anicodec::tools {

void fail_input(std::string_view name, const std::string& text) {
  throw Error(ErrorKind::kInput, std::string(name) + ": " + text);
}

void fail_usage(std::string_view name, const std::string& text) {
  throw Error(ErrorKind::kUsage, std::string(name) + ": " + text);
}

void check_size(const Mesh& mesh, std::string_view name) {
  if (mesh.positions.empty())
    fail_input(name, "the mesh has no vertex");
  if (mesh.vertex_count() > kMaxVertices || mesh.polygons.corners.size() > kMaxCorners)
    fail_input(name, "the mesh is too large: at most 2^31 - 1 vertices and 2^32 - 1 face corners");
}

}  // namespace anicodec::tools
