// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_RESIDENCY_H_
#define ANICODEC_SDK_RESIDENCY_H_

#include "sdk/segment.h"

#include <cstdint>

namespace anicodec {

/// Puts components into the blocks of a segment. Construct it when vertices, kind, components and
/// wide_components of the segment are set: it sizes the arrays, with zeros.
class ResidentWriter {
 public:
  explicit ResidentWriter(Segment* segment);

  /// Stores a component of vectors: vertices x 3 integers. False when it is a narrow component and
  /// a value does not fit 16 bits.
  bool vectors(uint32_t component, const int32_t* values) { return store(component, values, 3); }

  /// The same for a component of scalars: one integer per vertex.
  bool scalars(uint32_t component, const int32_t* values) { return store(component, values, 1); }

 private:
  bool store(uint32_t component, const int32_t* values, uint32_t channels);

  Segment& segment_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_RESIDENCY_H_
