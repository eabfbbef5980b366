// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_TURNED_AXES_H_
#define ANICODEC_TOOLS_INPUTS_TURNED_AXES_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The axis that is up in a file that a clip is written to: the one asked for, else Y in frames of OBJ, as
/// their readers expect, else that of the clip. A clip that does not say which axis is up stays as it is.
/// Throws Error(kUsage) for an axis that the format does not have, or of such a clip.
UpAxis up_of_output(const std::string& path, UpAxis of_clip, UpAxis asked);

/// Turns a clip's frames, normals and tangents about its x axis from the axis that is up to another.
class AxisTurn {
 public:
  AxisTurn(UpAxis from, UpAxis to);

  bool turns() const { return sign_ != 0; }

  void turn(std::vector<Attribute>& attributes) const;
  Point turned(const Point& point) const;
  FrameSource turned(FrameSource frames) const;
  AttributeSource turned(AttributeSource attributes) const;

 private:
  void turn(size_t stride, std::span<float> values) const;

  float sign_ = 0;  ///< y = sign z, z = -sign y; 0: nothing turns
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_TURNED_AXES_H_
