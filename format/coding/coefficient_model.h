// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Entropy coding of the quantised prediction residuals of a basis (spec/08-entropy.md, section 7).
#ifndef ANICODEC_FORMAT_CODING_COEFFICIENT_MODEL_H_
#define ANICODEC_FORMAT_CODING_COEFFICIENT_MODEL_H_

#include "format/coding/binary_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/symbol_row.h"
#include "format/compiler.h"
#include "format/memory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace anicodec {

/// |q| of a coefficient residual is below this, whatever a stream says.
constexpr int32_t kCoefficientLimit = 1 << 24;

/// The bits that residuals about 0 would take.
struct ResidualCosts {
  /// Bits of |q| = 0 .. 6, the sign left out; for 7 and more, up to there.
  float magnitude[kRowSymbols] = {};
  float positive = 0, negative = 0;
};

/// Context model of the residuals q, component by component, in a component by batches of up to 32
/// vertices of one level. One bit tells that a batch is zero, which most are; contexts come from
/// earlier levels and components alone, so that those of a batch can be made at once. Adapts over all
/// components that it codes: one object per basis.
///
/// Memory: 60 kB and 50 bytes per vertex, 2 more with three channels.
class CoefficientModel {
 public:
  /// Vertices of a batch; a level's last one may have fewer.
  static constexpr uint32_t kBatch = 32;

  /// @param channels     1 (eigentrajectories) or 3 (eigenshapes)
  /// @param neighbours   ranks x stride earlier ranks, nearest first, -1 where there is none: of earlier
  ///                     levels. The first 8 are used. Must outlive the model. @pre stride >= 8
  /// @param level_start  the first rank of each level, the number of ranks at the end. Must outlive it, too
  CoefficientModel(uint32_t channels, const int32_t* neighbours, uint32_t stride,
                   const Vector<uint32_t>& level_start);

  /// Goes on with the components of a segment that continues the one at hand: the same order of the vertices, in
  /// arrays that must outlive the model.
  void continue_with(const int32_t* neighbours, const Vector<uint32_t>& level_start);

  uint32_t channels() const { return channels_; }

  uint32_t ranks() const { return ranks_; }

  const Vector<uint32_t>& level_start() const { return *level_start_; }

  /// Codes a component: channels x ranks residuals of 16 or 32 bits, |q| < kCoefficientLimit. A decoder
  /// overwrites them, and leaves the rest as they were once its stream has run out or one does not fit
  /// (!coder.ok()).
  template <class Coder, class Residual>
  void code_component(Coder& coder, Residual* q) {
    begin_component();
    Coder local = std::move(coder);  // a copy that nothing else points to stays in registers
    for (size_t level = 0; level + 1 < level_start_->size(); ++level) {
      const uint32_t end = (*level_start_)[level + 1];
      for (uint32_t first = (*level_start_)[level]; first < end && local.ok(); first += kBatch)
        code_batch(local, first, std::min(kBatch, end - first), q);
    }
    coder = std::move(local);
    end_component();
  }

  /// The same by batches, for an encoder that decides as it goes: all in turn.
  void begin_component();
  void end_component();

  template <class Coder, class Residual>
  void code_batch(Coder& coder, uint32_t first, uint32_t count, Residual* q) {
    const uint32_t total = total_of(first, count);
    if (total < kBusy) {
      bool any = false;
      if constexpr (!Coder::kDecodes)
        any = any_of(q, first, count);
      any = coder.bit(any_[magnitude_class<2>(total >> 1, kTotals)][recent_], any);
      recent_ = (recent_ << 1 | uint32_t{any}) & 3;
      if (!any) {
        if constexpr (Coder::kDecodes)
          clear(q, first, count);
        run_ = (3 * run_) >> 3;
        return;
      }
    }
    // Without branches as far as 7, which most magnitudes are: those of other batches would not be
    // foreseen. Then signs, and what is beyond.
    Batch batch;
    set_contexts(first, count, batch);
    for (uint32_t c = 0; c < channels_; ++c) {
      Residual* values = q + size_t{c} * ranks_ + first;
      uint32_t symbols[kBatch], nonzero = 0;
      for (uint32_t i = 0; i < count; ++i) {
        Vertex& v = batch.vertices[i];
        const uint32_t state = state_of(c, v.sum);
        const uint32_t s = code_row_symbol(coder, expected_rows_[v.expected * kStates + state],
                                           near_rows_[v.near * kStates + state],
                                           past_rows_[v.past * kStates + state],
                                           std::min(magnitude_of(values[i]), kRowEscape));
        symbols[i] = s;
        v.sum += s;
        nonzero |= uint32_t{s != 0} << i;
        if constexpr (Coder::kDecodes)
          values[i] = 0;
      }
      for (; nonzero != 0; nonzero &= nonzero - 1) {
        const auto i = static_cast<uint32_t>(lowest_bit(nonzero));
        code_nonzero(coder, first + i, c, symbols[i], batch.vertices[i], values[i]);
      }
    }
    learn(first, count, batch);
  }

  /// Contexts of a vertex but for its state, and the magnitudes of its channels so far.
  struct Vertex {
    uint32_t expected, near, past, sum;
  };

  /// Contexts of a rank whose batch is next, those of earlier levels being coded.
  Vertex contexts_of(uint32_t rank) const;

  /// By how many bits less it takes to tell that a batch is zero than that it is not; minus infinity where
  /// that cannot be told.
  float zero_saves(uint32_t first, uint32_t count) const;

  /// The bits that a residual of a rank would take, after `sum` in the channels before it; what a batch of
  /// zeros saves is left out. q: the residuals of earlier levels.
  ResidualCosts costs(const Vertex& vertex, uint32_t rank, uint32_t channel, uint32_t sum,
                      const int32_t* q) const;

 private:
  static constexpr uint32_t kNear = 8;       ///< neighbours in use
  static constexpr uint32_t kClasses = 20;   ///< of magnitudes, two per octave
  static constexpr uint32_t kExpected = 56;  ///< of what is expected, four per octave
  static constexpr uint32_t kComponents = 8, kStates = 4;
  static constexpr uint32_t kTotals = 32;  ///< classes of a batch, four per octave
  static constexpr uint32_t kBusy = 512;   ///< from here on a batch is not asked whether it is zero
  static constexpr uint32_t kFeatures = 5;
  static constexpr int kUnit = 128;  ///< of features and running means: a magnitude of 1
  static constexpr int kMostSign = 20;
  static constexpr int16_t kSignWeights[kNear] = {4, 2, 2, 2, 0, 0, 0, 0};

  using Signs = int16_t ANICODEC_VECTOR(2 * kNear);

  struct Batch {
    Vertex vertices[kBatch];
    alignas(16) int16_t features[kFeatures][kBatch];
    alignas(16) int16_t expected[kBatch];
  };

  static uint32_t state_of(uint32_t c, uint32_t sum) {
    return c == 0 ? 0 : sum == 0 ? 1 : sum <= 2 * c ? 2 : 3;
  }

  static uint32_t magnitude_of(int32_t q) { return static_cast<uint32_t>(q < 0 ? -q : q); }

  /// Mean magnitude of the neighbours' residuals.
  ANICODEC_INLINE uint32_t near_of(uint32_t r) const { return (near_[r] * near_scale_) >> 13; }

  /// Expectations of a batch: of each vertex the mean magnitude of its neighbours, and its own
  /// running means, in 1/16.
  uint32_t total_of(uint32_t first, uint32_t count) const {
    const uint16_t* near = &near_[first];
    const int16_t *history = &history_[first], *past = &past_[first];
    uint32_t total = 0;
    for (uint32_t i = 0; i < count; ++i)
      total += ((near[i] * near_scale_) >> 16) + (static_cast<uint32_t>(history[i] + past[i]) >> 3);
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

  /// The context of a vertex: magnitudes around it, its own means, that of the batches
  /// before, and its own by how large its neighbours are now and were.
  ANICODEC_INLINE void set_features(uint32_t r, size_t stride, int16_t* to) const {
    const uint32_t near = near_of(r);
    const auto past = static_cast<uint32_t>(past_[r]), around = static_cast<uint32_t>(around_[r]);
    to[0] = static_cast<int16_t>(near);
    to[stride] = history_[r];
    to[2 * stride] = past_[r];
    to[3 * stride] = static_cast<int16_t>(run_);
    to[4 * stride] =
        static_cast<int16_t>(std::min((past + 4) * (near + 2) / (around + 4), uint32_t{INT16_MAX}));
  }

  ANICODEC_INLINE uint32_t expected_of(const int16_t* features, size_t stride) const {
    uint32_t sum = 0;
    for (size_t k = 0; k < kFeatures; ++k)
      sum += static_cast<uint32_t>(features[k * stride] * share_[k]);
    return std::min(sum >> 13, uint32_t{INT16_MAX});
  }

  ANICODEC_INLINE Vertex classes_of(const int16_t* features, size_t stride,
                                    uint32_t expected) const {
    const auto class_of = [&](size_t k, int shift) {
      return magnitude_class<1>(static_cast<uint32_t>(features[k * stride]) >> shift, kClasses);
    };
    return {magnitude_class<2>(expected, kExpected), class_of(0, 3) * kClasses + class_of(1, 3),
            class_of(2, 2) * kComponents + std::min(component_, kComponents - 1), 0};
  }

  void set_contexts(uint32_t first, uint32_t count, Batch& batch) const {
    for (uint32_t i = 0; i < count; ++i) {
      int16_t* features = &batch.features[0][i];
      set_features(first + i, kBatch, features);
      const uint32_t expected = expected_of(features, kBatch);
      batch.expected[i] = static_cast<int16_t>(expected);
      batch.vertices[i] = classes_of(features, kBatch, expected);
    }
  }

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

  /// By how much a magnitude is above 7.
  template <class Coder>
  uint32_t code_excess(Coder& coder, const Vertex& vertex, uint32_t excess) {
    const auto symbol = [&](uint32_t s) {
      return code_row_symbol(coder, expected_excess_[vertex.expected], near_excess_[vertex.near],
                             past_excess_[vertex.past], s);
    };
    const uint32_t result = code_row_excess(coder, symbol, far_[vertex.expected / 4], excess);
    if (result + kRowEscape >= static_cast<uint32_t>(kCoefficientLimit)) {
      coder.fail();
      return 0;
    }
    return result;
  }

  /// The bit of a sign, by the sum of what neighbours say.
  static size_t sign_class(int agreed) {
    const auto size = static_cast<int>(
        magnitude_class<1>(static_cast<uint32_t>(agreed < 0 ? -agreed : agreed), kMostSign + 1));
    return static_cast<size_t>(kMostSign + (agreed < 0 ? -size : size));
  }

  /// Signs follow those of the neighbours, as they did before or their opposites.
  template <class Coder>
  bool code_sign(Coder& coder, uint32_t r, uint32_t c, bool negative) {
    int8_t* signs = sign_.data() + size_t{c} * (ranks_ + 1) + 1;
    const int32_t* n = neighbours_ + size_t{r} * stride_;
    int16_t* agree = &agreement_[size_t{r} * kNear];
    const auto sign_of = [&](size_t a) -> int16_t { return signs[n[a]]; };
    const Signs near = {sign_of(0), sign_of(1), sign_of(2), sign_of(3),
                        sign_of(4), sign_of(5), sign_of(6), sign_of(7)};
    Signs agreement, by_place;
    ANICODEC_COPY(&agreement, agree, sizeof agreement);
    ANICODEC_COPY(&by_place, kSignWeights, sizeof by_place);
    const Signs votes = near * (agreement + by_place);
    int agreed = 0;
    ANICODEC_UNROLL for (uint32_t a = 0; a < kNear; ++a) agreed += votes[a];
    negative = coder.bit(signs_[sign_class(agreed)], negative);
    const auto own = static_cast<int16_t>(negative ? -14 : 14);
    agreement += own * near - (agreement >> 3);
    ANICODEC_COPY(agree, &agreement, sizeof agreement);
    signs[r] = negative ? -1 : 1;
    return negative;
  }

  /// Adds a magnitude to those of the neighbours of later vertices.
  ANICODEC_INLINE void set_magnitude(uint32_t r, uint32_t magnitude) {
    magnitude_[r] = static_cast<uint8_t>(magnitude);
    for (uint32_t i = dependent_start_[r], end = dependent_start_[r + 1]; i < end; ++i) {
      uint16_t& near = near_[dependents_[i]];
      near = static_cast<uint16_t>(near + dependent_weights_[i] * magnitude);
    }
  }

  /// Takes the magnitudes of a batch over, and moves the shares of features along the gradient of the
  /// squared error: normalised least mean squares.
  void learn(uint32_t first, uint32_t count, const Batch& batch) {
    const int unit = kUnit / static_cast<int>(channels_);
    uint32_t sum = 0, norm = 200;
    int32_t gradient[kFeatures] = {};
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t m = std::min(batch.vertices[i].sum, 255U);
      if (m != 0)
        set_magnitude(first + i, m);
      sum += m;
      const int expected = batch.expected[i];
      const int error =
          (std::min(static_cast<int>(m) * unit, 3 * expected + 2 * kUnit) - expected) >> 3;
      for (size_t k = 0; k < kFeatures; ++k) {
        const int x = batch.features[k][i] >> 3;
        gradient[k] += error * x;
        norm += static_cast<uint32_t>(x * x);
      }
    }
    run_ = (3 * run_ + 5 * static_cast<int>(sum * static_cast<uint32_t>(unit) / count)) >> 3;
    const int shift = floor_log2(norm);
    for (size_t k = 0; k < kFeatures; ++k) {
      const int64_t share = share_[k] + ((int64_t{gradient[k]} * 1024) >> shift);
      share_[k] = static_cast<int16_t>(std::clamp<int64_t>(share, 0, kMostShare));
    }
  }

  void list_dependents();

  uint32_t ranks_, channels_, stride_, near_scale_;
  const int32_t* neighbours_;
  const Vector<uint32_t>* level_start_;

  Vector<SymbolRow> expected_rows_, near_rows_, past_rows_;        ///< magnitudes up to 7
  Vector<SymbolRow> expected_excess_, near_excess_, past_excess_;  ///< and beyond
  RowNumber far_[kExpected / 4];
  AdaptiveBit any_[kTotals][4];  ///< is anything of a batch not zero?
  AdaptiveBit signs_[2 * kMostSign + 1];

  // The vertices that have vertex r among their first neighbours, and its weight there:
  // dependent_start_[r] .. dependent_start_[r + 1] - 1.
  Vector<uint32_t> dependent_start_, dependents_;
  Vector<uint8_t> dependent_weights_;

  // Per vertex; for each channel in sign_, element 0 stands for "no neighbour".
  Vector<uint16_t> near_;           ///< weighted sum of the neighbours' magnitudes
  Vector<int16_t> history_, past_;  ///< running means of magnitudes, decay 1/2 and 27/32
  Vector<int16_t> around_;          ///< and of near_of()
  Vector<uint8_t> magnitude_;       ///< sum of |q| of the channels, at most 255
  Vector<int8_t> sign_;             ///< of the component's residuals
  Vector<int16_t> agreement_;       ///< kNear per vertex: do the signs of both agree?
  static constexpr int kMostShare = 16383;
  int16_t share_[kFeatures] = {1638, 2458, 2458, 819,
                               1638};  ///< of features in what is expected, 1/8192
  int run_ = 0;                        ///< running mean of the magnitudes of batches
  uint32_t component_ = 0;             ///< components coded before
  uint32_t recent_ = 0;                ///< whether the two batches before were zero
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_COEFFICIENT_MODEL_H_
