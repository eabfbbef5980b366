// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_LEARNT_SEGMENT_H_
#define ANICODEC_SDK_SEGMENT_LEARNT_SEGMENT_H_

#include "format/coding/coefficient_model.h"
#include "format/memory.h"
#include "format/records.h"
#include "sdk/prediction/vertex_order.h"

#include <cstdint>

namespace anicodec {

/// Most neighbours of a vertex in a segment that learns; it bounds the memory kept between
/// segments.
inline constexpr uint8_t kMostLearningNeighbours = 16;

/// Statistics that decoding the coefficients of a segment has taught, for the segment that continues it (spec/09a-segments.md,
/// section 9). Memory: 734 bytes a vertex at most, and 60 kB.
struct LearntSegment {
  uint64_t identity = 0;  ///< segment_identity(); 0: nothing has been learnt
  BasisKind kind = BasisKind::kEigentrajectories;
  uint64_t order = 0;        ///< hash_of() the order of the vertices
  Vector<float> prediction;  ///< see PredictionLearning
  /// One, to be continued with the order of the next segment, or none.
  Vector<CoefficientModel> coefficients;

  /// Whether a segment of this kind and order can go on from here.
  bool suits(BasisKind wanted, const VertexOrder& wanted_order) const {
    return !coefficients.empty() && kind == wanted && order == hash_of(wanted_order);
  }

  /// Tells orders of vertices, with their neighbours, apart.
  static uint64_t hash_of(const VertexOrder& order);
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_LEARNT_SEGMENT_H_
