// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Permutations and corner rotations, written once for encoder and decoder (spec/07-topology.md).
#ifndef ANICODEC_SDK_MAP_CODING_H_
#define ANICODEC_SDK_MAP_CODING_H_

#include "format/binary_coder.h"
#include "format/memory.h"
#include "format/symbol_model.h"

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

/// Codes a permutation whose neighbouring entries tend to be near each other. Each entry is the
/// next free place after or before the entry before it, or one of the steps used last, or any step.
/// False when what was read is no permutation or the stream ran out. O(count) in practice.
template <class Coder>
bool code_permutation(Coder& coder, uint32_t count, Vector<uint32_t>* permutation) {
  constexpr int kRecent = 12;
  AdaptiveBit hit[kRecent + 2][4];
  SymbolModel<> step_model;
  int32_t recent[kRecent] = {};
  FreePlaces free(count);
  if constexpr (Coder::kDecodes)
    permutation->assign(count, 0);
  uint32_t before = 0;  // one more than the previous entry
  int context = 0;
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t wanted = (*permutation)[i];
    uint32_t up = free.at_or_after(before), down = free.before(before > 0 ? before - 1 : 0);
    uint32_t value = count;
    int kind = 0;
    if (up < count && coder.bit(hit[0][context], wanted == up)) {
      value = up;
    } else if (down > 0 && coder.bit(hit[1][context], wanted == down - 1)) {
      value = down - 1;
      kind = 1;
    } else {
      int32_t step = static_cast<int32_t>(wanted) - static_cast<int32_t>(before);
      int slot = 0;
      for (; slot < kRecent; ++slot) {
        if (coder.bit(hit[2 + slot][context], recent[slot] == step))
          break;
      }
      step = slot < kRecent ? recent[slot] : step_model.code(coder, step);
      kind = slot < kRecent ? 2 : 3;
      std::rotate(recent, recent + std::min(slot, kRecent - 1),
                  recent + std::min(slot, kRecent - 1) + 1);
      recent[0] = step;
      int64_t place = int64_t{before} + step;
      if (place < 0 || place >= count)
        return false;
      value = static_cast<uint32_t>(place);
    }
    if (free.at_or_after(value) != value)
      return false;
    free.take(value);
    (*permutation)[i] = value;
    before = value + 1;
    context = kind;
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

#endif  // ANICODEC_SDK_MAP_CODING_H_
