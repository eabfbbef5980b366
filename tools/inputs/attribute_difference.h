// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_ATTRIBUTE_DIFFERENCE_H_
#define ANICODEC_TOOLS_INPUTS_ATTRIBUTE_DIFFERENCE_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <string>
#include <vector>

namespace anicodec::tools {

/// How far an attribute is from the one of the same kind and name, over all frames.
struct AttributeDifference {
  AttributeKind kind = AttributeKind::kCustom;
  std::string name;
  double max = 0;   ///< of a single number
  double rmse = 0;  ///< over all numbers
};

/// Compares the attributes that both have in the same form: those of vertices, and if `corners` says that
/// these are numbered alike, of corners. Cost: O(numbers).
std::vector<AttributeDifference> attribute_differences(const AttributeSource& a,
                                                       const AttributeSource& b, uint32_t frames,
                                                       bool corners);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_ATTRIBUTE_DIFFERENCE_H_
