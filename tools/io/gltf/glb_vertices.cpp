// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/gltf/glb_vertices.h"

#include "codec/sequence/triangulate.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace anicodec::tools {

GlbVertices::GlbVertices(const MeshSequence& clip, const std::vector<Attribute>& attributes) {
  std::vector<uint32_t> part_of_corner(clip.polygons.corners.size(), kNoLabel);
  for (size_t p = 0; p < clip.parts.of_polygon.size(); ++p) {
    for (uint32_t c = clip.polygons.offsets[p]; c < clip.polygons.offsets[p + 1]; ++c)
      part_of_corner[c] = clip.parts.of_polygon[p];
  }
  split_vertices(clip, attributes, part_of_corner);
  sort_by_object(part_of_corner);
}

bool GlbVertices::is_flat(const MeshSequence& clip) {
  for (size_t p = 0; p < clip.polygons.size(); ++p) {
    if (clip.polygons[p].size() != 3)
      return false;
  }
  // Corners at several vertices of one place may share a normal, too, so that their numbers must differ.
  const std::set<uint32_t> numbers(clip.shared_normals.begin(), clip.shared_normals.end());
  return !numbers.empty() && numbers.size() == clip.polygons.corners.size();
}

bool GlbVertices::is_written(const Attribute& a) {
  return a.domain != AttributeDomain::kPolygon &&
         ((a.kind == AttributeKind::kUv && a.components == 2) ||
          (a.kind == AttributeKind::kColour && (a.components == 3 || a.components == 4)));
}

void GlbVertices::split_vertices(const MeshSequence& clip, const std::vector<Attribute>& attributes,
                                 const std::vector<uint32_t>& part_of_corner) {
  std::vector<std::span<const float>> of_corners;
  for (const Attribute& a : attributes) {
    const size_t row = a.values.size() / a.frames;
    for (uint32_t f = 0; a.per_corner() && is_written(a) && f < a.frames; ++f)
      of_corners.push_back(std::span<const float>(a.values).subspan(row * f, row));
  }
  const bool by_normals = !clip.shared_normals.empty() && !is_flat(clip);
  source_.resize(clip.vertex_count);
  std::iota(source_.begin(), source_.end(), 0U);
  corner_.assign(clip.vertex_count, kNoCorner);
  of_corner_.resize(clip.polygons.corners.size());
  std::vector<std::vector<uint32_t>> at(clip.vertex_count);  // copies of each vertex
  for (uint32_t c = 0; c < of_corner_.size(); ++c) {
    const uint32_t v = clip.polygons.corners[c];
    auto same = [&](uint32_t copy) {
      const uint32_t d = corner_[copy];
      if (part_of_corner[c] != part_of_corner[d] ||
          (by_normals && clip.shared_normals[c] != clip.shared_normals[d]))
        return false;
      return std::ranges::all_of(of_corners, [&](std::span<const float> values) {
        const size_t n = values.size() / of_corner_.size();
        return std::ranges::equal(values.subspan(n * c, n), values.subspan(n * d, n));
      });
    };
    const auto found = std::ranges::find_if(at[v], same);
    if (found != at[v].end()) {
      of_corner_[c] = *found;
      continue;
    }
    of_corner_[c] = at[v].empty() ? v : static_cast<uint32_t>(source_.size());
    if (!at[v].empty()) {
      source_.push_back(v);
      corner_.push_back(c);
    }
    corner_[of_corner_[c]] = c;
    at[v].push_back(of_corner_[c]);
  }
}

void GlbVertices::sort_by_object(const std::vector<uint32_t>& part_of_corner) {
  std::map<uint32_t, uint32_t> object_of_part;
  std::vector<uint32_t> object_of(source_.size());
  for (size_t v = 0; v < source_.size(); ++v) {
    if (corner_[v] == kNoCorner) {
      object_of[v] = v == 0 ? 0 : object_of[v - 1];
      continue;
    }
    const uint32_t part = part_of_corner[corner_[v]];
    const auto [found, is_new] =
        object_of_part.try_emplace(part, static_cast<uint32_t>(objects_.size()));
    if (is_new)
      objects_.push_back({part, 0, 0});
    object_of[v] = found->second;
  }
  if (objects_.empty())
    objects_.emplace_back();
  std::vector<uint32_t> order(source_.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](uint32_t v) { return object_of[v]; });
  auto in_order = [&order](const std::vector<uint32_t>& values) {
    std::vector<uint32_t> sorted;
    for (uint32_t v : order)
      sorted.push_back(values[v]);
    return sorted;
  };
  source_ = in_order(source_);
  corner_ = in_order(corner_);
  object_of_ = in_order(object_of);
  for (uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    GlbObject& object = objects_[object_of_[i]];
    if (object.count++ == 0)
      object.first = i;
  }
  for (uint32_t& v : of_corner_)
    v = place[v];
}

std::vector<GlbTriangles> GlbVertices::triangles(const MeshSequence& clip,
                                                 std::span<const float> positions) const {
  const std::vector<uint32_t> cut = corner_triangles(clip.polygons, positions);
  size_t next = 0;  // of `cut`
  std::vector<GlbTriangles> groups;
  std::map<std::pair<uint32_t, uint32_t>, size_t> group_of;
  const std::vector<uint32_t>& materials = clip.materials.of_polygon;
  for (size_t p = 0; p < clip.polygons.size(); ++p) {
    if (clip.polygons[p].size() < 3)
      continue;
    const uint32_t* polygon = of_corner_.data() + clip.polygons.offsets[p];
    const uint32_t object = object_of_[polygon[0]];
    const uint32_t material = materials.empty() ? kNoLabel : materials[p];
    const auto [found, is_new] = group_of.try_emplace({object, material}, groups.size());
    if (is_new)
      groups.push_back({object, material, {}});
    std::vector<uint32_t>& corners = groups[found->second].corners;
    const uint32_t first = objects_[object].first;
    for (const size_t end = next + 3 * (clip.polygons[p].size() - 2); next < end; ++next)
      corners.push_back(of_corner_[cut[next]] - first);
  }
  return groups;
}

std::vector<float> GlbVertices::of_vertices(std::span<const float> values,
                                            size_t components) const {
  std::vector<float> out;
  out.reserve(components * source_.size());
  for (uint32_t v : source_)
    out.insert(out.end(), values.begin() + static_cast<ptrdiff_t>(components * v),
               values.begin() + static_cast<ptrdiff_t>(components * (v + size_t{1})));
  return out;
}

std::vector<float> GlbVertices::of_corners(std::span<const float> values, size_t components) const {
  std::vector<float> out;
  out.reserve(components * source_.size());
  for (uint32_t c : corner_) {
    for (size_t i = 0; i < components; ++i)
      out.push_back(c == kNoCorner ? 0 : values[components * c + i]);
  }
  return out;
}

}  // namespace anicodec::tools
