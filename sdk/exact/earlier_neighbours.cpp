// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/exact/earlier_neighbours.h"

#include <algorithm>

namespace anicodec {
namespace {

constexpr uint32_t kMissing = UINT32_MAX;

}  // namespace

EarlierNeighbours::EarlierNeighbours(const Topology& topology)
    : vertices_(size_t{kCount} * topology.coded_vertices, kMissing) {
  const Vector<uint32_t>& corners = topology.triangles;
  for (size_t t = 0; t + 2 < corners.size(); t += 3) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = corners[t + i], b = corners[t + (i + 1) % 3];
      if (a != b)
        add(std::max(a, b), std::min(a, b));
    }
  }
  for (uint32_t v = 1; v < topology.coded_vertices; ++v) {
    uint32_t* const row = vertices_.data() + size_t{kCount} * v;
    uint32_t known = 0;
    while (known < kCount && row[known] != kMissing)
      ++known;
    if (known == 0)
      row[known++] = v - 1;
    for (uint32_t i = known; i < kCount; ++i)
      row[i] = row[i - known];
  }
}

void EarlierNeighbours::add(uint32_t vertex, uint32_t other) {
  uint32_t* const row = vertices_.data() + size_t{kCount} * vertex;
  for (uint32_t i = 0; i < kCount; ++i) {
    if (row[i] == other)
      return;
    if (row[i] == kMissing || row[i] < other) {
      for (uint32_t j = kCount - 1; j > i; --j)
        row[j] = row[j - 1];
      row[i] = other;
      return;
    }
  }
}

}  // namespace anicodec
