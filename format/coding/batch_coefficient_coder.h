// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The second entropy coder of a basis: several times faster to decode than CoefficientModel, for a
// few bytes in a hundred (spec/08-entropy.md, section 7).
#ifndef ANICODEC_FORMAT_CODING_BATCH_COEFFICIENT_CODER_H_
#define ANICODEC_FORMAT_CODING_BATCH_COEFFICIENT_CODER_H_

#include "format/coding/binary_coder.h"
#include "format/coding/coefficient_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/symbol_row.h"
#include "format/memory.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace anicodec {

/// Context model of the residuals q, component by component, in a component by batches of up to 16
/// vertices of one level. One bit tells that a batch is zero, which most are; contexts come from
/// earlier levels and components alone, so that those of a batch can be made at once. Adapts over all
/// components that it codes: one object per basis.
///
/// Memory: 50 kB and 15 bytes per vertex, 2 more with three channels; 32 more if stride is below 8.
class BatchCoefficientModel {
 public:
  /// Vertices of a batch; a level's last one may have fewer.
  static constexpr uint32_t kBatch = 16;

  /// The arguments of CoefficientModel, and the first rank of each level, the number of ranks at the
  /// end: neighbours are of earlier levels. The pointers must outlive the model.
  BatchCoefficientModel(uint32_t channels, const int32_t* neighbours, uint32_t stride,
                        const Vector<uint32_t>& level_start);

  /// Codes a component: channels x ranks residuals of 16 or 32 bits, |q| < kCoefficientLimit. A decoder
  /// overwrites them, and leaves the rest as they were once its stream has run out or one does not fit
  /// (!coder.ok()).
  template <class Coder, class Residual>
  void code_component(Coder& coder, Residual* q) {
    begin_component();
    Coder local = std::move(coder);  // a copy that nothing else points to stays in registers
    for (size_t level = 0; level + 1 < level_start_.size(); ++level) {
      const uint32_t end = level_start_[level + 1];
      for (uint32_t first = level_start_[level]; first < end && local.ok(); first += kBatch)
        code_batch(local, first, std::min(kBatch, end - first), q);
    }
    coder = std::move(local);
    end_component();
  }

 private:
  static constexpr uint32_t kNear = 8;      ///< neighbours in use
  static constexpr uint32_t kClasses = 20;  ///< two per octave
  static constexpr uint32_t kComponents = 8, kStates = 4;
  static constexpr uint32_t kTotals = 32;  ///< classes of a batch, four per octave
  static constexpr uint32_t kBusy = 1024;  ///< from here on a batch is not asked whether it is zero

  /// A vertex that is coded: its rows but for its state, and the magnitudes so far.
  struct Vertex {
    uint32_t near, past, sum;
  };

  template <class Coder, class Residual>
  void code_batch(Coder& coder, uint32_t first, uint32_t count, Residual* q) {
    const uint32_t total = total_of(first, count);
    if (total < kBusy) {
      bool any = false;
      if constexpr (!Coder::kDecodes)
        any = any_of(q, first, count);
      AdaptiveBit& model = any_[magnitude_class<2>(total >> 1, kTotals)][recent_];
      any = coder.bit(model, any);
      recent_ = (recent_ << 1 | uint32_t{any}) & 3;
      if (!any) {
        if constexpr (Coder::kDecodes)
          clear(q, first, count);
        return;
      }
    }
    // Without branches as far as 7, which most magnitudes are: those of other batches would not be
    // foreseen. Then signs, and what is beyond.
    Vertex vertices[kBatch];
    for (uint32_t i = 0; i < count; ++i)
      vertices[i] = contexts_of(first + i);
    for (uint32_t c = 0; c < channels_; ++c) {
      Residual* values = q + size_t{c} * ranks_ + first;
      uint32_t symbols[kBatch], nonzero = 0;
      for (uint32_t i = 0; i < count; ++i) {
        Vertex& v = vertices[i];
        const uint32_t state = c == 0 ? 0 : v.sum == 0 ? 1 : v.sum <= 2 * c ? 2 : 3;
        const uint32_t s = code_row_symbol(coder, near_rows_[v.near * kStates + state],
                                           past_rows_[v.past * kStates + state],
                                           std::min(magnitude_of(values[i]), kRowEscape));
        symbols[i] = s;
        v.sum += s;
        nonzero |= uint32_t{s != 0} << i;
        if constexpr (Coder::kDecodes)
          values[i] = 0;
      }
      for (; nonzero != 0; nonzero &= nonzero - 1) {
        const auto i = static_cast<uint32_t>(__builtin_ctz(nonzero));
        code_nonzero(coder, first + i, c, symbols[i], vertices[i], values[i]);
      }
    }
    for (uint32_t i = 0; i < count; ++i)
      if (vertices[i].sum != 0)
        set_magnitude(first + i, std::min(vertices[i].sum, 255U));
  }

  /// Expectations of a batch: of each vertex the mean magnitude of its neighbours, and its own
  /// running means, in 1/16.
  uint32_t total_of(uint32_t first, uint32_t count) const {
    const uint16_t *near = &near_[first], *history = &history_[first], *past = &past_[first];
    uint32_t total = 0;
    for (uint32_t i = 0; i < count; ++i)
      total += ((near[i] * near_scale_) >> 16) + ((uint32_t{history[i]} + past[i]) >> 4);
    return total;
  }

  template <class Residual>
  bool any_of(const Residual* q, uint32_t first, uint32_t count) const {
    bool any = false;
    for (uint32_t c = 0; c < channels_; ++c)
      for (uint32_t i = 0; i < count; ++i)
        any |= q[size_t{c} * ranks_ + first + i] != 0;
    return any;
  }

  template <class Residual>
  void clear(Residual* q, uint32_t first, uint32_t count) const {
    for (uint32_t c = 0; c < channels_; ++c)
      std::fill_n(q + size_t{c} * ranks_ + first, count, Residual{0});
  }

  Vertex contexts_of(uint32_t r) const {
    const uint32_t near = magnitude_class<1>((near_[r] * near_scale_) >> 16, kClasses);
    const uint32_t history = magnitude_class<1>(uint32_t{history_[r]} >> 4, kClasses);
    const uint32_t past = magnitude_class<1>(uint32_t{past_[r]} >> 3, kClasses);
    return {near * kClasses + history, past * kComponents + std::min(component_, kComponents - 1),
            0};
  }

  static uint32_t magnitude_of(int32_t q) { return static_cast<uint32_t>(q < 0 ? -q : q); }

  /// The rest of a residual that is not 0: `symbol` tells up to 7.
  template <class Coder, class Residual>
  void code_nonzero(Coder& coder, uint32_t r, uint32_t c, uint32_t symbol, Vertex& vertex,
                    Residual& value) {
    uint32_t magnitude = symbol;
    if (symbol == kRowEscape) {
      const uint32_t excess = code_excess(coder, vertex, magnitude_of(value) - kRowEscape);
      magnitude += excess;
      vertex.sum += excess;
    }
    const bool negative = code_sign(coder, r, c, value < 0);
    if constexpr (Coder::kDecodes) {
      const auto size = static_cast<int32_t>(magnitude), decoded = negative ? -size : size;
      value = static_cast<Residual>(decoded);
      if (value != decoded)
        coder.fail();
    }
  }

  /// By how much a magnitude is above 7: two classes to an octave up to 44, then its exponent and
  /// the bits below it.
  template <class Coder>
  uint32_t code_excess(Coder& coder, const Vertex& vertex, uint32_t excess) {
    constexpr uint32_t kFirst = 4, kLast = 48;
    const uint32_t x = excess + kFirst;
    uint32_t s = x >= kLast ? kRowEscape : magnitude_class<1>(x) - kFirst;
    s = code_row_symbol(coder, near_excess_[vertex.near], past_excess_[vertex.past], s);
    if (s < kRowEscape) {
      const int bits = static_cast<int>(s / 2) + 1;
      const uint32_t low = (s % 2 + 2) << bits;
      return low + coder.raw(bits, x - low) - kFirst;
    }
    constexpr int kFar = 4;
    const uint32_t far =
        code_row_number(coder, far_[vertex.past / kComponents], kFar, x - kLast + (1U << kFar));
    const uint32_t result = far - (1U << kFar) + kLast - kFirst;
    if (result + kRowEscape >= static_cast<uint32_t>(kCoefficientLimit)) {
      coder.fail();
      return 0;
    }
    return result;
  }

  /// Signs follow those of the neighbours as they did before, or their opposites.
  template <class Coder>
  bool code_sign(Coder& coder, uint32_t r, uint32_t c, bool negative) {
    constexpr int kMost = 20;
    int8_t* signs = sign_.data() + size_t{c} * (ranks_ + 1) + 1;
    const int32_t* n = neighbours_ + size_t{r} * stride_;
    int16_t* agree = &agreement_[size_t{r} * kNear];
    int16_t near[kNear];
    for (uint32_t a = 0; a < kNear; ++a)
      near[a] = signs[n[a]];
    int agreed = 0;
    for (uint32_t a = 0; a < kNear; ++a)
      agreed += near[a] * agree[a];
    const auto size = static_cast<int>(
        magnitude_class<1>(static_cast<uint32_t>(agreed < 0 ? -agreed : agreed), kMost + 1));
    negative =
        coder.bit(signs_[static_cast<size_t>(kMost + (agreed < 0 ? -size : size))], negative);
    const auto own = static_cast<int16_t>(negative ? -14 : 14);
    for (uint32_t a = 0; a < kNear; ++a)
      agree[a] = static_cast<int16_t>(agree[a] - (agree[a] >> 3) + own * near[a]);
    signs[r] = negative ? -1 : 1;
    return negative;
  }

  /// Adds a magnitude to those of the neighbours of later vertices.
  void set_magnitude(uint32_t r, uint32_t magnitude) {
    magnitude_[r] = static_cast<uint8_t>(magnitude);
    for (uint32_t i = dependent_start_[r]; i < dependent_start_[r + 1]; ++i) {
      uint16_t& near = near_[dependents_[i]];
      near = static_cast<uint16_t>(near + dependent_weights_[i] * magnitude);
    }
  }

  void list_dependents();
  void begin_component();
  void end_component();

  uint32_t ranks_, channels_, stride_, near_scale_;
  const int32_t* neighbours_;
  Vector<int32_t> padded_;  ///< neighbours if there are fewer than kNear to a vertex
  const Vector<uint32_t>& level_start_;

  Vector<SymbolRow> near_rows_, past_rows_;      ///< magnitudes up to 7
  Vector<SymbolRow> near_excess_, past_excess_;  ///< and beyond
  RowNumber far_[kClasses];
  AdaptiveBit any_[kTotals][4];  ///< is anything of a batch not zero?
  AdaptiveBit signs_[41];

  // The vertices that have vertex r among their first neighbours, and its weight there:
  // dependent_start_[r] .. dependent_start_[r + 1] - 1.
  Vector<uint32_t> dependent_start_, dependents_;
  Vector<uint8_t> dependent_weights_;

  // Per vertex; for each channel in sign_, element 0 stands for "no neighbour".
  Vector<uint16_t> near_;      ///< weighted sum of the neighbours' magnitudes
  Vector<uint8_t> magnitude_;  ///< sum of |q| of the channels, at most 255
  Vector<uint16_t> history_,
      past_;                   ///< its running means, decay 1/2 and 27/32, in 1/256 of a channel
  Vector<int8_t> sign_;        ///< of the component's residuals
  Vector<int16_t> agreement_;  ///< kNear per vertex: do the signs of both agree?
  uint32_t component_ = 0;
  uint32_t recent_ = 0;  ///< whether the two batches before were zero
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_BATCH_COEFFICIENT_CODER_H_
