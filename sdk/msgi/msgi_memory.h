// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MSGI_MSGI_MEMORY_H_
#define ANICODEC_SDK_MSGI_MSGI_MEMORY_H_

#include "format/records.h"

#include <cstdint>

namespace anicodec {

/// Bounds of spec/11-limits.md, section 3, for segments of MSGI: Msgi::required_bytes() and
/// Msgi::scratch_bytes(). They are two to three times what surfaces take (`encode --keyframes 4
/// --interpolation msgi` of the clips of the corpus); a mesh that needs more is refused.
inline uint64_t msgi_bytes(const Limits::Segment& s, const Limits::Mesh& mesh) {
  const uint64_t n = mesh.coded_vertices, triangles = mesh.triangles;
  uint64_t bits = 1;
  while (n >> bits != 0)
    ++bits;
  return s.components * (12 * n + 128 * triangles) + 256 * triangles + 64 * n * bits;
}

inline uint64_t msgi_frame_bytes(const Limits::Mesh& mesh) {
  return uint64_t{352} * mesh.triangles + uint64_t{96} * mesh.coded_vertices;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_MSGI_MSGI_MEMORY_H_
