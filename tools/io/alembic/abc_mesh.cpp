// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/alembic/abc_mesh.h"

#include "tools/io/base/mesh.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

const AbcProperty& needed(const AbcArchive& archive, const AbcObject& object,
                          const AbcCompound& compound, std::string_view name) {
  const AbcProperty* property = compound.find(name);
  if (property == nullptr)
    archive.file.fail(object.path, "the mesh has no property " + std::string(name));
  archive.time_of(*property);  // there is one
  return *property;
}

AbcCompound geometry_of(const AbcArchive& archive, const AbcObject& object) {
  const AbcCompound properties = archive.properties(object);
  return archive.properties(needed(archive, object, properties, ".geom"));
}

}  // namespace

std::vector<uint32_t> reversed_corners(const Polygons& polygons) {
  std::vector<uint32_t> order;
  order.reserve(polygons.corners.size());
  for (size_t p = 0; p < polygons.size(); ++p) {
    for (uint32_t c = polygons.offsets[p + 1]; c-- > polygons.offsets[p];)
      order.push_back(c);
  }
  return order;
}

AbcMesh::AbcMesh(const AbcArchive& archive, const AbcObject& object, const AbcNote& note)
    : AbcMesh(archive, object, geometry_of(archive, object), note) {}

AbcMesh::AbcMesh(const AbcArchive& archive, const AbcObject& object, const AbcCompound& geometry,
                 const AbcNote& note)
    : archive_(archive),
      path_(object.path),
      positions_(archive.file, needed(archive, object, geometry, "P")),
      counts_(archive.file, needed(archive, object, geometry, ".faceCounts")),
      indices_(archive.file, needed(archive, object, geometry, ".faceIndices")),
      params_(archive, object, geometry, note) {
  if (positions_.property().extent != 3)
    archive.file.fail(
        positions_.property().place(),
        "has " + std::to_string(positions_.property().extent) + " numbers per point, not 3");
  if (geometry.find(".velocities") != nullptr)
    note(path_ + ": velocities are left out; they follow from the positions");
  if (object.schema == AbcSchema::kSubD)
    note(path_ +
         ": is a subdivision surface, read as its control mesh; creases, corners and holes "
         "are left out");
  find_face_sets(object, note);
}

void AbcMesh::find_face_sets(const AbcObject& object, const AbcNote& note) {
  for (uint32_t child : object.children) {
    const AbcObject& set = archive_.objects[child];
    if (set.schema != AbcSchema::kFaceSet)
      continue;
    const AbcCompound properties = archive_.properties(set);
    const AbcProperty* schema = properties.find(".faceset");
    if (schema == nullptr)
      continue;
    const AbcCompound compound = archive_.properties(*schema);
    const AbcProperty* faces = compound.find(".faces");
    if (faces == nullptr || faces->samples == 0)
      continue;
    archive_.time_of(*faces);
    face_sets_.push_back({set.name, AbcSamples(archive_.file, *faces)});
    if (!faces->is_constant())
      note(path_ + ": face set '" + set.name +
           "' changes, and stays as in the first frame that shows the mesh");
  }
}

AbcTopology AbcMesh::read_topology(uint32_t counts, uint32_t indices, uint32_t vertices) const {
  AbcTopology out;
  out.vertex_count = vertices;
  const std::vector<int32_t> sizes = counts_.integers(counts);
  const std::vector<int32_t> corners = indices_.integers(indices);
  const std::string place = path_ + ", sample " + std::to_string(indices);
  if (corners.size() > kMaxCorners)
    archive_.file.fail(place, "more than 2^32 - 1 face corners");
  uint64_t sum = 0;
  out.polygons.offsets.reserve(sizes.size() + 1);
  for (size_t p = 0; p < sizes.size(); ++p) {
    if (sizes[p] < 0)
      archive_.file.fail(
          place, "face " + std::to_string(p) + " has " + std::to_string(sizes[p]) + " corners");
    sum += static_cast<uint32_t>(sizes[p]);
    if (sum > corners.size())
      archive_.file.fail(place, "the faces have more corners than the " +
                                    std::to_string(corners.size()) + " indices");
    out.polygons.offsets.push_back(static_cast<uint32_t>(sum));
  }
  if (sum != corners.size())
    archive_.file.fail(place, "the faces have " + std::to_string(sum) + " corners, but there are " +
                                  std::to_string(corners.size()) + " indices");
  out.polygons.corners.assign(corners.begin(), corners.end());
  for (size_t c = 0; c < corners.size(); ++c) {
    if (corners[c] < 0 || static_cast<uint32_t>(corners[c]) >= vertices)
      archive_.file.fail(place, "corner " + std::to_string(c) + " of the faces is vertex " +
                                    std::to_string(corners[c]) + " of " + std::to_string(vertices));
  }
  return out;
}

uint32_t AbcMesh::topology_at(double time) {
  const uint32_t counts = archive_.sample_at(counts_, time);
  const uint32_t indices = archive_.sample_at(indices_, time);
  const uint64_t vertices = positions_.size(archive_.sample_at(positions_, time)) / 3;
  if (vertices > kMaxVertices)
    archive_.file.fail(path_, "more than 2^31 - 1 vertices");
  const std::array<uint64_t, 3> key{counts_.block(counts).offset, indices_.block(indices).offset,
                                    vertices};
  const auto known = known_.find(key);
  if (known != known_.end())
    return known->second;
  AbcTopology topology = read_topology(counts, indices, static_cast<uint32_t>(vertices));
  const auto found = std::ranges::find(topologies_, topology);
  const auto number = static_cast<uint32_t>(found - topologies_.begin());
  if (found == topologies_.end())
    topologies_.push_back(std::move(topology));
  known_.emplace(key, number);
  return number;
}

void AbcMesh::read_positions(double time, std::span<float> out) const {
  positions_.read(archive_.sample_at(positions_, time), out);
}

PolygonLabels AbcMesh::face_sets(double time, size_t polygons, const AbcNote& note) const {
  PolygonLabels labels;
  for (const FaceSet& set : face_sets_) {
    if (labels.names.empty())
      labels.of_polygon.assign(polygons, kNoLabel);
    const auto label = static_cast<uint32_t>(labels.names.size());
    std::vector<size_t> taken(labels.names.size());  // faces that each set before has already
    for (int32_t face : set.faces.integers(archive_.sample_at(set.faces, time))) {
      if (face < 0 || static_cast<size_t>(face) >= polygons)
        archive_.file.fail(set.faces.property().place(),
                           "face " + std::to_string(face) + " of " + std::to_string(polygons));
      uint32_t& of_face = labels.of_polygon[static_cast<size_t>(face)];
      if (of_face == kNoLabel)
        of_face = label;
      else if (of_face != label)
        ++taken[of_face];
    }
    for (size_t other = 0; other < taken.size(); ++other) {
      if (taken[other] > 0)
        note(path_ + ": " + std::to_string(taken[other]) + " faces of face set '" + set.name +
             "' are in '" + labels.names[other] + "', too, and stay there alone");
    }
    labels.names.push_back(set.name);
  }
  return labels;
}

std::vector<const AbcProperty*> AbcMesh::timed() const {
  std::vector<const AbcProperty*> out{&positions_.property(), &counts_.property(),
                                      &indices_.property()};
  for (const AbcGeomParam& param : params_.all())
    out.push_back(&param.values.property());
  return out;
}

}  // namespace anicodec::tools
