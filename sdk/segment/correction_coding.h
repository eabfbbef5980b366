// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Sparse corrections of single vertices in single frames (spec/09-reconstruction.md). Written once
// for encoder and decoder.
#ifndef ANICODEC_SDK_SEGMENT_CORRECTION_CODING_H_
#define ANICODEC_SDK_SEGMENT_CORRECTION_CODING_H_

#include "format/coding/binary_coder.h"
#include "format/coding/symbol_model.h"
#include "format/memory.h"
#include "sdk/segment/segment.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// A correction in steps; lists are sorted by vertex.
struct IntegerCorrection {
  uint32_t vertex = 0;
  int32_t delta[3] = {0, 0, 0};
};

class CorrectionCoding {
 public:
  explicit CorrectionCoding(uint32_t vertices)
      : vertices_(vertices), before_(vertices, 0), block_before_(block_count(vertices), 0) {}

  /// Codes the corrections of the next frame. False when the stream ran out, there are more than
  /// `limit` of them, or none where it says that there are some. Cost: O(vertices / 16 + 16 x
  /// corrections) where there are any, else what is cleared of the frame before.
  template <class Coder>
  bool code_frame(Coder& coder, size_t limit, Vector<IntegerCorrection>* frame) {
    size_t at = 0;
    if constexpr (Coder::kDecodes)
      frame->clear();
    bool any = coder.bit(any_[any_before_], !frame->empty());
    any_before_ = any;
    if (!any) {
      forget();
      return alive(coder);
    }
    corrected_blocks_.clear();
    uint32_t left_block = 0, left = 0;  // neighbours to the left: corrected or not
    uint8_t beside = 0;                 // signs of the vertex to the left
    for (uint32_t b = 0; b < block_before_.size(); ++b) {
      uint32_t first = b * kBlock, last = std::min(first + kBlock, vertices_);
      bool here = at < frame->size() && (*frame)[at].vertex < last;
      const bool was_here = block_before_[b];
      here = coder.bit(block_[left_block + 2U * was_here], here);
      left_block = block_before_[b] = here;
      if (!here) {
        left = 0;
        beside = 0;
        if (was_here)
          std::fill(before_.data() + first, before_.data() + last, uint8_t{0});
        continue;
      }
      for (uint32_t v = first; v < last; ++v) {
        bool corrected = at < frame->size() && (*frame)[at].vertex == v;
        const uint8_t before = before_[v];
        corrected = coder.bit(vertex_[left + 4U * (before != 0)], corrected);
        left = (left << 1 | uint32_t{corrected}) & 3;
        if (corrected) {
          if constexpr (Coder::kDecodes) {
            if (frame->size() >= limit)
              return false;
            frame->push_back({v, {0, 0, 0}});
          }
          for (uint32_t c = 0; c < 3; ++c) {
            int32_t& d = (*frame)[at].delta[c];
            d = delta_[c][ternary(before, c)][ternary(beside, c)].code(coder, d);
          }
          before_[v] = signs((*frame)[at].delta);
          ++at;
        } else {
          before_[v] = 0;
        }
        beside = before_[v];
      }
      corrected_blocks_.push_back(b);
      if (!alive(coder))
        return false;
    }
    return alive(coder) && at > 0;
  }

 private:
  /// Nothing was corrected in the previous frame: what was then is cleared, and no more.
  void forget() {
    for (uint32_t b : corrected_blocks_) {
      const uint32_t first = b * kBlock, last = std::min(first + kBlock, vertices_);
      std::fill(before_.data() + first, before_.data() + last, uint8_t{0});
      block_before_[b] = 0;
    }
    corrected_blocks_.clear();
  }

  /// The part of a correction that is kept: 0 if there is none, else 64 and a sign in two bits for
  /// each coordinate.
  static uint8_t signs(const int32_t (&delta)[3]) {
    uint32_t packed = 64;
    for (uint32_t c = 0; c < 3; ++c)
      packed |= (delta[c] > 0 ? 1U : delta[c] < 0 ? 2U : 0U) << (2 * c);
    return static_cast<uint8_t>(packed);
  }

  /// 0, 1 if it is positive, 2 if it is negative.
  static uint32_t ternary(uint8_t packed, uint32_t c) { return packed >> (2 * c) & 3U; }

  template <class Coder>
  static bool alive(const Coder& coder) {
    if constexpr (Coder::kDecodes)
      return coder.ok();
    return true;
  }

  uint32_t vertices_;
  Vector<uint8_t> before_;             ///< corrections of the previous frame, as signs() tells them
  Vector<uint8_t> block_before_;       ///< has any in the previous frame
  Vector<uint32_t> corrected_blocks_;  ///< of the previous frame
  bool any_before_ = false;
  AdaptiveBit any_[2], block_[4], vertex_[8];
  SymbolModel<> delta_[3][3][3];  ///< coordinate, signs of the frame before and of the left
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_SEGMENT_CORRECTION_CODING_H_
