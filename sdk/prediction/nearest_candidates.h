// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_PREDICTION_NEAREST_CANDIDATES_H_
#define ANICODEC_SDK_PREDICTION_NEAREST_CANDIDATES_H_

#include "format/compiler.h"
#include "sdk/prediction/vertex_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace anicodec {

/// Bounds on degrees that keep the cost of an order linear (normative).
inline constexpr uint32_t kMaxRemovedDegree = 32;  // a vertex of higher degree waits
inline constexpr uint32_t kMaxRingDegree = 32;     // the ring of such a neighbour is not searched
inline constexpr size_t kMaxCandidates =
    kMaxRemovedDegree * (1 + kMaxRingDegree) +  // rings 1 and 2
    kMaxNeighbours * kMaxRingDegree +           // ring 3, if those are few
    kMaxRemovedDegree * kMaxRingDegree;         // the same level

/// Position on the grid and index of a vertex.
struct GridVertex {
  int32_t x, y, z;
  uint32_t id;
};

inline uint32_t squared_distance(const GridVertex& a, const GridVertex& b) {
  const int32_t x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return static_cast<uint32_t>(x * x) + static_cast<uint32_t>(y * y) + static_cast<uint32_t>(z * z);
}

/// Candidates for the neighbours of one vertex; tells the nearest of them.
class NearestCandidates {
 public:
  void clear() { count_ = 0; }

  void add(const GridVertex& candidate, const GridVertex& self) {
    distance_[count_] = static_cast<int32_t>(squared_distance(candidate, self) ^ 0x80000000u);
    id_[count_++] = static_cast<int32_t>(candidate.id);
  }

  /// Writes the indices of the m nearest by distance, then index; fewer if there are not as many.
  void select(size_t m, int32_t* to);

 private:
  static constexpr size_t kLanes = 4;
  static constexpr size_t kMaxCounted = 64;
  using Lanes = int32_t ANICODEC_VECTOR(4 * kLanes);

  template <bool kTies>
  bool count_ranks(size_t m, int32_t* to);
  void sort(size_t m, int32_t* to);

  size_t count_ = 0;
  int32_t distance_[kMaxCandidates + kLanes];  // with the sign bit flipped: compares as signed
  int32_t id_[kMaxCandidates + kLanes];
};

// The rank of a candidate is the number of nearer ones: no branches to mispredict. Without kTies
// equal distances share a rank and the ranks fail to add up to 0 + 1 + ...: returns false.
template <bool kTies>
bool NearestCandidates::count_ranks(size_t m, int32_t* to) {
  int32_t sorted[kMaxCounted + kLanes];
  for (size_t i = count_; i < count_ + kLanes; ++i)
    distance_[i] = id_[i] = INT32_MAX;
  int32_t sum = 0;
  for (size_t i = 0; i < count_; i += kLanes) {
    Lanes distance, id, rank{};
    std::memcpy(&distance, distance_ + i, sizeof distance);
    std::memcpy(&id, id_ + i, sizeof id);
    for (size_t j = 0; j < count_; ++j) {
      rank -= distance_[j] < distance;
      if constexpr (kTies)
        rank -= (distance_[j] == distance) & (id_[j] < id);
    }
    for (size_t l = 0; l < kLanes; ++l) {  // padding ranks last
      sorted[rank[l]] = id[l];
      sum += i + l < count_ ? rank[l] : 0;
    }
  }
  const auto n = static_cast<int32_t>(count_);
  if (2 * sum != n * (n - 1))
    return false;
  std::memcpy(to, sorted, std::min(m, count_) * sizeof *to);
  return true;
}

inline void NearestCandidates::sort(size_t m, int32_t* to) {
  uint64_t keys[kMaxCandidates];
  for (size_t i = 0; i < count_; ++i)
    keys[i] = uint64_t{static_cast<uint32_t>(distance_[i]) ^ 0x80000000u} << 32 |
              static_cast<uint32_t>(id_[i]);
  m = std::min(m, count_);
  std::partial_sort(keys, keys + m, keys + count_);
  for (size_t i = 0; i < m; ++i)
    to[i] = static_cast<int32_t>(keys[i] & 0xffffffff);
}

inline void NearestCandidates::select(size_t m, int32_t* to) {
  if (count_ > kMaxCounted)
    sort(m, to);
  else if (!count_ranks<false>(m, to))
    count_ranks<true>(m, to);
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_PREDICTION_NEAREST_CANDIDATES_H_
