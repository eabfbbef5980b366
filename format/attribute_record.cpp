// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/attribute_record.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr uint64_t kTextBytes = 64, kLookBytes = 384;

/// False: a field is out of its range, or there are more looks than memory.
bool read_looks(ByteReader& r, uint64_t most_bytes, AttributeHeader* out) {
  const uint8_t looks = r.u8();
  if (!r.ok() || looks > 1)
    return false;
  if (looks == 0)
    return true;
  if (out->labels.empty() || out->labels.size() > most_bytes / kLookBytes)
    return false;
  out->looks = Vector<MaterialLook>(out->labels.size());
  return std::all_of(out->looks.begin(), out->looks.end(),
                     [&](MaterialLook& look) { return look.read(r); });
}

}  // namespace

uint32_t AttributeHeader::elements(const Limits::Mesh& mesh) const {
  switch (domain) {
    case AttributeDomain::kVertex:
      return mesh.source_vertices;
    case AttributeDomain::kCorner:
      return mesh.corners;
    case AttributeDomain::kPolygon:
      break;
  }
  return mesh.polygons;
}

uint64_t attribute_bytes(const Vector<AttributeHeader>& attributes, const Limits::Mesh& mesh) {
  uint64_t bytes = 0;
  for (const AttributeHeader& a : attributes) {
    bytes += uint64_t{4} * a.elements(mesh) * std::max(a.components(), 1U);
    bytes += kTextBytes + a.name.size();
    for (const String& label : a.labels)
      bytes += kTextBytes + label.size();
    for (const MaterialLook& look : a.looks) {
      bytes += kLookBytes;
      for (const String& texture : look.textures)
        bytes += texture.size();
    }
  }
  return bytes;
}

Bytes AttributeRecord::write() const {
  ByteWriter w;
  w.varint(attributes.size());
  for (const AttributeHeader& a : attributes) {
    w.u8(static_cast<uint8_t>(a.kind));
    w.u8(static_cast<uint8_t>(a.domain));
    w.text(a.name);
    if (a.domain == AttributeDomain::kPolygon) {
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
  w.raw(stream);
  return std::move(w.bytes());
}

Status AttributeRecord::read(ByteView view, uint64_t most_bytes, AttributeRecord* out) {
  ByteReader r(view);
  const uint32_t count = r.varint32(kMaxAttributes);
  if (!r.ok() || count == 0)
    return Status::kRecord;
  out->attributes.assign(count, {});
  for (AttributeHeader& a : out->attributes) {
    const uint8_t kind = r.u8(), domain = r.u8();
    if (kind > static_cast<uint8_t>(AttributeKind::kPart) ||
        domain > static_cast<uint8_t>(AttributeDomain::kPolygon))
      return r.ok() ? Status::kFeature : Status::kRecord;
    a.kind = static_cast<AttributeKind>(kind);
    a.domain = static_cast<AttributeDomain>(domain);
    a.name = r.text();
    if ((a.kind >= AttributeKind::kMaterial) != (a.domain == AttributeDomain::kPolygon))
      return Status::kRecord;
    if (a.domain == AttributeDomain::kPolygon) {
      const uint64_t labels = r.varint();
      if (!r.ok() || labels > std::min<uint64_t>(r.remaining(), most_bytes / kTextBytes))
        return Status::kRecord;
      a.labels = Vector<String>(static_cast<size_t>(labels));
      for (String& label : a.labels)
        label = r.text();
      if (a.kind == AttributeKind::kMaterial && !read_looks(r, most_bytes, &a))
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
  }
  out->stream = r.raw(r.remaining());
  return r.ok() ? Status::kOk : Status::kRecord;
}

}  // namespace anicodec
