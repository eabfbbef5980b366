// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEGMENT_COEFFICIENT_SLICES_H_
#define ANICODEC_CODEC_SEGMENT_COEFFICIENT_SLICES_H_

#include "codec/connectivity/mesh_layout.h"
#include "codec/segment/encoded_segment.h"
#include "sdk/prediction/vertex_order.h"
#include "sdk/segment/basis_layer.h"
#include "sdk/segment/linear_segment.h"

#include <cstdint>
#include <vector>

namespace anicodec {

/// The order in which the vertices of an encoded segment are decoded.
VertexOrder order_of(const EncodedSegment& segment, const LinearParameters& parameters,
                     const Topology& topology);

/// Codes the coefficients of an encoded segment once more in slices, which as many threads can read.
/// What is decoded stays the same. Cost: that of reading, and of coding for each number of slices.
class CoefficientSlices {
 public:
  /// @pre applies_to(segment); both must outlive the object
  CoefficientSlices(const EncodedSegment& segment, const MeshLayout& layout);

  /// Whether a segment has coefficients whose coder knows slices.
  static bool applies_to(const EncodedSegment& segment);

  /// The segment in so many slices: is_slice_count().
  EncodedSegment in(uint32_t slices) const;

  /// That in the most slices, up to 8, that make it larger by at most `growth` bytes.
  EncodedSegment within(double growth) const;

 private:
  const EncodedSegment& segment_;
  LinearParameters parameters_;
  VertexOrder order_;
  Vector<BasisLayer> layers_;
  Vector<int32_t> wide_;    ///< residuals, as ResidualRoom has them
  Vector<int16_t> narrow_;
  uint32_t channels_;
};

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEGMENT_COEFFICIENT_SLICES_H_
