// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_TOOLS_CLIP_TESTING_H_
#define ANICODEC_TESTS_TOOLS_CLIP_TESTING_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A clip of one file.
inline MeshSequence load_file(const std::string& path) {
  return load_sequence(std::vector<std::string>{path});
}

/// The first attribute of a kind, or null.
inline const Attribute* find_attribute(const MeshSequence& clip, AttributeKind kind) {
  const auto found = std::ranges::find(clip.attributes, kind, &Attribute::kind);
  return found == clip.attributes.end() ? nullptr : &*found;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TESTS_TOOLS_CLIP_TESTING_H_
