// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_FRAME_ATTRIBUTES_H_
#define ANICODEC_TOOLS_IO_BASE_FRAME_ATTRIBUTES_H_

#include "codec/sequence/mesh_sequence.h"

#include <cstdint>
#include <vector>

namespace anicodec::tools {

/// Whether further frames can bring other values: all attributes but normals and tangents.
bool can_move(const Attribute& attribute);

/// Takes the values of frame `frame` of the attributes that can move. `attributes` are those of the
/// frames before; one whose values are the same in all frames keeps one frame. One that `from` does
/// not have in the same form keeps what the frame before had.
void add_frame(const std::vector<Attribute>& from, uint32_t frame,
               std::vector<Attribute>& attributes);

/// The attributes in one frame: with a frame each.
std::vector<Attribute> attributes_of_frame(const std::vector<Attribute>& attributes,
                                           uint32_t frame);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_FRAME_ATTRIBUTES_H_
