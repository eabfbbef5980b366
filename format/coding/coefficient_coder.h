// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Entropy coding of the quantised prediction residuals of a basis (spec/08-entropy.md, section 5).
#ifndef ANICODEC_FORMAT_CODING_COEFFICIENT_CODER_H_
#define ANICODEC_FORMAT_CODING_COEFFICIENT_CODER_H_

#include "format/coding/binary_coder.h"
#include "format/coding/magnitude_class.h"
#include "format/coding/mixing.h"
#include "format/coding/symbol_model.h"
#include "format/memory.h"

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

/// What coding keeps of each vertex from component to component, for as many slices as there are:
/// components j and j + 1 may be coded at the same time, the later one behind the earlier.
class CoefficientVertices {
 public:
  static constexpr uint32_t kNear = 8;  ///< neighbours in use

  /// See CoefficientModel.
  CoefficientVertices(uint32_t count, uint32_t channels, const int32_t* neighbours, uint32_t stride,
                      uint32_t slices);

  uint32_t count() const { return count_; }

  uint32_t channels() const { return channels_; }

  const int32_t* neighbours(uint32_t v) const { return neighbours_ + size_t{v} * stride_; }

  /// Clears what is kept of a component while it is coded. @pre the one `slices` before it is done
  void begin(uint32_t component);

  /// Takes ranks of a component that are coded into the running means.
  void finish(uint32_t component, uint32_t first, uint32_t last);

 private:
  friend class CoefficientSlice;

  /// Places in magnitude_ and value_ of a component, or of one before it.
  size_t magnitude_at(uint32_t component, uint32_t before = 0) const {
    return (size_t{component} + slices_ + 1 - before) % (slices_ + 1) * (size_t{count_} + 1);
  }

  size_t value_at(uint32_t component, uint32_t before = 0) const {
    return (size_t{component} + slices_ + 2 - before) % (slices_ + 2) * (size_t{count_} + 1) *
           channels_;
  }

  uint32_t count_, channels_, stride_, slices_;
  const int32_t* neighbours_;
  Vector<int32_t> padded_;             ///< neighbours if there are fewer than kNear to a vertex
  Vector<uint8_t> valid_;              ///< neighbours of a vertex before the first -1
  Vector<uint16_t> history_, past_;    ///< means of magnitudes, decay 1/2 and 27/32, in 1/256
  Vector<int8_t> agreement_;           ///< kNear per vertex: do the signs of both agree?
  // Of the components at hand and before, in turns; element 0 stands for "no neighbour", vertex v is
  // at v + 1.
  Vector<uint16_t> magnitude_;  ///< mean |q| of the channels, in 1/64; slices + 1 components
  Vector<int8_t> value_;        ///< q within +-100; slices + 2 components
};

/// The contexts of every slices-th component, and where it stands in the one at hand.
class CoefficientSlice {
 public:
  explicit CoefficientSlice(uint32_t channels);

  /// Starts a component; the vertices have begun it.
  void begin(const CoefficientVertices& vertices, uint32_t component);

  template <class Coder>
  int32_t code(CoefficientVertices& vertices, Coder& coder, uint32_t v, uint32_t c, int32_t q) {
    prepare(vertices, v, c);
    q = code_prepared(vertices, coder, v, c, q);
    learn(vertices, v, c, q);
    return q;
  }

  uint64_t cost(const CoefficientVertices& vertices, uint32_t v, uint32_t c, int32_t q) {
    prepare(vertices, v, c);
    BitCounter counter;
    code_prepared(vertices, counter, v, c, q);
    return counter.total();
  }

  ResidualCosts costs(const CoefficientVertices& vertices, uint32_t v, uint32_t c);

 private:
  static constexpr uint32_t kNear = CoefficientVertices::kNear;
  static constexpr size_t kMagnitudes = 7;  ///< contexts of zero flag and magnitude
  static constexpr size_t kSigns = 5;       ///< contexts of the sign
  static constexpr uint32_t kQuiet = 128;   ///< bound of a quiet vertex's running means, 1/256

  void prepare(const CoefficientVertices& vertices, uint32_t v, uint32_t c) {
    if (ready_)
      return;
    ready_ = true;
    if (c == 0)
      start_vertex(vertices, v);
    if (!quiet_)
      prepare_channel(vertices, v, c);
  }

  /// A vertex is quiet if its neighbours are zero and it has itself been zero for a while. Zero
  /// flags of quiet vertices, half of all symbols, take the short way.
  void start_vertex(const CoefficientVertices& vertices, uint32_t v) {
    const int32_t* ranks = vertices.neighbours(v);
    const uint16_t* m = vertices.magnitude_.data() + magnitude_at_ + 1;  // rank -1: none
    uint32_t any = vertices.magnitude_[last_at_ + v + 1];
    for (size_t a = 0; a < kNear; ++a)
      any |= m[ranks[a]];
    quiet_ = any == 0 && vertices.history_[v] < kQuiet && vertices.past_[v] < kQuiet;
    prepared_ = false;
    sum_ = 0;
  }

  void learn(CoefficientVertices& vertices, uint32_t v, uint32_t c, int32_t q) {
    ready_ = false;
    if (q != 0)
      learn_nonzero(vertices, v, c, q);
    if (c + 1 < vertices.channels())
      return;
    if (quiet_ && sum_ == 0)
      running_ = (31 * running_) >> 5;
    else
      finish_vertex(vertices, v);
  }

  template <class Coder>
  int32_t code_prepared(const CoefficientVertices& vertices, Coder& coder, uint32_t v, uint32_t c,
                        int32_t q) {
    const auto sign = [&](bool negative) {
      prepare_sign(vertices, v, c);
      return signs_.code(coder, 0, negative);
    };
    if (!quiet_)
      return magnitudes_.code(coder, q, sign);
    const uint32_t state = c == 0 ? 0 : sum_ == 0 ? 1 : 2;
    if (!coder.bit(quiet_bits_[magnitude_class<1>(vertices.past_[v], 16)][state], q != 0))
      return 0;
    prepare_channel(vertices, v, c);
    return magnitudes_.code_nonzero(coder, q, sign);
  }

  void prepare_vertex(const CoefficientVertices& vertices, uint32_t v);
  void prepare_channel(const CoefficientVertices& vertices, uint32_t v, uint32_t c);
  void prepare_sign(const CoefficientVertices& vertices, uint32_t v, uint32_t c);
  void learn_nonzero(CoefficientVertices& vertices, uint32_t v, uint32_t c, int32_t q);
  void finish_vertex(CoefficientVertices& vertices, uint32_t v);

  MixedSymbolModel<kMagnitudes> magnitudes_;
  MixedModel<kSigns> signs_;
  AdaptiveBit quiet_bits_[16][3];
  std::array<int32_t, 4> shares_;  ///< of features_ in expected_, 16.16
  // The component, vertex and channel at hand.
  uint32_t component_ = 0;
  size_t magnitude_at_ = 0, last_at_ = 0;         ///< in the vertices' arrays
  std::array<size_t, 3> value_at_{};              ///< of this component and the two before
  bool ready_ = false;                            ///< the channel is prepared
  bool quiet_ = false;                            ///< the vertex is quiet
  bool prepared_ = false;                         ///< the vertex is prepared for mixing
  std::array<uint32_t, kMagnitudes> contexts_{};  ///< of all channels
  std::array<uint32_t, 2> selectors_{};
  uint32_t running_ = 0;  ///< running mean of magnitudes, in 1/4096
  uint32_t sum_ = 0;      ///< of |q| over the channels before
  uint32_t near6_ = 0, expected_ = 0;
  std::array<uint32_t, 4> features_{};  ///< what expected_ is a combination of
};

/// Context model of the residuals q, coded component by component, in a component vertex by vertex
/// in decoding order, of a vertex channel by channel. Contexts depend on residuals already coded
/// and on nothing else, so all residuals can be decoded before anything is predicted. It adapts
/// over all components it codes: one object per basis.
///
/// Component j belongs to slice j mod slices. Each slice has a stream and adaptive models of its own,
/// and follows the one before by vertices: as many threads can decode.
///
/// Memory: for a slice about 0.3 MiB and 3 bytes per vertex with one channel, 0.8 MiB and 5 with
/// three, and 17 or 21 per vertex in all; 32 per vertex more if stride is below 8.
class CoefficientModel {
 public:
  /// @param channels    1 (eigentrajectories) or 3 (eigenshapes)
  /// @param neighbours  vertex_count x stride ranks in decoding order, nearest first, -1 where
  /// there is none;
  ///                    each less than the vertex's own. The first 8 are used. Must outlive the
  ///                    model.
  CoefficientModel(uint32_t vertex_count, uint32_t channels, const int32_t* neighbours,
                   uint32_t stride, uint32_t slices = 1)
      : vertices_(vertex_count, channels, neighbours, stride, slices),
        slices_(slices, CoefficientSlice(channels)) {}

  /// Components coded before.
  uint32_t component() const { return component_; }

  uint32_t slice_count() const { return static_cast<uint32_t>(slices_.size()); }

  /// The slice of the component that is next.
  uint32_t slice() const { return component_ % slice_count(); }

  /// Codes a component by the coder of its slice: channels x vertices residuals of 16 or 32 bits. A
  /// decoder overwrites them, but leaves the rest as they were once its stream has run out
  /// (!coder.ok()) or one does not fit; false then.
  template <class Coder, class Residual>
  bool code_component(Coder& coder, Residual* q) {
    const bool good = code_ranks(coder, component_, 0, vertices_.count(), q);
    ++component_;
    return good;
  }

  /// Codes vertices first .. last - 1 of a component by the coder of its slice, as above. Calls for
  /// different slices may run at the same time. @pre the same vertices of the component before are
  /// coded, and those before `first` of this one; end_components() follows
  template <class Coder, class Residual>
  bool code_ranks(Coder& coder, uint32_t component, uint32_t first, uint32_t last, Residual* q) {
    CoefficientSlice& slice = slices_[component % slice_count()];
    if (first == 0)
      begin(component);
    const uint32_t channels = vertices_.channels();
    for (uint32_t v = first; v < last; ++v) {
      if constexpr (Coder::kDecodes)
        if (!coder.ok())
          return false;
      for (uint32_t c = 0; c < channels; ++c) {
        Residual& place = q[size_t{c} * vertices_.count() + v];
        const int32_t value = slice.code(vertices_, coder, v, c, place);
        place = static_cast<Residual>(value);
        if (place != value)
          return false;
      }
    }
    vertices_.finish(component, first, last);
    if constexpr (Coder::kDecodes)
      return coder.ok();
    return true;
  }

  /// After code_ranks() of all vertices of so many components.
  void end_components(uint32_t count) { component_ += count; }

  /// The same symbol by symbol, for an encoder that decides as it goes.
  void begin_component() { begin(component_); }

  void end_component() {
    vertices_.finish(component_, 0, vertices_.count());
    ++component_;
  }

  /// Codes the residual of channel c of vertex v: ascending v, for each v ascending c.
  /// @pre |q| < kCoefficientLimit
  template <class Coder>
  int32_t code(Coder& coder, uint32_t v, uint32_t c, int32_t q = 0) {
    return slices_[slice()].code(vertices_, coder, v, c, q);
  }

  /// The cost of code() for q, in 1/65536 bit, learning nothing. @pre code() is next for this v
  /// and c
  uint64_t cost(uint32_t v, uint32_t c, int32_t q) {
    return slices_[slice()].cost(vertices_, v, c, q);
  }

  /// The same for all small q at once, at about the cost of one. @pre as for cost()
  ResidualCosts costs(uint32_t v, uint32_t c) { return slices_[slice()].costs(vertices_, v, c); }

 private:
  void begin(uint32_t component) {
    vertices_.begin(component);
    slices_[component % slice_count()].begin(vertices_, component);
  }

  CoefficientVertices vertices_;
  Vector<CoefficientSlice> slices_;
  uint32_t component_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_FORMAT_CODING_COEFFICIENT_CODER_H_
