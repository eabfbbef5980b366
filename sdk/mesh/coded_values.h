// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_CODED_VALUES_H_
#define ANICODEC_SDK_MESH_CODED_VALUES_H_

#include "format/memory.h"
#include "sdk/mesh/topology.h"

#include <cstdint>

namespace anicodec {

/// The integers of a mesh's Draco bitstream by coded vertex: those in triangles, which come first.
struct CodedValues {
  uint32_t components = 0;  ///< 0 without Draco
  Vector<int32_t> values;   ///< vertices in triangles x components

  const int32_t* row(size_t vertex) const { return values.data() + vertex * components; }

  /// Takes the values of points (points x components) in place. False when points of one coded
  /// vertex have different values. Cost: O(points x components), once for all segments.
  bool gather(const Topology& topology, uint32_t point_components, Vector<int32_t>&& point_values);
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_CODED_VALUES_H_
