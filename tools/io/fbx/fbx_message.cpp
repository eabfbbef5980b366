// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/fbx/fbx_message.h"

#include "format/bytes.h"
#include "tools/io/guard/guard_message.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace anicodec::tools {
namespace {

constexpr char kClip = 'C', kNote = 'N';

void append_labels(const PolygonLabels& labels, std::string& out) {
  append_one(uint64_t{labels.names.size()}, out);
  for (const std::string& name : labels.names)
    append_values(name, out);
  append_values(labels.of_polygon, out);
  append_one(uint64_t{labels.looks.size()}, out);
  for (const MaterialLook& look : labels.looks) {
    ByteWriter writer;
    look.write(writer);
    append_values(writer.bytes(), out);
  }
}

void read_labels(GuardMessage& in, PolygonLabels& out) {
  for (auto count = in.one<uint64_t>(); count > 0; --count)
    out.names.emplace_back(in.text());
  in.values(out.of_polygon);
  for (auto count = in.one<uint64_t>(); count > 0; --count) {
    const std::string_view bytes = in.text();
    ByteReader reader({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
    if (!out.looks.emplace_back().read(reader))
      in.fail();
  }
}

MeshSequence read_clip(GuardMessage& in) {
  MeshSequence clip;
  clip.name = in.text();
  clip.vertex_count = in.one<uint32_t>();
  in.values(clip.polygons.offsets);
  in.values(clip.polygons.corners);
  for (auto count = in.one<uint64_t>(); count > 0; --count) {
    Attribute& attribute = clip.attributes.emplace_back();
    attribute.kind = in.one<AttributeKind>();
    attribute.name = in.text();
    attribute.domain = in.one<AttributeDomain>();
    if (attribute.kind > AttributeKind::kPart || attribute.domain > AttributeDomain::kPolygon)
      in.fail();
    attribute.components = in.one<uint32_t>();
    in.values(attribute.values);
  }
  read_labels(in, clip.materials);
  read_labels(in, clip.parts);
  clip.rate.numerator = in.one<uint32_t>();
  clip.rate.denominator = in.one<uint32_t>();
  clip.rate.assumed = in.one<uint8_t>() != 0;
  clip.start_time = in.one<double>();
  clip.up = static_cast<UpAxis>(std::min<uint8_t>(in.one<uint8_t>(), 2));
  clip.metres_per_unit = in.one<double>();
  in.values(clip.positions);
  if (clip.vertex_count == 0 || clip.positions.size() % (size_t{3} * clip.vertex_count) != 0)
    in.fail();
  clip.frame_count = static_cast<uint32_t>(clip.positions.size() / (size_t{3} * clip.vertex_count));
  return clip;
}

}  // namespace

void FbxMessage::begin_clip(const MeshSequence& clip) {
  clip_ = bytes_.size();
  bytes_ += kClip;
  append_values(clip.name, bytes_);
  append_one(clip.vertex_count, bytes_);
  append_values(clip.polygons.offsets, bytes_);
  append_values(clip.polygons.corners, bytes_);
  append_one(uint64_t{clip.attributes.size()}, bytes_);
  for (const Attribute& attribute : clip.attributes) {
    append_one(attribute.kind, bytes_);
    append_values(attribute.name, bytes_);
    append_one(attribute.domain, bytes_);
    append_one(attribute.components, bytes_);
    append_values(attribute.values, bytes_);
  }
  append_labels(clip.materials, bytes_);
  append_labels(clip.parts, bytes_);
  append_one(clip.rate.numerator, bytes_);
  append_one(clip.rate.denominator, bytes_);
  append_one(uint8_t{clip.rate.assumed}, bytes_);
  append_one(clip.start_time, bytes_);
  append_one(static_cast<uint8_t>(clip.up), bytes_);
  append_one(clip.metres_per_unit, bytes_);
  append_one(uint64_t{0}, bytes_);
  frames_ = bytes_.size();
}

void FbxMessage::add_frame(std::span<const float> positions) {
  frame_bytes_ = positions.size_bytes();
  bytes_.append(reinterpret_cast<const char*>(positions.data()), frame_bytes_);
  const uint64_t count = (bytes_.size() - frames_) / sizeof(float);
  std::memcpy(bytes_.data() + frames_ - sizeof count, &count, sizeof count);
}

bool FbxMessage::stands_still() const {
  for (size_t at = frames_ + frame_bytes_; at < bytes_.size(); at += frame_bytes_) {
    if (std::memcmp(bytes_.data() + at, bytes_.data() + frames_, frame_bytes_) != 0)
      return false;
  }
  return true;
}

void FbxMessage::drop_clip() {
  bytes_.resize(clip_);
}

void FbxMessage::keep_first_frame() {
  bytes_.resize(frames_ + frame_bytes_);
  const uint64_t count = frame_bytes_ / sizeof(float);
  std::memcpy(bytes_.data() + frames_ - sizeof count, &count, sizeof count);
}

std::string FbxMessage::finish() {
  for (const std::string& note : notes_) {
    bytes_ += kNote;
    append_values(note, bytes_);
  }
  return std::move(bytes_);
}

FbxResult read_fbx_message(std::string_view bytes, const std::string& path) {
  FbxResult result;
  for (GuardMessage in(bytes, path); !in.at_end();) {
    const auto kind = in.one<char>();
    if (kind == kClip)
      result.clips.push_back(read_clip(in));
    else if (kind == kNote)
      result.notes.emplace_back(in.text());
    else
      in.fail();
  }
  return result;
}

}  // namespace anicodec::tools
