// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/attribute_record.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

/// False: a field is out of its range.
bool read_looks(ByteReader& r, AttributeHeader* out) {
  const uint8_t looks = r.u8();
  if (!r.ok() || looks > 1)
    return false;
  if (looks == 0)
    return true;
  if (out->labels.empty())
    return false;
  out->looks = Vector<MaterialLook>(out->labels.size());
  return std::all_of(out->looks.begin(), out->looks.end(),
                     [&](MaterialLook& look) { return look.read(r); });
}

void write_heads(const Vector<AttributeHeader>& attributes, ByteWriter& w) {
  for (const AttributeHeader& a : attributes) {
    w.u8(static_cast<uint8_t>(a.kind));
    w.u8(static_cast<uint8_t>(a.domain));
    w.text(a.name);
    if (a.has_labels()) {
      w.varint(a.labels.size());
      for (const String& label : a.labels)
        w.text(label);
      if (a.kind == AttributeKind::kMaterial) {
        w.u8(!a.looks.empty());
        for (const MaterialLook& look : a.looks)
          look.write(w);
      }
      continue;
    }
    w.varint(a.grids.size());
    for (const AttributeHeader::Grid& grid : a.grids) {
      w.f64(grid.origin);
      w.f64(grid.scale);
    }
  }
}

uint64_t numbers_of(const AttributeHeader& a, const Limits::Mesh& mesh) {
  return uint64_t{a.elements(mesh)} * std::max(a.components(), 1U);
}

}  // namespace

void count_attributes(const Vector<AttributeHeader>& attributes, Limits::Mesh* mesh) {
  ByteWriter w;
  write_heads(attributes, w);
  mesh->attributes = static_cast<uint32_t>(attributes.size());
  mesh->attribute_head = static_cast<uint32_t>(w.size());
  mesh->attribute_labels = 0;
  mesh->attribute_numbers = 0;
  for (const AttributeHeader& a : attributes) {
    mesh->attribute_labels += static_cast<uint32_t>(a.labels.size());
    mesh->attribute_numbers += numbers_of(a, *mesh);
  }
}

Bytes AttributeRecord::write() const {
  ByteWriter w;
  write_heads(attributes, w);
  w.raw(stream);
  return std::move(w.bytes());
}

Status AttributeRecord::read(ByteView view, const Limits::Mesh& mesh, AttributeRecord* out) {
  ByteReader r(view);
  uint64_t labels_left = mesh.attribute_labels, numbers = 0;
  out->attributes.assign(mesh.attributes, {});
  for (AttributeHeader& a : out->attributes) {
    const uint8_t kind = r.u8(), domain = r.u8();
    if (kind > static_cast<uint8_t>(AttributeKind::kPart) ||
        domain > static_cast<uint8_t>(AttributeDomain::kPolygon))
      return r.ok() ? Status::kFeature : Status::kRecord;
    a.kind = static_cast<AttributeKind>(kind);
    a.domain = static_cast<AttributeDomain>(domain);
    a.name = r.text();
    if (a.has_labels() && a.domain != AttributeDomain::kPolygon)
      return Status::kRecord;
    if (a.has_labels()) {
      const uint64_t labels = r.varint();
      if (!r.ok() || labels > std::min<uint64_t>(r.remaining(), labels_left))
        return Status::kRecord;
      labels_left -= labels;
      numbers += numbers_of(a, mesh);
      a.labels = Vector<String>(static_cast<size_t>(labels));
      for (String& label : a.labels)
        label = r.text();
      if (a.kind == AttributeKind::kMaterial && !read_looks(r, &a))
        return Status::kRecord;
      continue;
    }
    const uint32_t components = r.varint32(kMaxAttributeComponents);
    if (!r.ok() || (components == 0 && a.domain != AttributeDomain::kCorner))
      return Status::kRecord;
    a.grids = Vector<AttributeHeader::Grid>(components);
    for (AttributeHeader::Grid& grid : a.grids) {
      grid.origin = r.f64();
      grid.scale = r.f64();
      if (r.ok() && !(std::isfinite(grid.origin) && std::isfinite(grid.scale) && grid.scale > 0))
        return Status::kQuantizer;
    }
    numbers += numbers_of(a, mesh);
  }
  const bool announced =
      labels_left == 0 && numbers == mesh.attribute_numbers && r.position() == mesh.attribute_head;
  out->stream = r.raw(r.remaining());
  return r.ok() && announced ? Status::kOk : Status::kRecord;
}

}  // namespace anicodec
