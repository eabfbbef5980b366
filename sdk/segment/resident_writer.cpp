// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/resident_writer.h"

#include <algorithm>

namespace anicodec {

ResidentWriter::ResidentWriter(const Vector<uint32_t>* vertex_coded, Segment* segment)
    : vertex_coded_(vertex_coded), segment_(*segment) {
  size_t per_component = size_t{block_count(segment->vertices)} * segment->channels() * kBlock;
  segment->wide.assign(per_component * segment->wide_components, 0);
  segment->narrow.assign(per_component * (segment->components - segment->wide_components), 0);
}

void ResidentWriter::pose(const int32_t* points) {
  segment_.pose.assign(size_t{block_count(segment_.vertices)} * 3 * kBlock, 0);
  for (uint32_t v = 0; v < segment_.vertices; ++v) {
    for (size_t c = 0; c < 3; ++c)
      segment_.pose[(v / kBlock * 3 + c) * kBlock + v % kBlock] =
          static_cast<float>(points[3 * coded(v) + c]);
  }
}

void ResidentWriter::regions(const Vector<uint8_t>& of_coded) {
  segment_.vertex_region.resize(size_t{block_count(segment_.vertices)} * kBlock);
  for (uint32_t v = 0; v < segment_.vertex_region.size(); ++v)
    segment_.vertex_region[v] = of_coded[coded(std::min(v, segment_.vertices - 1))];
}

bool ResidentWriter::vectors(uint32_t component, const int32_t* values) {
  bool wide = component < segment_.wide_components;
  uint32_t count = wide ? segment_.wide_components : segment_.components - segment_.wide_components;
  uint32_t row = wide ? component : component - segment_.wide_components;
  for (uint32_t v = 0; v < segment_.vertices; ++v) {
    const int32_t* from = values + coded(v) * 3;
    for (uint32_t c = 0; c < 3; ++c) {
      int32_t x = from[c];
      size_t at = ((size_t{v / kBlock} * count + row) * 3 + c) * kBlock + v % kBlock;
      if (wide) {
        segment_.wide[at] = x;
      } else {
        if (x != static_cast<int16_t>(x))
          return false;
        segment_.narrow[at] = static_cast<int16_t>(x);
      }
    }
  }
  return true;
}

void ResidentWriter::samples(const Vector<uint32_t>& rank, const float* rows, size_t stride,
                             const float* scale) {
  const size_t channels = segment_.channels();
  const size_t wide = segment_.wide_components * channels;
  const size_t all = segment_.components * channels;
  // Adding it rounds to whole numbers, ties to even: magnitudes stay below 2^22.
  constexpr float kRound = 0x1.8p23F;
  int32_t* to_wide = segment_.wide.data();
  int16_t* to_narrow = segment_.narrow.data();
  for (uint32_t first = 0; first < segment_.vertices; first += kBlock) {
    // Places past the last vertex repeat it.
    const float* row[kBlock];
    for (uint32_t i = 0; i < kBlock; ++i)
      row[i] = rows + rank[coded(std::min(first + i, segment_.vertices - 1))] * stride;
    for (size_t s = 0; s < wide; ++s) {
      for (uint32_t i = 0; i < kBlock; ++i)
        *to_wide++ = static_cast<int32_t>((row[i][s] * scale[s] + kRound) - kRound);
    }
    for (size_t s = wide; s < all; ++s) {
      for (uint32_t i = 0; i < kBlock; ++i)
        *to_narrow++ = static_cast<int16_t>((row[i][s] * scale[s] + kRound) - kRound);
    }
  }
}

}  // namespace anicodec
