// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/textures/texel_mesh.h"

#include "tools/io/gltf/glb_output.h"

#include <algorithm>
#include <array>

namespace anicodec::tools {
namespace {

Attribute coordinates(const MeshSequence& clip, std::string name) {
  Attribute uv;
  uv.name = std::move(name);
  uv.domain = clip.polygons.size() > 0 ? AttributeDomain::kCorner : AttributeDomain::kVertex;
  uv.values.resize(2 * element_count(clip, uv.domain));
  return uv;
}

/// Numbers that no two corners share.
Attribute corner_numbers(const MeshSequence& clip) {
  constexpr size_t kRow = 4096;
  Attribute numbers = coordinates(clip, {});
  for (size_t c = 0; 2 * c < numbers.values.size(); ++c) {
    numbers.values[2 * c] = static_cast<float>(c % kRow);
    numbers.values[2 * c + 1] = static_cast<float>(c / kRow);
  }
  return numbers;
}

}  // namespace

TexelMesh::TexelMesh(MeshSequence clip) : clip_(std::move(clip)) {
  clip_.frame_count = 1;
  clip_.clips.clear();
  clip_.times.clear();
  clip_.parts = {};
  clip_.up = UpAxis::kY;
  clip_.metres_per_unit = 1;
  clip_.origin = {};
  std::erase_if(clip_.attributes, [](const Attribute& a) { return !GlbVertices::is_written(a); });
  // A GLB without normals is flat.
  if (clip_.shared_normals.empty())
    clip_.shared_normals = clip_.polygons.corners;
  std::vector<Attribute> splitting = clip_.attributes;
  if (GlbVertices::is_flat(clip_))
    splitting.push_back(corner_numbers(clip_));
  vertices_.emplace(clip_, splitting);
  if (has_normals())
    normals_.emplace(clip_);
}

std::vector<float> TexelMesh::normals(std::span<const float> frame) const {
  const std::vector<float> all = normals_->compute(frame);
  std::vector<float> out;
  out.reserve(size_t{3} * vertex_count());
  for (uint32_t c : vertices_->corners()) {
    const std::array<float, 3> none = {0, 0, 1};
    const float* normal =
        c == GlbVertices::kNoCorner ? none.data() : all.data() + size_t{3} * normals_->of_corner(c);
    out.insert(out.end(), normal, normal + 3);
  }
  return out;
}

std::string TexelMesh::glb(std::span<const float> rest,
                           const std::vector<TexelPlace>& places) const {
  MeshSequence mesh = clip_;
  Attribute texels = coordinates(mesh, "texel");
  auto set = [&](size_t element, uint32_t v) {
    texels.values[2 * element] = static_cast<float>(places[v].first);
    texels.values[2 * element + 1] =
        static_cast<float>(1 - places[v].second);  // v of a clip points up
  };
  const bool by_corner = texels.per_corner();
  for (uint32_t v = 0; !by_corner && v < places.size(); ++v)
    set(v, v);
  for (uint32_t c = 0; by_corner && c < mesh.polygons.corners.size(); ++c)
    set(c, vertices_->of_corner(c));
  auto is_uv = [](const Attribute& a) { return a.kind == AttributeKind::kUv; };
  auto first = std::ranges::find_if(mesh.attributes, is_uv);
  if (first == mesh.attributes.end())
    first = mesh.attributes.insert(first, coordinates(mesh, "TEXCOORD_0"));
  mesh.attributes.insert(first + 1, std::move(texels));
  GlbOutput glb(mesh, false);
  glb.add_frame(rest, mesh.attributes);
  return glb.finish({});
}

}  // namespace anicodec::tools
