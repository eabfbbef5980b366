// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/scene.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace anicodec {
namespace {

/// The values of some rows; none if there are none at all.
std::vector<uint32_t> taken(const std::vector<uint32_t>& values,
                            const std::vector<uint32_t>& rows) {
  std::vector<uint32_t> out;
  for (uint32_t row : values.empty() ? std::vector<uint32_t>() : rows)
    out.push_back(values[row]);
  return out;
}

/// Adds a name, and its look where that is known.
void append_name(const PolygonLabels& labels, uint32_t label, PolygonLabels& out) {
  out.names.push_back(labels.names[label]);
  if (!labels.looks.empty() || !out.looks.empty()) {
    out.looks.resize(out.names.size());
    if (!labels.looks.empty())
      out.looks.back() = labels.looks[label];
  }
}

/// The labels of some polygons, without names that none of them has.
PolygonLabels taken(const PolygonLabels& labels, const std::vector<uint32_t>& polygons) {
  PolygonLabels out;
  std::map<uint32_t, uint32_t> numbers;
  for (uint32_t label : taken(labels.of_polygon, polygons)) {
    if (label != kNoLabel) {
      const auto [number, is_new] =
          numbers.try_emplace(label, static_cast<uint32_t>(out.names.size()));
      if (is_new)
        append_name(labels, label, out);
      label = number->second;
    }
    out.of_polygon.push_back(label);
  }
  if (out.names.empty())
    out.of_polygon.clear();
  return out;
}

/// The frames in which the vertices are not all at one point; all frames if they always are.
std::vector<FrameRun> frames_shown(const MeshSequence& sequence,
                                   const std::vector<uint32_t>& vertices) {
  std::vector<FrameRun> runs;
  for (uint32_t f = 0; f < sequence.frame_count; ++f) {
    const std::span<const float> frame = sequence.frame(f);
    auto at_first = [&](uint32_t v) {
      return std::equal(&frame[size_t{3} * v], &frame[size_t{3} * v] + 3,
                        &frame[size_t{3} * vertices[0]]);
    };
    if (std::all_of(vertices.begin(), vertices.end(), at_first))
      continue;
    if (runs.empty() || runs.back().first + runs.back().count != f)
      runs.push_back({f, 0});
    ++runs.back().count;
  }
  if (runs.empty())
    runs.push_back({0, sequence.frame_count});
  return runs;
}

/// `number`: room for a number of each vertex of the whole.
SceneMesh taken(const MeshSequence& whole, const PartMembers& members,
                std::vector<uint32_t>& number) {
  SceneMesh mesh;
  MeshSequence& out = mesh.sequence;
  if (members.part != kNoLabel)
    out.mesh_name = whole.parts.names[members.part];
  for (uint32_t v : members.vertices)
    number[v] = out.vertex_count++;
  std::vector<uint32_t> polygon;
  for (uint32_t p : members.polygons) {
    polygon.clear();
    for (uint32_t v : whole.polygons[p])
      polygon.push_back(number[v]);
    out.polygons.add(polygon);
  }
  out.shared_normals = taken(whole.shared_normals, members.corners);
  out.materials = taken(whole.materials, members.polygons);

  mesh.present_in = frames_shown(whole, members.vertices);
  std::vector<uint32_t> frames;
  for (const FrameRun& run : mesh.present_in) {
    frames.resize(frames.size() + run.count);
    std::iota(frames.end() - run.count, frames.end(), run.first);
  }
  out.frame_count = static_cast<uint32_t>(frames.size());
  for (const Attribute& attribute : whole.attributes) {
    Attribute& mesh_attribute =
        out.attributes.emplace_back(Attribute{.kind = attribute.kind,
                                              .name = attribute.name,
                                              .domain = attribute.domain,
                                              .components = attribute.components,
                                              .values = {},
                                              .bound = attribute.bound,
                                              .unit = attribute.unit});
    const std::vector<uint32_t>& rows = attribute.per_corner()   ? members.corners
                                        : attribute.per_vertex() ? members.vertices
                                                                 : members.polygons;
    const size_t elements = element_count(whole, attribute.domain);
    for (uint32_t f : attribute.frames == 1 ? std::vector<uint32_t>{0} : frames) {
      for (uint32_t row : rows) {
        const float* values =
            attribute.values.data() + (f * elements + row) * mesh_attribute.components;
        mesh_attribute.values.insert(mesh_attribute.values.end(), values,
                                     values + mesh_attribute.components);
      }
    }
    if (attribute.frames != 1)
      mesh_attribute.frames = out.frame_count;
  }
  out.positions.reserve(size_t{3} * out.vertex_count * out.frame_count);
  for (uint32_t f : frames) {
    const std::span<const float> frame = whole.frame(f);
    for (uint32_t v : members.vertices)
      out.positions.insert(out.positions.end(), &frame[size_t{3} * v], &frame[size_t{3} * v] + 3);
  }
  return mesh;
}

/// Adds the labels of a mesh to those of the meshes before it, names that are the same once. `numbers`: of
/// the names so far.
void append(const PolygonLabels& labels, size_t polygons, std::map<std::string, uint32_t>& numbers,
            PolygonLabels& out) {
  if (labels.of_polygon.empty()) {
    out.of_polygon.insert(out.of_polygon.end(), polygons, kNoLabel);
    return;
  }
  for (uint32_t label : labels.of_polygon) {
    if (label == kNoLabel) {
      out.of_polygon.push_back(kNoLabel);
      continue;
    }
    const auto [number, is_new] =
        numbers.try_emplace(labels.names[label], static_cast<uint32_t>(out.names.size()));
    out.of_polygon.push_back(number->second);
    if (is_new)
      append_name(labels, label, out);
  }
}

}  // namespace

void set_timing(const MeshSequence& clip, MeshSequence* mesh) {
  mesh->name = clip.name;
  mesh->rate = clip.rate;
  mesh->start_time = clip.start_time;
  mesh->times = clip.times;
  mesh->up = clip.up;
  mesh->metres_per_unit = clip.metres_per_unit;
  mesh->origin = clip.origin;
  mesh->loop = clip.loop;
  mesh->events = clip.events;
  mesh->clips = clip.clips;
}

bool is_closed(const Scene& scene) {
  const uint32_t frames = scene.clip.frame_count;
  return frames > 1 && std::ranges::all_of(scene.meshes, [&](const SceneMesh& mesh) {
           const FrameRun &first = mesh.present_in.front(), &last = mesh.present_in.back();
           const bool begins = first.first == 0, ends = last.first + last.count == frames;
           return begins == ends &&
                  (!begins || is_closed(mesh.sequence, {0, mesh.sequence.frame_count}));
         });
}

Scene scene_of(MeshSequence sequence) {
  Scene scene;
  set_timing(sequence, &scene.clip);
  scene.clip.frame_count = sequence.frame_count;
  const FrameRun all{0, sequence.frame_count};
  scene.meshes.push_back({std::move(sequence), {all}});
  return scene;
}

std::vector<PartMembers> members_of_parts(const MeshSequence& sequence) {
  const Polygons& polygons = sequence.polygons;
  std::map<uint32_t, PartMembers> parts;  // by label
  uint32_t first = 0;
  while (polygons[first].empty())
    ++first;
  uint32_t label = sequence.parts.of_polygon[first];
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    if (!polygons[p].empty())
      label = sequence.parts.of_polygon[p];
    PartMembers& part = parts[label];
    part.part = label;
    part.polygons.push_back(p);
    for (uint32_t c = polygons.offsets[p]; c < polygons.offsets[p + 1]; ++c) {
      part.corners.push_back(c);
      part.vertices.push_back(polygons.corners[c]);
    }
  }
  std::vector<PartMembers> members;
  for (auto& [unused, part] : parts) {
    std::sort(part.vertices.begin(), part.vertices.end());
    part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()),
                        part.vertices.end());
    members.push_back(std::move(part));
  }
  std::stable_sort(members.begin(), members.end(), [](const PartMembers& a, const PartMembers& b) {
    return a.vertices[0] < b.vertices[0];
  });
  // Vertices without polygon.
  std::vector<uint32_t> owner(sequence.vertex_count, UINT32_MAX);
  for (uint32_t m = 0; m < members.size(); ++m) {
    for (uint32_t v : members[m].vertices)
      owner[v] = m;
  }
  uint32_t last_owner = 0;
  for (uint32_t v = 0; v < sequence.vertex_count; ++v) {
    if (owner[v] == UINT32_MAX)
      members[last_owner].vertices.push_back(v);
    else
      last_owner = owner[v];
  }
  for (PartMembers& m : members)
    std::sort(m.vertices.begin(), m.vertices.end());
  return members;
}

Scene split_parts(MeshSequence sequence) {
  check(sequence);
  Scene scene;
  MeshSequence& clip = scene.clip;
  clip.name = sequence.name;
  clip.frame_count = sequence.frame_count;
  clip.rate = sequence.rate;
  clip.start_time = sequence.start_time;
  clip.times = std::exchange(sequence.times, {});
  clip.clips = std::exchange(sequence.clips, {});
  clip.up = sequence.up;
  clip.metres_per_unit = sequence.metres_per_unit;
  clip.origin = sequence.origin;
  clip.loop = sequence.loop;
  if (sequence.parts.of_polygon.empty() || sequence.polygons.corners.empty()) {
    scene.meshes.push_back({std::move(sequence), {{0, clip.frame_count}}});
    return scene;
  }
  std::vector<uint32_t> number(sequence.vertex_count);
  for (const PartMembers& members : members_of_parts(sequence))
    scene.meshes.push_back(taken(sequence, members, number));
  return scene;
}

MeshSequence merge_meshes(std::span<const MeshSequence> meshes) {
  MeshSequence out;
  std::map<std::string, uint32_t> part_numbers, material_numbers;
  bool knows_hard_edges = false, has_materials = false;
  for (const MeshSequence& mesh : meshes) {
    knows_hard_edges |= !mesh.shared_normals.empty();
    has_materials |= !mesh.materials.of_polygon.empty();
  }
  for (const MeshSequence& mesh : meshes) {
    const size_t first_corner = out.polygons.corners.size(), first_polygon = out.polygons.size();
    for (size_t p = 0; p < mesh.polygons.size(); ++p)
      out.polygons.add(mesh.polygons[p]);
    for (size_t c = first_corner; c < out.polygons.corners.size(); ++c)
      out.polygons.corners[c] += out.vertex_count;
    const PolygonLabels name{{mesh.mesh_name}, std::vector<uint32_t>(mesh.polygons.size(), 0)};
    append(mesh.mesh_name.empty() ? mesh.parts : name, mesh.polygons.size(), part_numbers,
           out.parts);
    if (has_materials)
      append(mesh.materials, mesh.polygons.size(), material_numbers, out.materials);
    if (knows_hard_edges) {
      out.shared_normals.insert(out.shared_normals.end(), mesh.shared_normals.begin(),
                                mesh.shared_normals.end());
      out.shared_normals.resize(out.polygons.corners.size());
    }
    for (const Attribute& attribute : mesh.attributes) {
      auto found = std::find_if(out.attributes.begin(), out.attributes.end(), [&](const auto& a) {
        return a.kind == attribute.kind && a.name == attribute.name && a.domain == attribute.domain;
      });
      if (found == out.attributes.end()) {
        found = out.attributes.insert(found, attribute);
        found->values.clear();
        found->frames = 1;
      }
      Attribute& all = *found;
      if (attribute.components != all.components || attribute.frames != 1)
        continue;
      const size_t before = attribute.per_corner()   ? first_corner
                            : attribute.per_vertex() ? out.vertex_count
                                                     : first_polygon;
      all.values.resize(before * all.components, all.kind == AttributeKind::kColour ? 1.0F : 0.0F);
      all.values.insert(all.values.end(), attribute.values.begin(), attribute.values.end());
    }
    out.vertex_count += mesh.vertex_count;
  }
  for (Attribute& attribute : out.attributes) {
    const size_t elements = element_count(out, attribute.domain);
    attribute.values.resize(elements * attribute.components,
                            attribute.kind == AttributeKind::kColour ? 1.0F : 0.0F);
  }
  if (out.parts.names.empty())
    out.parts.of_polygon.clear();
  return out;
}

}  // namespace anicodec
