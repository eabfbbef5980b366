// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Entropy coding of the quantised prediction residuals of a basis (spec/08-entropy.md, section 5).
#ifndef ANICODEC_FORMAT_COEFFICIENT_CODER_H_
#define ANICODEC_FORMAT_COEFFICIENT_CODER_H_

#include "format/binary_coder.h"
#include "format/magnitude_class.h"
#include "format/memory.h"
#include "format/mixing.h"
#include "format/symbol_model.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace anicodec {

/// The bits that residuals about 0 would take.
struct ResidualCosts {
  float magnitude[4] = {};  ///< of |q| = 0..3, the sign left out
  float positive = 0, negative = 0;
};

/// |q| of a coefficient residual is below this, whatever a stream says.
constexpr int32_t kCoefficientLimit = 1 << 24;

/// Context model of the residuals q, coded component by component, in a component vertex by vertex
/// in decoding order, of a vertex channel by channel. Contexts depend on residuals already coded
/// and on nothing else, so all residuals can be decoded before anything is predicted. It adapts
/// over all components it codes: one object per basis.
///
/// Memory: about 0.3 MiB and 20 bytes per vertex with one channel, 0.8 MiB and 26 with three; 32
/// bytes per vertex more if stride is below 8.
class CoefficientModel {
 public:
  /// @param channels    1 (eigentrajectories) or 3 (eigenshapes)
  /// @param neighbours  vertex_count x stride ranks in decoding order, nearest first, -1 where
  /// there is none;
  ///                    each less than the vertex's own. The first 8 are used. Must outlive the
  ///                    model.
  CoefficientModel(uint32_t vertex_count, uint32_t channels, const int32_t* neighbours,
                   uint32_t stride);

  /// Codes a component: vertex_count x channels residuals, vertex by vertex. A decoder overwrites
  /// them, but leaves the rest as they were once its stream has run out (!coder.ok()).
  template <class Coder>
  void code_component(Coder& coder, int32_t* q) {
    begin_component();
    for (uint32_t v = 0; v < vertex_count_; ++v) {
      if constexpr (Coder::kDecodes)
        if (!coder.ok())
          break;
      for (uint32_t c = 0; c < channels_; ++c, ++q)
        *q = code(coder, v, c, *q);
    }
    end_component();
  }

  /// The same symbol by symbol, for an encoder that decides as it goes.
  void begin_component();
  void end_component();

  /// Codes the residual of channel c of vertex v: ascending v, for each v ascending c.
  /// @pre |q| < kCoefficientLimit
  template <class Coder>
  int32_t code(Coder& coder, uint32_t v, uint32_t c, int32_t q = 0) {
    prepare(v, c);
    q = code_prepared(coder, v, c, q);
    learn(v, c, q);
    return q;
  }

  /// The cost of code() for q, in 1/65536 bit, learning nothing. @pre code() is next for this v
  /// and c
  uint64_t cost(uint32_t v, uint32_t c, int32_t q) {
    prepare(v, c);
    BitCounter counter;
    code_prepared(counter, v, c, q);
    return counter.total();
  }

  /// The same for all small q at once, at about the cost of one. @pre as for cost()
  ResidualCosts costs(uint32_t v, uint32_t c);

 private:
  static constexpr uint32_t kNear = 8;      ///< neighbours in use
  static constexpr size_t kMagnitudes = 7;  ///< contexts of zero flag and magnitude
  static constexpr size_t kSigns = 5;       ///< contexts of the sign
  static constexpr uint32_t kQuiet = 128;   ///< bound of a quiet vertex's running means, 1/256

  void prepare(uint32_t v, uint32_t c) {
    if (ready_)
      return;
    ready_ = true;
    if (c == 0)
      start_vertex(v);
    if (!quiet_)
      prepare_channel(v, c);
  }

  /// A vertex is quiet if its neighbours are zero and it has itself been zero for a while. Zero
  /// flags of quiet vertices, half of all symbols, take the short way.
  void start_vertex(uint32_t v) {
    const int32_t* ranks = neighbours(v);
    const uint16_t* m = magnitude_.data() + 1;  // rank -1: none
    uint32_t any = last_[v + 1];
    for (size_t a = 0; a < kNear; ++a)
      any |= m[ranks[a]];
    quiet_ = any == 0 && history_[v + 1] < kQuiet && past_[v + 1] < kQuiet;
    prepared_ = false;
    sum_ = 0;
  }

  void learn(uint32_t v, uint32_t c, int32_t q) {
    ready_ = false;
    if (q != 0)
      learn_nonzero(v, c, q);
    if (c + 1 < channels_)
      return;
    if (quiet_ && sum_ == 0)
      running_ = (31 * running_) >> 5;
    else
      finish_vertex(v);
  }

  template <class Coder>
  int32_t code_prepared(Coder& coder, uint32_t v, uint32_t c, int32_t q) {
    const auto sign = [&](bool negative) {
      prepare_sign(v, c);
      return signs_.code(coder, 0, negative);
    };
    if (!quiet_)
      return magnitudes_.code(coder, q, sign);
    const uint32_t state = c == 0 ? 0 : sum_ == 0 ? 1 : 2;
    if (!coder.bit(quiet_bits_[magnitude_class<1>(past_[v + 1], 16)][state], q != 0))
      return 0;
    prepare_channel(v, c);
    return magnitudes_.code_nonzero(coder, q, sign);
  }

  void prepare_vertex(uint32_t v);
  void prepare_channel(uint32_t v, uint32_t c);
  void prepare_sign(uint32_t v, uint32_t c);
  void learn_nonzero(uint32_t v, uint32_t c, int32_t q);
  void finish_vertex(uint32_t v);

  const int32_t* neighbours(uint32_t v) const { return neighbours_ + size_t{v} * stride_; }

  uint32_t vertex_count_, channels_, stride_;
  const int32_t* neighbours_;
  Vector<int32_t> padded_;  ///< neighbours if there are fewer than kNear to a vertex
  Vector<uint8_t> valid_;   ///< neighbours of a vertex before the first -1

  MixedSymbolModel<kMagnitudes> magnitudes_;
  MixedModel<kSigns> signs_;

  // Per vertex; element 0 stands for "no neighbour", vertex v is at v + 1.
  Vector<uint16_t> magnitude_;           ///< mean |q| of the channels, in 1/64
  Vector<uint16_t> last_;                ///< the same of the component before
  Vector<uint16_t> history_, past_;      ///< its running means, decay 1/2 and 27/32, in 1/256
  std::array<Vector<int8_t>, 3> value_;  ///< q of this component and the two before, within +-100
  Vector<int8_t> agreement_;             ///< kNear per vertex: do the signs of both agree?
  // The component, vertex and channel at hand.
  uint32_t component_ = 0;
  bool ready_ = false;                            ///< the channel is prepared
  bool quiet_ = false;                            ///< the vertex is quiet
  bool prepared_ = false;                         ///< the vertex is prepared for mixing
  std::array<uint32_t, kMagnitudes> contexts_{};  ///< of all channels
  std::array<uint32_t, 2> selectors_{};
  AdaptiveBit quiet_bits_[16][3];
  uint32_t running_ = 0;  ///< running mean of magnitude_, in 1/4096
  uint32_t sum_ = 0;      ///< of |q| over the channels before
  uint32_t near6_ = 0, expected_ = 0;
  std::array<uint32_t, 4> features_{};  ///< what expected_ is a combination of ...
  std::array<int32_t, 4> shares_;       ///< ... with these coefficients, 16.16
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_COEFFICIENT_CODER_H_
