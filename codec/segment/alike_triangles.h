// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_ALIKE_TRIANGLES_H_
#define ANICODEC_CODEC_SEGMENT_ALIKE_TRIANGLES_H_

#include "codec/segment/partner_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace anicodec {

/// Triangles by the lengths of their sides.
class AlikeTriangles {
 public:
  /// `triangles` of the surface.
  AlikeTriangles(const PartnerSurface& surface, std::vector<uint32_t> triangles)
      : surface_(surface), triangles_(std::move(triangles)) {
    std::ranges::sort(triangles_, [&](uint32_t a, uint32_t b) {
      return std::pair(round_length(a), a) < std::pair(round_length(b), b);
    });
  }

  double round_length(uint32_t t) const {
    const auto s = sides(surface_.triangle(t));
    return s[0] + s[1] + s[2];
  }

  std::array<double, 3> sides(const Triple& t) const {
    return {(surface_[t[1]] - surface_[t[0]]).norm(), (surface_[t[2]] - surface_[t[1]]).norm(),
            (surface_[t[0]] - surface_[t[2]]).norm()};
  }

  /// Calls visit(image) for triangles whose sides are those of `t`, about, going round as it does or,
  /// mirrored, the other way, until it returns true or `most` have been looked at.
  template <class Visit>
  bool visit_alike(const Triple& t, bool mirrored, uint32_t most, const Visit& visit) const {
    const auto wanted = sides(t);
    const double round = wanted[0] + wanted[1] + wanted[2], slack = kAlike * round;
    auto low = std::ranges::lower_bound(triangles_, round, {},
                                        [&](uint32_t x) { return round_length(x); });
    auto high = low;
    // Outwards from the nearest.
    for (uint32_t looked = 0; looked < most; ++looked) {
      const double below = low != triangles_.begin() ? round - round_length(*(low - 1)) : HUGE_VAL;
      const double above = high != triangles_.end() ? round_length(*high) - round : HUGE_VAL;
      if (std::min(below, above) > slack)
        return false;
      const uint32_t x = below <= above ? *--low : *high++;
      Triple image = surface_.triangle(x);
      if (mirrored)
        std::swap(image[0], image[1]);
      for (int turn = 0; turn < 3; ++turn) {
        const auto found = sides(image);
        if (image != t && std::abs(found[0] - wanted[0]) <= slack &&
            std::abs(found[1] - wanted[1]) <= slack && std::abs(found[2] - wanted[2]) <= slack &&
            visit(image))
          return true;
        std::rotate(image.begin(), image.begin() + 1, image.end());
      }
    }
    return false;
  }

  const std::vector<uint32_t>& triangles() const { return triangles_; }

 private:
  static constexpr double kAlike = 0.02;  // of the sides' sum

  const PartnerSurface& surface_;
  std::vector<uint32_t> triangles_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_ALIKE_TRIANGLES_H_
