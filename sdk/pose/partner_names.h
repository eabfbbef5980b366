// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_POSE_PARTNER_NAMES_H_
#define ANICODEC_SDK_POSE_PARTNER_NAMES_H_

#include "format/coding/binary_coder.h"
#include "format/memory.h"
#include "sdk/pose/corner_table.h"
#include "sdk/pose/partners.h"
#include "sdk/pose/pose_turn.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace anicodec {

/// Which earlier vertex each vertex is like (spec/09b-reference-pose.md, section 8). Partners come in
/// strands: along the surface the partner of a vertex is as a rule beside those of its neighbours.
/// Bounded work for each vertex. Memory: 9 bytes a vertex, and 90 kB.
class PartnerNames {
 public:
  static constexpr uint32_t kNone = PosePartners::kNone;

  /// The table must outlive it.
  explicit PartnerNames(const CornerTable& table)
      : table_(table),
        to_(table.vertex_count(), kNone),
        back_(table.vertex_count(), kNone),
        strand_(table.vertex_count(), 0) {}

  /// Codes the partner of v: none, v itself, or an earlier vertex. An encoder that wants another one
  /// gets none. False if the stream names a later vertex.
  template <class Coder, class Neighbours>
  bool code(Coder& coder, uint32_t v, const Neighbours& neighbours, const PosePartners* wanted) {
    look_around(v, neighbours);
    uint32_t partner = kNone, flips = 0;
    if constexpr (!Coder::kDecodes) {
      partner = wanted->partner[v];
      flips = wanted->flips[v];
      if (partner > v)
        partner = kNone;
    }
    const uint32_t best = count_ > 0 ? std::min<uint32_t>(candidates_[0].score, kScores - 1) : 0;
    const uint32_t linked = std::min(linked_, kMostCounted);
    const bool any = coder.bit(any_[linked][best][last_], partner != kNone);
    last_ = (last_ << 1 | any) & 3;
    if (!any)
      return true;
    const bool itself = coder.bit(itself_[linked][std::min(selves_, kMostCounted)], partner == v);
    if (itself) {
      link(v, v, nearest_ != kNone ? nearest_ : start(coder, flips));
      return true;
    }
    for (size_t i = 0; i < count_; ++i) {
      const Candidate& c = candidates_[i];
      const uint32_t gap =
          std::min<uint32_t>(c.score - (i + 1 < count_ ? candidates_[i + 1].score : 0), kGaps - 1);
      const bool is_this =
          c.vertex == partner && turns_[c.strand].mirrors() == PoseTurn(flips).mirrors();
      if (coder.bit(which_[std::min<size_t>(i, 2)][gap], is_this)) {
        link(v, c.vertex, c.strand);
        return true;
      }
    }
    int bits = 0;
    while (uint64_t{1} << bits < table_.vertex_count())
      ++bits;
    partner = coder.raw(bits, partner);
    if (partner >= v)
      return false;
    link(v, partner, start(coder, flips));
    return true;
  }

  /// Whether v is like a vertex other than itself.
  bool has(uint32_t v) const { return to_[v] != kNone && to_[v] != v; }

  uint32_t strand(uint32_t v) const { return strand_[v]; }

  PoseTurn& turn(uint32_t strand) { return turns_[strand]; }

  /// The vertex that w is like on a strand, or that is like w; or kNone.
  uint32_t image(uint32_t w, uint32_t strand) const {
    if (to_[w] != kNone && strand_[w] == strand)
      return to_[w];
    return back_[w] != kNone && strand_[back_[w]] == strand ? back_[w] : kNone;
  }

 private:
  static constexpr uint32_t kStrands = 256;  ///< that are told apart
  static constexpr uint32_t kMostNeighbours = 8, kMostCorners = 16, kMostCounted = 3;
  static constexpr uint32_t kScores = 10, kGaps = 4;
  static constexpr size_t kMostCandidates = 12;

  struct Candidate {
    uint32_t vertex, strand, score;
  };

  template <class Coder>
  uint32_t start(Coder& coder, uint32_t flips) {
    const uint32_t strand = strands_++ % kStrands;
    const PoseTurn turn(coder.raw(3, flips));
    if (strand < turns_.size())
      turns_[strand] = turn;
    else
      turns_.push_back(turn);
    return strand;
  }

  void link(uint32_t v, uint32_t partner, uint32_t strand) {
    to_[v] = partner;
    strand_[v] = static_cast<uint8_t>(strand);
    back_[partner] = v;
  }

  /// Neighbours with partners, and the candidates beside those, the likeliest first.
  template <class Neighbours>
  void look_around(uint32_t v, const Neighbours& neighbours) {
    linked_ = selves_ = 0;
    nearest_ = kNone;
    count_ = 0;
    for (size_t i = 0; i < std::min<size_t>(neighbours.size(), kMostNeighbours); ++i) {
      const uint32_t w = neighbours[i];
      const bool forth = to_[w] != kNone;
      if (!forth && back_[w] == kNone)
        continue;
      const uint32_t image = forth ? to_[w] : back_[w], strand = strand_[forth ? w : image];
      ++linked_;
      selves_ += image == w;
      if (nearest_ == kNone)
        nearest_ = strand;
      const uint32_t corners = std::min(table_.valence(image), kMostCorners);
      for (uint32_t k = 0; k < corners; ++k) {
        const uint32_t c = table_.corner(image, k);
        for (const uint32_t d : {next_corner(c), previous_corner(c)}) {
          const uint32_t x = table_.vertex(d);
          if (x < v && x != w && this->image(x, strand) == kNone)
            add(v, x, strand);
        }
      }
    }
    // By score, the first found first.
    for (size_t i = 1; i < count_; ++i) {
      for (size_t k = i; k > 0 && candidates_[k - 1].score < candidates_[k].score; --k)
        std::swap(candidates_[k - 1], candidates_[k]);
    }
  }

  void add(uint32_t v, uint32_t x, uint32_t strand) {
    for (size_t i = 0; i < count_; ++i) {
      if (candidates_[i].vertex == x && candidates_[i].strand == strand) {
        ++candidates_[i].score;
        return;
      }
    }
    if (count_ < kMostCandidates)
      candidates_[count_++] = {x, strand, 1U + (table_.valence(x) == table_.valence(v))};
  }

  const CornerTable& table_;
  Vector<uint32_t> to_, back_;  ///< partners, and who has named a vertex last
  Vector<uint8_t> strand_;      ///< of to_
  Vector<PoseTurn> turns_;
  uint32_t strands_ = 0;  ///< started so far

  // The vertex at hand.
  uint32_t linked_ = 0, selves_ = 0, nearest_ = kNone;
  std::array<Candidate, kMostCandidates> candidates_;
  size_t count_ = 0;

  AdaptiveBit any_[kMostCounted + 1][kScores][4], itself_[kMostCounted + 1][kMostCounted + 1];
  AdaptiveBit which_[3][kGaps];
  uint32_t last_ = 0;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_POSE_PARTNER_NAMES_H_
