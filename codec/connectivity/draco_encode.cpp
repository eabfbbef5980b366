// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/draco_encode.h"

#include "sdk/mesh/draco_mesh.h"

#include <algorithm>
#include <numeric>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

namespace anicodec {
namespace {

constexpr size_t kMaxAttributes = 64;

void set_connectivity(draco::Mesh& mesh, uint32_t points, std::span<const uint32_t> triangles) {
  mesh.set_num_points(points);
  mesh.SetNumFaces(triangles.size() / 3);
  for (uint32_t t = 0; t < triangles.size() / 3; ++t) {
    draco::Mesh::Face face;
    for (size_t i = 0; i < 3; ++i)
      face[i] = draco::PointIndex(triangles[size_t{3} * t + i]);
    mesh.SetFace(draco::FaceIndex(t), face);
  }
}

/// Adds one int32 attribute whose value of point p is written by fill(p, values).
template <class Fill>
void add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, size_t components,
                   Fill fill) {
  draco::GeometryAttribute description;
  description.Init(type, nullptr, static_cast<uint8_t>(components), draco::DT_INT32, false,
                   static_cast<int64_t>(components * sizeof(int32_t)), 0);
  int id = mesh.AddAttribute(description, true, mesh.num_points());
  Vector<int32_t> values(components);
  for (uint32_t p = 0; p < mesh.num_points(); ++p) {
    fill(p, values.data());
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(p), values.data());
  }
}

Bytes encode(const draco::Mesh& mesh) {
  draco::ExpertEncoder encoder(mesh);
  encoder.SetSpeedOptions(0, 0);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok())
    return {};
  return {buffer.data(), buffer.data() + buffer.size()};
}

/// Draco numbers points by the connectivity, and differently when POSITION is the only attribute:
/// so there is always another one.
void add_stand_in(draco::Mesh& mesh) {
  add_attribute(mesh, draco::GeometryAttribute::GENERIC, 1, [](uint32_t, int32_t* x) { *x = 0; });
}

/// Encodes the points' numbers to see where they go.
std::vector<uint32_t> decoding_order(uint32_t points, std::span<const uint32_t> triangles) {
  draco::Mesh mesh;
  set_connectivity(mesh, points, triangles);
  add_attribute(mesh, draco::GeometryAttribute::POSITION, 3, [](uint32_t p, int32_t* x) {
    x[0] = static_cast<int32_t>(p);
    x[1] = x[2] = 0;
  });
  add_stand_in(mesh);
  Bytes bytes = encode(mesh);
  DracoMesh decoded;
  if (bytes.empty() || decode_draco_mesh(bytes, points, static_cast<uint32_t>(triangles.size() / 3),
                                         draco_components(1), &decoded) != Status::kOk)
    return {};
  std::vector<uint32_t> order(points);
  std::vector<bool> seen(points, false);
  for (uint32_t d = 0; d < points; ++d) {
    auto p = static_cast<uint32_t>(decoded.values[size_t{decoded.components} * d]);
    if (p >= points || seen[p])
      return {};
    seen[p] = true;
    order[d] = p;
  }
  return order;
}

}  // namespace

Bytes encode_draco_mesh(uint32_t points, std::span<const uint32_t> triangles,
                        std::span<const Vector<int32_t>> poses, std::span<const uint32_t> rows,
                        std::vector<uint32_t>* points_by_decoded) {
  if (triangles.empty() || poses.size() > kMaxDracoPoses)
    return {};
  if (points_by_decoded) {
    *points_by_decoded = decoding_order(points, triangles);
    if (points_by_decoded->empty())
      return {};
  }
  draco::Mesh mesh;
  set_connectivity(mesh, points, triangles);
  add_attribute(mesh, draco::GeometryAttribute::POSITION, 3, [&](uint32_t p, int32_t* x) {
    for (size_t i = 0; i < 3; ++i)
      x[i] = poses.empty() ? 0 : poses[0][size_t{3} * rows[p] + i];
  });
  size_t later_poses = poses.empty() ? 0 : poses.size() - 1;
  size_t group = (later_poses + kMaxAttributes - 2) / (kMaxAttributes - 1);  // poses per attribute
  for (size_t first = 1; first < poses.size(); first += group) {
    size_t count = std::min(group, poses.size() - first);
    add_attribute(mesh, draco::GeometryAttribute::GENERIC, 3 * count, [&](uint32_t p, int32_t* x) {
      for (size_t i = 0; i < 3 * count; ++i)
        x[i] = poses[first + i / 3][size_t{3} * rows[p] + i % 3];
    });
  }
  if (later_poses == 0)
    add_stand_in(mesh);
  return encode(mesh);
}

}  // namespace anicodec
