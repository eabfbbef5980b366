// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/turned_axes.h"

#include "codec/sequence/error.h"
#include "tools/io/file_formats.h"

#include <utility>

namespace anicodec::tools {

UpAxis up_of_output(const std::string& path, UpAxis of_clip, UpAxis asked) {
  if (is_whole_clip(path)) {  // of scenes and archives, which are turned where they are written
    if (asked == UpAxis::kZ)
      throw Error(ErrorKind::kUsage, path + ": has Y up, as all of its kind; --up z is for others");
    return of_clip;
  }
  if (asked != UpAxis::kUnknown && of_clip == UpAxis::kUnknown)
    throw Error(ErrorKind::kUsage,
                path + ": --up turns a clip that says which axis is up, and this one does not");
  if (of_clip == UpAxis::kUnknown)
    return of_clip;
  const FileFormat* format = format_of(path);
  return asked != UpAxis::kUnknown            ? asked
         : format && format->frames_have_y_up ? UpAxis::kY
                                              : of_clip;
}

AxisTurn::AxisTurn(UpAxis from, UpAxis to)
    : sign_(from == to         ? 0.0F
            : to == UpAxis::kY ? 1.0F
                               : -1.0F) {}

/// The first three numbers of each `stride`.
void AxisTurn::turn(size_t stride, std::span<float> values) const {
  for (size_t i = 0; i + 2 < values.size(); i += stride) {
    const float y = values[i + 1];
    values[i + 1] = sign_ * values[i + 2];
    values[i + 2] = -sign_ * y;
  }
}

void AxisTurn::turn(std::vector<Attribute>& attributes) const {
  if (!turns())
    return;
  for (Attribute& attribute : attributes) {
    if (attribute.kind == AttributeKind::kNormal || attribute.kind == AttributeKind::kTangent)
      turn(attribute.components, attribute.values);
  }
}

Point AxisTurn::turned(const Point& point) const {
  const auto sign = static_cast<double>(sign_);
  return turns() ? Point{point[0], sign * point[2], -sign * point[1]} : point;
}

FrameSource AxisTurn::turned(FrameSource frames) const {
  if (!turns())
    return frames;
  return [frames = std::move(frames), axes = *this,
          turned = std::vector<float>()](uint32_t f) mutable {
    const std::span<const float> positions = frames(f);
    turned.assign(positions.begin(), positions.end());
    axes.turn(3, turned);
    return std::span<const float>(turned);
  };
}

AttributeSource AxisTurn::turned(AttributeSource attributes) const {
  if (!turns())
    return attributes;
  return [attributes = std::move(attributes), axes = *this](uint32_t f) {
    std::vector<Attribute> own = attributes(f);
    axes.turn(own);
    return own;
  };
}

}  // namespace anicodec::tools
