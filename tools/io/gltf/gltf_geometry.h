// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_GLTF_GLTF_GEOMETRY_H_
#define ANICODEC_TOOLS_IO_GLTF_GLTF_GEOMETRY_H_

#include "tools/io/gltf/gltf.h"
#include "tools/io/gltf/gltf_document.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The moving values of a primitive's vertices; in a morph target, the differences.
struct GltfVectors {
  std::vector<float> positions;  ///< vertices x 3
  std::vector<float> normals;    ///< vertices x 3, or empty
  /// The targets' TEXCOORD_n -> vertices x 2, COLOR_n -> vertices x 4; where they change.
  std::map<std::string, std::vector<float>> sets = {};
};

/// The vertices of a primitive in the space of its mesh.
struct GltfVertices {
  uint32_t count = 0;
  GltfVectors base;
  std::vector<GltfVectors> targets;
  std::vector<float> tangents;                        ///< vertices x 4, or empty
  std::map<std::string, std::vector<float>> uvs;      ///< TEXCOORD_n -> vertices x 2
  std::map<std::string, std::vector<float>> colours;  ///< COLOR_n -> vertices x 4
  uint32_t influences = 0;                            ///< joints of a vertex, a multiple of 4
  std::vector<uint32_t> joints;                       ///< vertices x influences
  std::vector<float> weights;                         ///< the same; of a vertex they sum to 1
};

struct GltfGeometry {
  GltfVertices vertices;
  std::vector<uint32_t> triangles;  ///< x 3
};

/// Reads a primitive of triangles; strips and fans become lists. Throws Error(kInput) naming the
/// attribute.
GltfGeometry read_geometry(const GltfDocument& document, uint32_t mesh, size_t primitive,
                           const GltfOptions& options);

/// "/meshes/M/primitives/P".
std::string primitive_path(uint32_t mesh, size_t primitive);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_GLTF_GLTF_GEOMETRY_H_
