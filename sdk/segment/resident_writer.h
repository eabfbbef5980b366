// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_SEGMENT_RESIDENT_WRITER_H_
#define ANICODEC_SDK_SEGMENT_RESIDENT_WRITER_H_

#include "format/memory.h"
#include "sdk/segment/segment.h"

#include <cstddef>
#include <cstdint>

namespace anicodec {

/// Puts what is decoded for coded vertices into the blocks of a segment, vertex by vertex of the
/// segment. Construct it when vertices, kind, components and wide_components of the segment are
/// set: it sizes the arrays of coefficients, with zeros.
class ResidentWriter {
 public:
  /// vertex_coded: see SegmentContext; must outlive the writer.
  ResidentWriter(const Vector<uint32_t>* vertex_coded, Segment* segment);

  /// Stores the reference pose: coded vertices x 3 integers.
  void pose(const int32_t* points);

  /// Stores the regions: a number for each coded vertex.
  void regions(const Vector<uint8_t>& of_coded);

  /// Stores a component of vectors: coded vertices x 3 integers. False when it is a narrow
  /// component and a value does not fit 16 bits.
  bool vectors(uint32_t component, const int32_t* values);

  /// Stores all components at once, rounded: sample s = channels x component + channel of coded
  /// vertex c is rows[rank[c] * stride + s] * scale[s], which must fit the component's width. One
  /// pass over the blocks, each row read once.
  void samples(const Vector<uint32_t>& rank, const float* rows, size_t stride, const float* scale);

 private:
  size_t coded(uint32_t vertex) const { return vertex_coded_ ? (*vertex_coded_)[vertex] : vertex; }

  const Vector<uint32_t>* vertex_coded_;
  Segment& segment_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_RESIDENT_WRITER_H_
