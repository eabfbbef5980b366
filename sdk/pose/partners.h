// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_PARTNERS_H_
#define ANICODEC_SDK_POSE_PARTNERS_H_

#include "format/memory.h"

#include <cstdint>

namespace anicodec {

/// Whom the vertices of a pose are like, as an encoder found it: parts that mirror or repeat one
/// another. Empty: nobody.
struct PosePartners {
  static constexpr uint32_t kNone = UINT32_MAX;

  Vector<uint32_t> partner;  ///< by vertex: another one, itself on a plane of symmetry, or kNone
  Vector<uint8_t> flips;     ///< by vertex: PoseTurn's, of the partner's place into its own
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_PARTNERS_H_
