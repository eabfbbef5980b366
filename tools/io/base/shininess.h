// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_BASE_SHININESS_H_
#define ANICODEC_TOOLS_IO_BASE_SHININESS_H_

#include <algorithm>
#include <cmath>

namespace anicodec::tools {

inline constexpr float kMostShininess = 1000;  ///< of MTL's Ns

/// The roughness, 0 to 1, that a specular exponent stands for, and back: a mirror has exponent 1000.
inline float roughness_of_shininess(float shininess) {
  return 1 - std::sqrt(std::clamp(shininess, 0.0F, kMostShininess) / kMostShininess);
}

inline float shininess_of_roughness(float roughness) {
  const float smooth = 1 - std::clamp(roughness, 0.0F, 1.0F);
  return kMostShininess * smooth * smooth;
}

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_BASE_SHININESS_H_
