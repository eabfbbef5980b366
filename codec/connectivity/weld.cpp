// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/weld.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

namespace anicodec {
namespace {

uint64_t mixed(uint64_t h, uint32_t x) {
  h = (h ^ x) * 0x9E3779B97F4A7C15ULL;
  return h ^ (h >> 29);
}

}  // namespace

Weld weld_trajectories(const MeshSequence& sequence) {
  uint32_t n = sequence.vertex_count;
  std::vector<uint64_t> hash(n, 0);
  for (size_t f = 0; f < sequence.frame_count; ++f) {
    std::span<const float> frame = sequence.frame(f);
    for (size_t v = 0; v < n; ++v) {
      uint32_t bits[3];
      std::memcpy(bits, frame.data() + 3 * v, sizeof bits);
      hash[v] = mixed(mixed(mixed(hash[v], bits[0]), bits[1]), bits[2]);
    }
  }
  auto identical = [&](uint32_t a, uint32_t b) {
    for (size_t f = 0; f < sequence.frame_count; ++f) {
      const float* frame = sequence.frame(f).data();
      if (std::memcmp(frame + size_t{3} * a, frame + size_t{3} * b, 3 * sizeof(float)) != 0)
        return false;
    }
    return true;
  };
  std::vector<uint32_t> order(n), first(n);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return hash[a] != hash[b] ? hash[a] < hash[b] : a < b; });
  // Vertices of one hash are compared with the first one of it; a collision stays unwelded, which
  // costs bytes, not correctness.
  for (size_t i = 0, head = 0; i < n; ++i) {
    if (hash[order[i]] != hash[order[head]])
      head = i;
    first[order[i]] = i != head && identical(order[head], order[i]) ? order[head] : order[i];
  }
  Weld weld;
  weld.welded.resize(n);
  for (uint32_t v = 0; v < n; ++v) {
    if (first[v] == v) {
      weld.welded[v] = static_cast<uint32_t>(weld.representative.size());
      weld.representative.push_back(v);
    } else {
      weld.welded[v] = weld.welded[first[v]];
    }
  }
  return weld;
}

Weld no_weld(uint32_t vertices) {
  Weld weld;
  weld.welded.resize(vertices);
  std::iota(weld.welded.begin(), weld.welded.end(), 0U);
  weld.representative = weld.welded;
  return weld;
}

}  // namespace anicodec
