// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_POLYGON_CUTTER_H_
#define ANICODEC_SDK_MESH_POLYGON_CUTTER_H_

#include "format/memory.h"
#include "sdk/base/vector3.h"

#include <cstdint>

namespace anicodec {

/// Cuts polygons into triangles that cover them once. A polygon of which no triangle of the fan from its first corner is
/// turned against the others is that fan; others lose an ear at a time, in the plane of their mean normal (G. Meisters:
/// Polygons have ears, 1975). A polygon without positions to tell, or one that crosses itself, stays a fan.
class PolygonCutter {
 public:
  /// `positions`: x y z of each vertex, null for fans; `corners`: of all polygons to come, which bound the work: some thousand
  /// comparisons each, after which concave polygons stay fans.
  PolygonCutter(const float* positions, uint64_t corners);

  /// Appends corners - 2 triangles, three numbers below `corners` each, which turn as the polygon does; none of fewer than
  /// three corners. Cost: O(corners); of concave polygons O(corners x corners that turn inwards).
  void cut(const uint32_t* vertices, uint32_t corners, Vector<uint32_t>* triangles);

 private:
  enum class Ear { kWithArea, kFlat };

  uint32_t& next(uint32_t corner) { return links_[corner]; }

  uint32_t& previous(uint32_t corner) { return links_[ring_.size() + corner]; }

  double turn(uint32_t a, uint32_t b, uint32_t c) const;
  bool is_fan(const Vector3& normal) const;
  void flatten(const Vector3& normal);
  bool is_ear(uint32_t b, Ear kind);
  bool cut_ears(Vector<uint32_t>* triangles);

  const float* positions_;
  uint64_t comparisons_;    ///< left
  Vector<Vector3> ring_;    ///< corners from the first, later in the plane
  double rounding_ = 0;     ///< a turn that rounding may make in the plane
  Vector<uint32_t> links_;  ///< next, then previous of the corners that are left
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_POLYGON_CUTTER_H_
