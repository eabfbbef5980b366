// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PLAY_RAY_HIT_H_
#define ANICODEC_SDK_PLAY_RAY_HIT_H_

#include "sdk/base/vector3.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The first triangle on a ray: offered triangles one by one, it keeps the nearest. Neighbours share
/// what is computed of an edge, so that no ray slips through between them (Woop, Benthin, Wald 2013,
/// in double precision).
class RayHit {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  enum class Side : uint8_t { kAny, kFront, kBack };

  /// `direction` must have a length. Distances are in its lengths, up to `farthest`.
  RayHit(const Vector3& origin, const Vector3& direction, double farthest, Side side);

  /// Whether the ray meets a box grown by 1e-5 of its size, within the distance kept so far.
  bool meets_box(const float (&min)[3], const float (&max)[3]) const;

  /// Takes triangle `number` if the ray meets it nearer than those before.
  void offer(uint32_t number, const float* a, const float* b, const float* c);

  uint32_t triangle() const { return triangle_; }  ///< kNone: none yet

  double distance() const { return farthest_; }  ///< of the triangle; without one, the farthest

  Side side() const { return met_; }  ///< of the triangle

  double weight(size_t corner) const { return weights_[corner]; }

 private:
  Vector3 sheared(const float* point) const;

  Vector3 origin_, direction_;
  size_t axis_[3];  // the last one is that of the direction's largest component
  double shear_[3];
  double farthest_;
  Side side_, met_ = Side::kAny;
  uint32_t triangle_ = kNone;
  double weights_[3] = {};
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_PLAY_RAY_HIT_H_
