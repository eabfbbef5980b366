// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/draco_mesh.h"

#include <algorithm>
#include <memory>
#include <new>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wundef"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#pragma GCC diagnostic pop

namespace anicodec {
namespace {

/// Attributes hold poses of three components each; there may be a stand-in.
int most_attributes(uint32_t components) {
  return static_cast<int>(std::clamp(components / 3, 2U, 64U));
}

/// Whether the counts at the head of a bitstream are those of the limits. Draco sizes its tables by
/// them before it reads any more.
bool is_plausible(format::ByteView bytes, uint32_t points, uint32_t triangles,
                  uint32_t components) {
  constexpr uint8_t kHead[] = {
      'D', 'R', 'A', 'C', 'O', 2, 2, draco::TRIANGULAR_MESH, draco::MESH_EDGEBREAKER_ENCODING};
  format::ByteReader r(bytes);
  format::ByteView head = r.raw(sizeof kHead);
  if (head.size != sizeof kHead || !std::equal(kHead, kHead + sizeof kHead, head.data))
    return false;
  const uint16_t flags = r.u16();
  const uint8_t traversal = r.u8();
  const uint64_t vertices = r.varint(), faces = r.varint();
  const uint8_t attribute_data = r.u8();
  const uint64_t symbols = r.varint(), split_symbols = r.varint();
  return r.ok() && flags == 0 &&
         (traversal == draco::MESH_EDGEBREAKER_STANDARD_ENCODING ||
          traversal == draco::MESH_EDGEBREAKER_VALENCE_ENCODING) &&
         vertices <= points && faces == triangles && attribute_data < most_attributes(components) &&
         symbols <= faces && split_symbols <= symbols;
}

/// Draco's decoder, which looks at what the attributes announce before it makes room for them.
class BoundedDecoder : public draco::MeshEdgebreakerDecoder {
 public:
  BoundedDecoder(uint32_t points, uint32_t triangles, uint32_t components)
      : points_(points), triangles_(triangles), components_(components) {}

 protected:
  bool DecodeAllAttributes() override {
    const draco::Mesh& mesh = *this->mesh();
    if (mesh.num_points() != points_ || mesh.num_faces() != triangles_ ||
        mesh.num_attributes() > most_attributes(components_))
      return false;
    uint32_t total = 0;
    for (int a = 0; a < mesh.num_attributes(); ++a)
      total += static_cast<uint32_t>(mesh.attribute(a)->num_components());
    return total == components_ && draco::MeshEdgebreakerDecoder::DecodeAllAttributes();
  }

 private:
  uint32_t points_, triangles_, components_;
};

Status decode(format::ByteView bytes, uint32_t points, uint32_t triangles, uint32_t components,
              DracoMesh* out) {
  if (!is_plausible(bytes, points, triangles, components))
    return Status::kDraco;
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data), bytes.size);
  BoundedDecoder decoder(points, triangles, components);
  auto mesh = std::make_unique<draco::Mesh>();
  const draco::DecoderOptions options;
  if (!decoder.Decode(options, &buffer, mesh.get()).ok() || buffer.remaining_size() != 0)
    return Status::kDraco;
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
