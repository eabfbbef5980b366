// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_PARTNER_GROWTH_H_
#define ANICODEC_CODEC_SEGMENT_PARTNER_GROWTH_H_

#include "codec/segment/partner_surface.h"
#include "sdk/pose/partners.h"

#include <cstdint>
#include <queue>
#include <vector>

namespace anicodec {

/// A correspondence that grows over a surface from a triangle and its image, best fits first, as long
/// as each vertex is within a tenth of an edge of where its neighbours' images expect it. Growths that
/// come to nothing are given up once they have taken a number of steps in proportion to the vertices:
/// over a regular sheet each triangle is like every other.
class PartnerGrowth {
 public:
  explicit PartnerGrowth(const PartnerSurface& surface)
      : surface_(surface), map_(surface.vertices(), kNone), inverse_(surface.vertices(), kNone) {}

  struct Rules {
    bool mirrored = false;
    bool symmetric = false;                        ///< partners are partners of one another
    const std::vector<uint32_t>* taken = nullptr;  ///< sources that have partners already
    const std::vector<uint32_t>* part = nullptr;   ///< unless symmetric: the part of each vertex
    uint32_t part_of_images = 0;
  };

  /// Grows from three vertices at a triangle and their images. False if it saves too few bits, or if
  /// too many growths did before.
  bool grow(const Triple& from, const Triple& to, const Rules& rules);

  /// Sources of what has grown.
  const std::vector<uint32_t>& sources() const { return sources_; }

  uint32_t image(uint32_t source) const { return map_[source]; }

 private:
  static constexpr uint32_t kNone = PosePartners::kNone;

  struct Step {
    double error;  ///< in edges
    double gain;   ///< in bits
    uint32_t corner, v, image;

    bool operator<(const Step& b) const {
      return error != b.error ? error > b.error : corner > b.corner;
    }
  };

  bool grow_from(const Triple& from, const Triple& to);
  void clear();
  bool free(uint32_t v, uint32_t image) const;
  void put(uint32_t v, uint32_t image);
  void push_gates(uint32_t v);
  void push(uint32_t corner);

  const PartnerSurface& surface_;
  Rules rules_;
  size_t steps_ = 0, wasted_ = 0;  ///< of the last growth, and how many of them led nowhere
  std::vector<uint32_t> map_, inverse_, sources_;
  std::priority_queue<Step> queue_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_PARTNER_GROWTH_H_
