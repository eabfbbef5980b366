// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/draco_mesh.h"

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wundef"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace anicodec {
namespace {

Status decode(format::ByteView bytes, uint32_t points, uint32_t triangles, uint32_t components,
              DracoMesh* out) {
  // Draco sizes its tables by the counts the stream announces: they follow the header (11 bytes)
  // and the edgebreaker method, and must not exceed what the limits promised.
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data), bytes.size);
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok() || buffer.remaining_size() != 0)
    return Status::kDraco;
  std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
  if (mesh->num_points() != points || mesh->num_faces() != triangles)
    return Status::kDraco;
  uint32_t total = 0;
  for (int a = 0; a < mesh->num_attributes(); ++a) {
    const draco::PointAttribute* attribute = mesh->attribute(a);
    bool position = a == 0;
    if (attribute->data_type() != draco::DT_INT32 ||
        attribute->attribute_type() !=
            (position ? draco::GeometryAttribute::POSITION : draco::GeometryAttribute::GENERIC) ||
        (position && attribute->num_components() != 3) || attribute->num_components() <= 0)
      return Status::kDraco;
    total += static_cast<uint32_t>(attribute->num_components());
  }
  if (total != components)
    return Status::kDraco;

  out->points = points;
  out->components = components;
  out->triangles.resize(size_t{triangles} * 3);
  for (uint32_t t = 0; t < triangles; ++t) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(t));
    for (size_t i = 0; i < 3; ++i) {
      uint32_t p = face[i].value();
      if (p >= points)
        return Status::kDraco;
      out->triangles[size_t{3} * t + i] = p;
    }
  }
  out->values.resize(size_t{points} * components);
  size_t column = 0;
  for (int a = 0; a < mesh->num_attributes(); ++a) {
    const draco::PointAttribute* attribute = mesh->attribute(a);
    auto width = static_cast<size_t>(attribute->num_components());
    for (uint32_t p = 0; p < points; ++p) {
      draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(p));
      if (index.value() >= attribute->size())
        return Status::kDraco;
      attribute->GetValue(index, out->values.data() + size_t{p} * components + column);
    }
    column += width;
  }
  return Status::kOk;
}

}  // namespace

Status decode_draco_mesh(format::ByteView bytes, uint32_t points, uint32_t triangles,
                         uint32_t components, DracoMesh* out) {
  try {
    return decode(bytes, points, triangles, components, out);
  } catch (const std::bad_alloc&) {
    return Status::kMemory;
  } catch (...) {
    return Status::kDraco;
  }
}

}  // namespace anicodec
