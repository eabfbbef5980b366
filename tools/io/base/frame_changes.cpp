// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/io/base/frame_changes.h"

#include "tools/io/base/printable.h"

#include <algorithm>
#include <vector>

namespace anicodec::tools {
namespace {

bool is_same(const Attribute& a, const Attribute& b) {
  return a.kind == b.kind && a.name == b.name && a.domain == b.domain &&
         a.components == b.components;
}

const Attribute* find_same(const std::vector<Attribute>& all, const Attribute& one) {
  const auto found = std::ranges::find_if(all, [&](const Attribute& a) { return is_same(a, one); });
  return found == all.end() ? nullptr : &*found;
}

bool follows_surface(const Attribute& a) {
  return a.kind == AttributeKind::kNormal || a.kind == AttributeKind::kTangent;
}

std::string text_of(const Attribute& a) {
  const std::string name = " '" + printable(a.name) + "'";
  return (a.kind == AttributeKind::kUv       ? "texture coordinates"
          : a.kind == AttributeKind::kColour ? "colours"
                                             : "numbers") +
         name;
}

/// Texture coordinates, colours and images of materials whose names are the same.
bool looks_differ(const PolygonLabels& a, const PolygonLabels& b) {
  return !a.looks.empty() && !b.looks.empty() && a.looks != b.looks;
}

}  // namespace

void FrameChanges::tell(const std::string& what, const std::string& path) {
  if (note_ && told_.insert(what).second)
    note_(path + ": " + what + "; the clip keeps what the first frame has");
}

void FrameChanges::compare_attributes(const MeshDetails& first, const MeshDetails& now,
                                      const std::string& path) {
  for (const Attribute& a : first.attributes) {
    const Attribute* other = find_same(now.attributes, a);
    if (follows_surface(a))
      continue;
    if (other == nullptr)
      tell("has no " + text_of(a), path);
  }
  for (const Attribute& a : now.attributes) {
    if (!follows_surface(a) && find_same(first.attributes, a) == nullptr)
      tell("has " + text_of(a) + ", which are new", path);
  }
}

void FrameChanges::compare_materials(const PolygonLabels& first, const PolygonLabels& now,
                                     const std::string& path) {
  if (first.names != now.names && first.names.size() == 1 && now.names.size() == 1)
    tell("the material changes, here from '" + printable(first.names[0]) + "' to '" +
             printable(now.names[0]) + "'",
         path);
  else if (first.names != now.names || first.of_polygon != now.of_polygon)
    tell("materials of faces change", path);
  else if (looks_differ(first, now))
    tell("colours or images of materials change", path);
}

void FrameChanges::compare(const MeshDetails& first, const MeshDetails& now,
                           const std::string& path) {
  compare_attributes(first, now, path);
  if (!told_.contains("materials")) {
    const size_t before = told_.size();
    compare_materials(first.materials, now.materials, path);
    if (told_.size() > before)
      told_.insert("materials");
  }
  if (first.parts.names != now.parts.names || first.parts.of_polygon != now.parts.of_polygon)
    tell("objects of faces change", path);
}

}  // namespace anicodec::tools
