// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Permutations and corner rotations, written once for encoder and decoder (spec/07-topology.md).
#ifndef ANICODEC_SDK_MESH_MAP_CODING_H_
#define ANICODEC_SDK_MESH_MAP_CODING_H_

#include "format/coding/binary_coder.h"
#include "format/coding/symbol_model.h"
#include "format/memory.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// The places not yet taken by a permutation of 0..count-1: finds the nearest free ones.
class FreePlaces {
 public:
  explicit FreePlaces(uint32_t count) : up_(count + 1), down_(count + 1) {
    for (uint32_t i = 0; i <= count; ++i)
      up_[i] = down_[i] = i;  // down_ is shifted by one: entry i stands for place i - 1
  }

  /// First free place >= i, or count.
  uint32_t at_or_after(uint32_t i) { return find(up_, i); }

  /// One more than the last free place < i, or 0.
  uint32_t before(uint32_t i) { return find(down_, i); }

  void take(uint32_t i) {
    up_[i] = i + 1;
    down_[i + 1] = i;
  }

 private:
  static uint32_t find(Vector<uint32_t>& link, uint32_t i) {
    while (link[i] != i)
      i = link[i] = link[link[i]];
    return i;
  }

  Vector<uint32_t> up_, down_;
};

/// Codes numbers below a count, each once, that tend to be near each other: the next free one after
/// or before the one before it, or one of the steps used last, or any step.
class DistinctNumbers {
 public:
  explicit DistinctNumbers(uint32_t count) : count_(count), free_(count) {}

  /// Codes a number and takes it. False when what was read is no number that is free.
  template <class Coder>
  bool code(Coder& coder, uint32_t wanted, uint32_t* out) {
    const uint32_t up = free_.at_or_after(before_),
                   down = free_.before(before_ > 0 ? before_ - 1 : 0);
    uint32_t value = count_;
    int kind = 0;
    if (up < count_ && coder.bit(hit_[0][context_], wanted == up)) {
      value = up;
    } else if (down > 0 && coder.bit(hit_[1][context_], wanted == down - 1)) {
      value = down - 1;
      kind = 1;
    } else {
      int32_t step = static_cast<int32_t>(wanted) - static_cast<int32_t>(before_);
      int slot = 0;
      for (; slot < kRecent; ++slot) {
        if (coder.bit(hit_[2 + slot][context_], recent_[slot] == step))
          break;
      }
      step = slot < kRecent ? recent_[slot] : step_model_.code(coder, step);
      kind = slot < kRecent ? 2 : 3;
      std::rotate(recent_, recent_ + std::min(slot, kRecent - 1),
                  recent_ + std::min(slot, kRecent - 1) + 1);
      recent_[0] = step;
      const int64_t place = int64_t{before_} + step;
      if (place < 0 || place >= count_)
        return false;
      value = static_cast<uint32_t>(place);
    }
    if (free_.at_or_after(value) != value)
      return false;
    take(value);
    context_ = kind;
    *out = value;
    return true;
  }

  /// Takes a free number that was coded by other means.
  void take(uint32_t value) {
    free_.take(value);
    before_ = value + 1;
    context_ = 0;
  }

 private:
  static constexpr int kRecent = 12;

  uint32_t count_;
  FreePlaces free_;
  AdaptiveBit hit_[kRecent + 2][4];
  SymbolModel<> step_model_;
  int32_t recent_[kRecent] = {};
  uint32_t before_ = 0;  ///< one more than the number before
  int context_ = 0;
};

/// Codes a permutation whose neighbouring entries tend to be near each other. False when what was
/// read is no permutation or the stream ran out. O(count) in practice.
template <class Coder>
bool code_permutation(Coder& coder, uint32_t count, Vector<uint32_t>* permutation) {
  DistinctNumbers numbers(count);
  if constexpr (Coder::kDecodes)
    permutation->assign(count, 0);
  for (uint32_t& entry : *permutation) {
    if (!numbers.code(coder, entry, &entry))
      return false;
    if constexpr (Coder::kDecodes) {
      if (!coder.ok())
        return false;
    }
  }
  return true;
}

/// Codes, for each polygon, which of its corners comes first.
template <class Coder>
bool code_rotations(Coder& coder, const Vector<uint32_t>& offsets, Vector<uint32_t>* first) {
  UnsignedModel model[4];
  uint32_t before = 0;
  for (size_t p = 0; p < first->size(); ++p) {
    uint32_t n = offsets[p + 1] - offsets[p];
    auto value = static_cast<uint32_t>(
        model[std::min(before, 3U)].code(coder, static_cast<int32_t>((*first)[p])));
    if (value >= std::max(n, 1U))
      return false;
    (*first)[p] = before = value;
    if constexpr (Coder::kDecodes) {
      if (!coder.ok())
        return false;
    }
  }
  return true;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_MAP_CODING_H_
