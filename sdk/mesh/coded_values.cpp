// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/coded_values.h"

#include <algorithm>
#include <utility>

namespace anicodec {

bool CodedValues::gather(const Topology& topology, uint32_t point_components,
                         Vector<int32_t>&& point_values) {
  components = point_components;
  values = std::move(point_values);
  if (components == 0)
    return true;
  uint32_t count = 0;  // new vertices come in ascending order, so rows only move to the front
  for (size_t p = 0; p < topology.point_vertex.size(); ++p) {
    const int32_t* from = values.data() + p * components;
    const uint32_t vertex = topology.point_vertex[p];
    int32_t* to = values.data() + size_t{vertex} * components;
    if (vertex == count) {
      if (to != from)
        std::copy_n(from, components, to);
      ++count;
    } else if (!std::equal(from, from + components, to)) {
      return false;
    }
  }
  values.resize(size_t{count} * components);
  return true;
}

}  // namespace anicodec
