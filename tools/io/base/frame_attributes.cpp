// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/frame_attributes.h"

#include <algorithm>

namespace anicodec::tools {
namespace {

/// Values of a frame as long as `row`.
const float* row_of(const Attribute& attribute, uint32_t frame, size_t row) {
  return attribute.values.data() + (attribute.frames > 1 ? row * frame : 0);
}

}  // namespace

bool can_move(const Attribute& attribute) {
  return attribute.kind != AttributeKind::kNormal && attribute.kind != AttributeKind::kTangent;
}

void add_frame(const std::vector<Attribute>& from, uint32_t frame,
               std::vector<Attribute>& attributes) {
  for (Attribute& a : attributes) {
    if (!can_move(a))
      continue;
    const size_t row = a.values.size() / a.frames;
    const auto found = std::ranges::find_if(from, [&](const Attribute& b) {
      return b.kind == a.kind && b.name == a.name && b.components == a.components &&
             b.domain == a.domain && b.frames == 1 && b.values.size() == row;
    });
    const FrameArray last(row_of(a, a.frames - 1, row), row_of(a, a.frames - 1, row) + row);
    const FrameArray& next = found == from.end() ? last : found->values;
    if (a.frames == 1) {
      if (next == last)
        continue;
      for (uint32_t f = 1; f < frame; ++f)
        a.values.insert(a.values.end(), last.begin(), last.end());
    }
    a.values.insert(a.values.end(), next.begin(), next.end());
    a.frames = frame + 1;
  }
}

std::vector<Attribute> attributes_of_frame(const std::vector<Attribute>& attributes,
                                           uint32_t frame) {
  std::vector<Attribute> result;
  for (const Attribute& a : attributes) {
    const size_t row = a.values.size() / a.frames;
    Attribute& one = result.emplace_back();
    one.kind = a.kind;
    one.name = a.name;
    one.domain = a.domain;
    one.components = a.components;
    one.values.assign(row_of(a, frame, row), row_of(a, frame, row) + row);
  }
  return result;
}

}  // namespace anicodec::tools
