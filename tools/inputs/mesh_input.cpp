// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/mesh_input.h"

#include "codec/sequence/error.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {

namespace {

bool goes_with_shape(const Attribute& attribute) {
  return attribute.kind == AttributeKind::kNormal || attribute.kind == AttributeKind::kTangent;
}

size_t polygon_of(const Polygons& polygons, uint32_t corner) {
  return static_cast<size_t>(std::ranges::upper_bound(polygons.offsets, corner) -
                             polygons.offsets.begin()) -
         1;
}

/// An attribute of a surface at points of it.
Attribute sampled(const Attribute& from, const Polygons& polygons,
                  std::span<const MeshPoint> points) {
  Attribute to = from;
  to.domain = AttributeDomain::kCorner;
  to.frames = 1;
  to.values.clear();
  for (const MeshPoint& point : points) {
    for (uint32_t i = 0; i < from.components; ++i) {
      double value = 0;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t corner = point.corners[k];
        const size_t element = from.per_corner()   ? corner
                               : from.per_vertex() ? polygons.corners[corner]
                                                   : polygon_of(polygons, corner);
        value += point.weights[k] * static_cast<double>(from.values[element * from.components + i]);
      }
      to.values.push_back(static_cast<float>(value));
    }
  }
  return to;
}

}  // namespace

MeshSequence load_mesh(const std::string& path, const Progress& progress) {
  LoadOptions options;
  options.progress = progress;
  MeshSequence mesh = load_sequence({&path, 1}, options);
  if (mesh.frame_count != 1)
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: one mesh is needed, not {} frames", path, mesh.frame_count));
  return mesh;
}

SurfaceFrame surface_of(const MeshSequence& mesh) {
  return {mesh.polygons, mesh.positions};
}

MeshSequence with_positions(MeshSequence mesh, std::span<const float> positions) {
  mesh.positions.assign(positions.begin(), positions.end());
  std::erase_if(mesh.attributes, goes_with_shape);
  return mesh;
}

void carry_details(const MeshSequence& surface, const MeshMap& map, MeshSequence* mesh) {
  mesh->attributes.clear();
  mesh->shared_normals.clear();
  for (const Attribute& attribute : surface.attributes) {
    if (!goes_with_shape(attribute))
      mesh->attributes.push_back(sampled(attribute, surface.polygons, map.corners));
  }
  mesh->parts = {};
  mesh->materials = surface.materials;
  mesh->materials.of_polygon.clear();
  for (size_t p = 0; p < mesh->polygons.size() && !surface.materials.of_polygon.empty(); ++p) {
    std::map<uint32_t, size_t> votes;
    for (uint32_t c = mesh->polygons.offsets[p]; c < mesh->polygons.offsets[p + 1]; ++c)
      ++votes[surface.materials.of_polygon[map.corners[c].polygon]];
    const auto most = std::ranges::max_element(
        votes, [](const auto& a, const auto& b) { return a.second < b.second; });
    mesh->materials.of_polygon.push_back(most == votes.end() ? kNoLabel : most->first);
  }
}

}  // namespace anicodec::tools
