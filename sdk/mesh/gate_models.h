// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The contexts of the decisions of the gate walk (spec/07-topology.md, section 3.3).
#ifndef ANICODEC_SDK_MESH_GATE_MODELS_H_
#define ANICODEC_SDK_MESH_GATE_MODELS_H_

#include "format/coding/mixing.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// The facts about a vertex of the walk; counts stay at 255.
struct WalkedVertex {
  uint8_t faces = 0;    ///< so far
  uint8_t borders = 0;  ///< gates at it that turned out to be borders
  uint8_t first = 0;    ///< faces when it became the pivot; 0 before

  static void count(uint8_t* n) { *n = static_cast<uint8_t>(*n + (*n < 255)); }
};

/// How a gate was closed.
enum class Way : uint8_t {
  kNew = 0,
  kRight = 1,
  kLeft = 2,
  kBoth = 3,
  kOther = 4,
  kSeed = 5,
  kBorder = 7
};

/// The models of the walk, and the contexts that all of them see.
class GateModels {
 public:
  static constexpr uint32_t kSearchSteps = 24;

  GateModels()
      : border_({18, 576, 256, 40}, {4, 1}, 1),
        right_({kD * kD * 6, kD * kD * 4, 1024, 4096, 1920, kD * kD * kD, 2 * kD}, {24, 16}, 1),
        left_({2 * kD * kD * kD, 8192, 10000, 256 * kD, 16 * kD * kD * kD, kD * kD * kD * kD,
               4096 * kD},
              {24, 32}, 1) {}

  /// A gate a -> b and what surrounds it. A vertex that is not there is null.
  struct Gate {
    const WalkedVertex *a, *b;
    const WalkedVertex *after_b, *before_a;
    bool pivot_is_b;
    uint32_t shape;  ///< corners of the face: 0 three, 1 four, 2 more
  };

  /// After the last gate of a pivot with so many faces.
  void end_pivot(uint32_t faces) {
    two_ago_ = one_ago_;
    one_ago_ = std::min(faces, 15U);
  }

  void add(Way way) { ways_ = ways_ << 3 | static_cast<uint32_t>(way); }

  template <class Coder>
  bool border(Coder& coder, const Gate& g, bool truth) {
    const uint32_t a = g.a->borders > 0, b = g.b->borders > 0, either = 2 * a + b;
    border_.select(
        {2 * either + was_border_,
         ((least(g.a->borders, 2) * 3 + least(g.b->borders, 2)) * 8 + least(g.a->faces, 7)) * 8 +
             least(g.b->faces, 7),
         4 * ways(2) + either, 4 * least(g.a->faces, 9) + 2 * g.pivot_is_b + a},
        either, 0);
    was_border_ = border_.code(coder, 0, truth);
    return was_border_ != 0;
  }

  /// Whether the next corner after e is z. `first`: nothing was closed on the right yet.
  template <class Coder>
  bool right(Coder& coder, const Gate& g, const WalkedVertex& e, const WalkedVertex& z, bool first,
             bool truth) {
    const uint32_t de = d(e), da = d(*g.a), dz = d(z), pivot = g.pivot_is_b;
    const uint32_t dx = g.before_a ? least(g.before_a->faces, 6) : 7;
    right_.select(
        {(de * kD + da) * 6 + 2 * g.shape + pivot, (de * kD + dz) * 4 + 2 * pivot + (first ? 0 : 1),
         2 * ways(3) + pivot, ((least(de, 7) * 8 + least(da, 7)) * 8 + least(dz, 7)) * 8 + dx,
         (least(de, 9) * 64 + ways(2)) * 3 + least(e.borders, 2), (de * kD + da) * kD + dz,
         2 * de + (&z == g.before_a)},
        2 * least(de, 11) + pivot, 2 * ways(1) + pivot);
    return right_.code(coder, 0, truth);
  }

  /// Whether the corner before e is z; `beyond`: the vertex before z, or null. `closed`: something
  /// was closed on the right.
  template <class Coder>
  bool left(Coder& coder, const Gate& g, const WalkedVertex& e, const WalkedVertex& z,
            const WalkedVertex* beyond, bool closed, bool truth) {
    const uint32_t de = d(e), db = d(*g.b), dz = d(z), pivot = g.pivot_is_b;
    const uint32_t dy = g.after_b ? d(*g.after_b) : kD - 1, dw = beyond ? d(*beyond) : kD - 1;
    left_.select(
        {((de * kD + db) * kD + dz) * 2 + pivot, 16 * ways(3) + 8 * pivot + 4 * closed + g.shape,
         ((least(de, 9) * 10 + least(db, 9)) * 10 + least(dz, 9)) * 10 + least(dy, 9),
         (de * 16 + one_ago_) * 16 + two_ago_, ((de * kD + dz) * kD + db) * 16 + one_ago_,
         ((de * kD + dz) * kD + dw) * kD + least(e.first, kD - 1), 4096 * de + ways(4)},
        2 * least(de, 11) + pivot, 8 * least(db, 3) + 2 * least(dz, 3) + closed);
    return left_.code(coder, 0, truth);
  }

  /// Corners of a face, from 3 to `most`.
  template <class Coder>
  uint32_t corners(Coder& coder, uint32_t most, uint32_t truth) {
    uint32_t n = 3;
    while (n < most && coder.bit(more_[least(n - 3, 5)][least(last_corners_ - 3, 5)], truth > n))
      ++n;
    return last_corners_ = n;
  }

  /// Whether a corner of a face beyond a gate is at a vertex that was seen.
  template <class Coder>
  bool seen(Coder& coder, const Gate& g, bool truth) {
    const uint32_t border = g.a->borders > 0 || g.b->borders > 0;
    return coder.bit(seen_[ways(1)][least(g.a->faces, 7)][g.pivot_is_b][border], truth);
  }

  /// Whether it is the one so many steps along the gates.
  template <class Coder>
  bool step(Coder& coder, uint32_t steps, bool back, bool truth) {
    return coder.bit(step_[steps][back], truth);
  }

  /// Whether corner i of a face that begins a part of the mesh was seen.
  template <class Coder>
  bool seed_seen(Coder& coder, uint32_t i, bool truth) {
    return coder.bit(seed_seen_[least(i, 3)], truth);
  }

  /// How many more faces have the same corners, at most `most`.
  template <class Coder>
  uint32_t repeats(Coder& coder, uint32_t most, uint32_t truth) {
    uint32_t n = 0;
    while (n < most && coder.bit(again_[least(n, 1)][least(last_repeats_, 2)], truth > n))
      ++n;
    return last_repeats_ = n;
  }

 private:
  static constexpr uint32_t kD = 13;  ///< classes of the number of faces at a vertex

  static uint32_t least(uint32_t x, uint32_t most) { return std::min(x, most); }

  static uint32_t d(const WalkedVertex& v) { return least(v.faces, kD - 1); }

  /// The last ways.
  uint32_t ways(uint32_t count) const { return ways_ & ((1U << (3 * count)) - 1); }

  MixedModel<4> border_;
  MixedModel<7> right_, left_;
  AdaptiveBit more_[6][6], again_[2][3], seed_seen_[4], seen_[8][8][2][2], step_[kSearchSteps][2];
  uint32_t ways_ = 0, one_ago_ = 6, two_ago_ = 6, last_corners_ = 3, last_repeats_ = 0;
  uint32_t was_border_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_GATE_MODELS_H_
