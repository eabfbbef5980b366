// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/listing/listing.h"

#include "format/container.h"
#include "format/records.h"
#include "tools/words/names.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

constexpr const char* kUnread = "(not understood)";

/// Names the bits that are set.
template <size_t kCount>
void explain_flags(FieldReader& r, uint8_t flags, const char* const (&names)[kCount]) {
  std::string meaning;
  for (size_t i = 0; i < kCount; ++i) {
    if (flags >> i & 1)
      meaning += (meaning.empty() ? "" : ", ") + std::string(names[i]);
  }
  if (!meaning.empty())
    r.explain(meaning);
}

/// Optional fields at the end of a record.
void list_optional_fields(FieldReader& r) {
  while (r.ok() && r.remaining() > 0) {
    const uint64_t tag = r.varint("field");
    r.block(fmt::format("field {}", tag));
  }
}

void list_limits(FieldReader& r) {
  uint64_t clips = r.varint("clips");
  uint64_t meshes = r.varint("meshes");
  uint64_t segments = r.varint("segments");
  for (uint64_t i = 0; i < clips && r.ok(); ++i)
    r.varint(fmt::format("clip {} frames", i));
  for (uint64_t i = 0; i < meshes && r.ok(); ++i) {
    for (const char* name :
         {"source vertices", "coded vertices", "triangles", "polygons", "corners"})
      r.varint(fmt::format("mesh {} {}", i, name));
    if (r.varint(fmt::format("mesh {} attributes", i)) == 0)
      continue;
    for (const char* name : {"labels", "bytes before the values", "numbers"})
      r.varint(fmt::format("mesh {} {}", i, name));
  }
  for (uint64_t i = 0; i < segments && r.ok(); ++i) {
    r.varint(fmt::format("segment {} mesh", i));
    r.explain(name_of(static_cast<BasisKind>(r.u8(fmt::format("segment {} basis", i)))));
    r.explain(
        name_of(static_cast<Reconstruction>(r.u8(fmt::format("segment {} reconstruction", i)))));
    constexpr uint8_t kRegions = 2, kOfAttribute = 4, kDraco = 8;
    constexpr const char* kFlags[] = {"exact", "regions", "of an attribute", "Draco", "learns"};
    const uint8_t flags = r.u8(fmt::format("segment {} flags", i));
    explain_flags(r, flags, kFlags);
    for (const char* name :
         {"first frame", "frames", "components", "wide components", "corrections"})
      r.varint(fmt::format("segment {} {}", i, name));
    if (flags & kRegions)
      r.varint(fmt::format("segment {} regions", i));
    if (flags & kOfAttribute) {
      r.varint(fmt::format("segment {} attribute", i));
      r.varint(fmt::format("segment {} three components", i));
      r.explain(name_of(static_cast<AttributeDomain>(r.u8(fmt::format("segment {} domain", i)))));
      r.varint(fmt::format("segment {} entries", i));
    }
    if (flags & kDraco) {
      r.varint(fmt::format("segment {} Draco bytes", i));
      r.varint(fmt::format("segment {} Draco points", i));
    }
  }
  r.varint("frames with root motion");
  list_optional_fields(r);
}

void list_clip(FieldReader& r, const std::string& clip, uint32_t frames) {
  constexpr uint8_t kMassaged = 8, kTimes = 16, kAttributeErrors = 32, kEvents = 64;
  r.text(clip + "name");
  r.varint(clip + "rate numerator");
  r.varint(clip + "rate denominator");
  uint8_t flags = r.u8(clip + "flags");
  constexpr const char* kFlags[] = {"rate assumed",     "loop",  "closed", "massaged", "times",
                                    "attribute errors", "events"};
  explain_flags(r, flags, kFlags);
  r.f64(clip + "start time");
  for (uint32_t f = 0; (flags & kTimes) && f < frames && r.ok(); ++f)
    r.f64(fmt::format("{}time of frame {}", clip, f));
  r.explain(name_of(static_cast<ErrorMetric>(r.u8(clip + "asked"))));
  for (const char* name :
       {"asked value", "max error", "RMSE", "KG", "max displacement error", "diagonal"})
    r.f64(clip + name);
  if (flags & kMassaged) {
    r.f64(clip + "surface error");
    r.f64(clip + "surface error, mean");
  }
  const uint64_t errors =
      flags & kAttributeErrors ? r.varint(clip + "attributes with an error") : 0;
  for (uint64_t i = 0; i < errors && r.ok(); ++i) {
    r.varint(fmt::format("{}error {} mesh", clip, i));
    r.varint(fmt::format("{}error {} attribute", clip, i));
    r.f64(fmt::format("{}error {} max error", clip, i));
    r.f64(fmt::format("{}error {} RMSE", clip, i));
  }
  const uint64_t events = flags & kEvents ? r.varint(clip + "events") : 0;
  for (uint64_t i = 0; i < events && r.ok(); ++i) {
    r.text(fmt::format("{}event {} name", clip, i));
    r.f64(fmt::format("{}event {} time", clip, i));
  }
}

/// `frames` of each clip: they are in another chunk.
void list_clips(FieldReader& r, const std::vector<uint32_t>& frames) {
  r.text("encoder");
  r.explain(up_name(r.u8("up axis")));
  r.explain(name_of(static_cast<OrderMode>(r.u8("order"))));
  r.f32("metres per unit");
  for (size_t c = 0; c < frames.size() && r.ok(); ++c)
    list_clip(r, frames.size() > 1 ? fmt::format("clip {} ", c) : "", frames[c]);
  list_optional_fields(r);
}

void list_root(FieldReader& r, size_t clips) {
  for (size_t c = 0; c < clips && r.ok(); ++c) {
    const std::string clip = clips > 1 ? fmt::format("clip {} ", c) : "";
    const uint8_t holds = r.u8(clip + "holds");
    r.explain(holds == 0   ? "nothing"
              : holds == 1 ? "moves"
              : holds == 2 ? "turns"
                           : "moves, turns");
    if (holds == 0)
      continue;
    r.f64(clip + "pivot a");
    r.f64(clip + "pivot b");
    if (holds & 1)
      r.f64(clip + "step");
    if (holds & 2)
      r.f64(clip + "turn step");
  }
  r.bytes("motion", r.remaining());
}

void list_mesh(FieldReader& r) {
  r.text("name");
  r.bytes("faces", r.remaining());
}

void list_pose(FieldReader& r) {
  for (const char* name : {"origin x", "origin y", "origin z", "step"})
    r.f64(name);
  r.bytes("coordinates", r.remaining());
}

void list_exact(FieldReader& r) {
  const uint8_t lattices = r.u8("lattices of axes");
  r.hex64("hash of the positions");
  r.f64("variance of errors");
  for (int axis = 0; axis < 3; ++axis) {
    if (!(lattices >> axis & 1))
      continue;
    const std::string name = fmt::format("lattice {} ", "xyz"[axis]);
    r.f64(name + "origin");
    r.f64(name + "step");
    r.u32(name + "first point");
    r.varint(name + "points");
  }
  r.bytes("positions", r.remaining());
}

void list_bounds(FieldReader& r) {
  r.varint("frames of a box");
  for (const char* name : {"low x", "low y", "low z", "high x", "high y", "high z"})
    r.f32(name);
  r.bytes("boxes", r.remaining());
}

void list_layer(FieldReader& r) {
  r.varint("components");
  const uint64_t weights = r.varint("weight bytes");
  r.bytes("weights", weights);
  r.bytes("coefficients", r.remaining());
}

void list_segment(FieldReader& r) {
  r.hex64("hash of the integers");
  for (const char* name : {"parameters", "pose", "motion", "weights"})
    r.block(name);
  list_optional_fields(r);
}

void list_look(const std::string& name, FieldReader& r) {
  const uint8_t flags = r.u8(name + " flags");
  if (!(flags & 1))
    return r.explain("unknown");
  constexpr uint8_t kMask = static_cast<uint8_t>(AlphaMode::kMask);
  for (const char* field : {"red", "green", "blue", "alpha", "metallic", "roughness",
                            "emissive red", "emissive green", "emissive blue"})
    r.f32(name + " " + field);
  if ((flags >> 2 & 3) == kMask)
    r.f32(name + " alpha cutoff");
  const uint8_t textures = r.u8(name + " textures");
  for (size_t i = 0; i < kTextureSlots; ++i) {
    if (textures >> i & 1)
      r.text(fmt::format("{} {}", name, kTextures[i].text));
  }
}

/// `count`: of attributes, which another chunk tells.
void list_attributes(FieldReader& r, uint32_t count) {
  for (uint32_t i = 0; i < count && r.ok(); ++i) {
    auto name = [i](std::string_view field) { return fmt::format("attribute {} {}", i, field); };
    const auto kind = static_cast<AttributeKind>(r.u8(name("kind")));
    r.explain(name_of(kind));
    const auto domain = static_cast<AttributeDomain>(r.u8(name("domain")));
    r.explain(name_of(domain));
    r.text(name("name"));
    const bool has_labels = kind >= AttributeKind::kMaterial;
    const uint64_t entries = r.varint(name(has_labels ? "labels" : "components"));
    for (uint64_t k = 0; k < entries && r.ok(); ++k) {
      if (has_labels) {
        r.text(name(fmt::format("label {}", k)));
      } else {
        r.f64(name(fmt::format("origin {}", k)));
        r.f64(name(fmt::format("scale {}", k)));
      }
    }
    if (kind == AttributeKind::kMaterial && r.u8(name("looks")) == 1) {
      for (uint64_t k = 0; k < entries && r.ok(); ++k)
        list_look(fmt::format("look {}", k), r);
    }
  }
  r.bytes("values", r.remaining());
}

void list_payload(const Chunk& chunk, ByteView payload, const std::vector<uint32_t>& frames,
                  uint32_t attributes, std::vector<ListedField>& out) {
  FieldReader r(payload, chunk.offset, out);
  if (chunk.type == chunk_type("LIMI"))
    list_limits(r);
  else if (chunk.type == chunk_type("CLIP"))
    list_clips(r, frames);
  else if (chunk.type == chunk_type("DIFF"))
    list_exact(r);
  else if (chunk.type == chunk_type("META"))
    return r.rest("JSON");
  else if (chunk.type == chunk_type("BNDS"))
    list_bounds(r);
  else if (chunk.type == chunk_type("ROOT"))
    list_root(r, frames.size());
  else if (chunk.type == chunk_type("MESH"))
    list_mesh(r);
  else if (chunk.type == chunk_type("POSE"))
    list_pose(r);
  else if (chunk.type == chunk_type("SEGM"))
    list_segment(r);
  else if (chunk.type == chunk_type("BASI"))
    list_layer(r);
  else if (chunk.type == chunk_type("ATTR"))
    list_attributes(r, attributes);
  else
    return r.rest("data");
  r.rest(kUnread);
}

/// Header and table; the chunks as the table has them.
std::vector<Chunk> list_table(ByteView file, std::vector<ListedField>& out) {
  FieldReader r(file, 0, out);
  r.hex("magic", sizeof kMagic);
  r.u16("major version");
  r.u16("minor version");
  uint32_t count = r.u32("chunks");
  const uint64_t features = r.hex64("required features");
  r.explain(feature_names(features));
  r.u64("file size");
  r.hex32("header checksum");
  r.u32("table bytes");
  std::vector<Chunk> chunks;
  for (uint32_t i = 0; i < count && r.ok(); ++i) {
    Chunk chunk;
    chunk.type = r.hex32(fmt::format("chunk {} type", i));
    r.explain(chunk_name(chunk.type));
    chunk.checksum = r.hex32(fmt::format("chunk {} checksum", i));
    const uint8_t flags = r.u8(fmt::format("chunk {} flags", i));
    r.explain(flags & 1 ? "required" : flags & 8 ? "optional, copied" : "optional");
    if (flags & 2)
      chunk.mesh = static_cast<uint16_t>(r.varint(fmt::format("chunk {} mesh", i)));
    if (flags & 4)
      chunk.segment = static_cast<uint32_t>(r.varint(fmt::format("chunk {} segment", i)));
    chunk.size = r.varint(fmt::format("chunk {} size", i));
    if (r.ok())
      chunks.push_back(chunk);
  }
  uint64_t at = out.back().offset + out.back().size;
  for (Chunk& chunk : chunks) {
    chunk.offset = at;
    at += std::min(chunk.size, UINT64_MAX - at);
  }
  return chunks;
}

/// Frames of each clip; a damaged table of limits ends early.
std::vector<uint32_t> clip_frames(ByteView file, const std::vector<Chunk>& chunks) {
  std::vector<uint32_t> frames;
  for (const Chunk& chunk : chunks) {
    if (chunk.type == chunk_type("LIMI") && chunk.offset <= file.size &&
        chunk.size <= file.size - chunk.offset) {
      ByteReader r({file.data + chunk.offset, static_cast<size_t>(chunk.size)});
      const uint32_t clips = r.varint32();
      r.varint32();
      r.varint32();
      for (uint32_t c = 0; c < clips && r.ok() && r.remaining() > 0; ++c)
        frames.push_back(r.varint32());
      break;
    }
  }
  return frames;
}

/// Attributes of each mesh; none where the limits cannot be read.
std::vector<uint32_t> attribute_counts(ByteView file, const std::vector<Chunk>& chunks) {
  std::vector<uint32_t> counts;
  Limits limits;
  for (const Chunk& chunk : chunks) {
    if (chunk.type == chunk_type("LIMI") && chunk.offset <= file.size &&
        chunk.size <= file.size - chunk.offset &&
        Limits::read({file.data + chunk.offset, static_cast<size_t>(chunk.size)}, &limits) ==
            Status::kOk) {
      for (const Limits::Mesh& mesh : limits.meshes)
        counts.push_back(mesh.attributes);
      break;
    }
  }
  return counts;
}

}  // namespace

std::vector<ListedField> list_fields(ByteView file) {
  std::vector<ListedField> out;
  std::vector<Chunk> chunks = list_table(file, out);
  const std::vector<uint32_t> frames = clip_frames(file, chunks);
  const std::vector<uint32_t> attributes = attribute_counts(file, chunks);
  uint64_t at = out.back().offset + out.back().size;
  auto gap_to = [&](uint64_t end, const char* name) {
    if (end > at)
      out.push_back({at, end - at, name, fmt::format("{} bytes", end - at)});
    at = std::max(at, end);
  };
  for (const Chunk& chunk : chunks) {
    if (chunk.offset < at || chunk.offset > file.size || chunk.size > file.size - chunk.offset)
      break;
    size_t begin = out.size();
    const ByteView payload{file.data + chunk.offset, static_cast<size_t>(chunk.size)};
    list_payload(chunk, payload, frames,
                 chunk.mesh < attributes.size() ? attributes[chunk.mesh] : 0, out);
    for (size_t i = begin; i < out.size(); ++i)
      out[i].name = chunk_name(chunk.type) + " " + out[i].name;
    at = chunk.offset + chunk.size;
  }
  gap_to(file.size, kUnread);
  return out;
}

}  // namespace anicodec::tools
