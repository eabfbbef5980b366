// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Which copy of a coded vertex a corner has, written once for encoder and decoder
// (spec/07-topology.md, section 4).
#ifndef ANICODEC_SDK_MESH_COPY_CODING_H_
#define ANICODEC_SDK_MESH_COPY_CODING_H_

#include "format/coding/mixing.h"
#include "format/coding/symbol_model.h"
#include "sdk/mesh/gate_walk.h"

#include <algorithm>
#include <cstdint>

namespace anicodec {

/// Copies of walked vertices, each vertex' numbered from 0 in the order of their first use.
struct CornerCopies {
  Vector<uint32_t> corners;   ///< the copy at each corner
  Vector<uint32_t> vertices;  ///< how many copies corners use of each vertex
};

/// A decoder's knowledge of the copies beforehand: nothing.
struct NoCopies {
  /// Whether all corners of a face have the copies of the face before.
  bool repeats_copies(uint32_t) const { return false; }

  /// Number of the copy at a corner, or kNone before it has one.
  uint32_t copy(uint32_t) const { return 0; }

  void set_copy(uint32_t, uint32_t) {}
};

/// Seams and hard edges run along sides of faces: a copy is most often that of a face across a side,
/// and if not there, then mostly not at the other end either.
template <class Coder, class Source>
class CopyCoding {
 public:
  /// Memory: 4 bytes a corner.
  CopyCoding(Coder& coder, Source& source, const WalkedFaces& faces, CornerCopies* out)
      : coder_(coder), source_(source), faces_(faces), out_(*out), next_(faces.corners.size()) {
    for (size_t f = 0; f + 1 < faces.offsets.size(); ++f) {
      for (uint32_t c = faces.offsets[f]; c < faces.offsets[f + 1]; ++c)
        next_[c] = c + 1 < faces.offsets[f + 1] ? c + 1 : faces.offsets[f];
    }
  }

  /// Codes copies, at most `most` of all vertices. Cost: O(corners).
  Status run(uint32_t most) {
    out_.corners.resize(faces_.corners.size());
    out_.vertices.assign(faces_.vertices, 0);
    left_ = most;
    for (uint32_t f = 0; f + 1 < faces_.offsets.size(); ++f) {
      const uint32_t begin = faces_.offsets[f], end = faces_.offsets[f + 1];
      if (faces_.repeats[f] && coder_.bit(repeated_, source_.repeats_copies(f))) {
        uint32_t* const corners = out_.corners.data() + begin;
        std::copy_n(corners - (end - begin), end - begin, corners);
      } else {
        for (uint32_t c = begin; c < end; ++c) {
          if (Status s = code_corner(c, c > begin ? c - 1 : end - 1, c - begin); s != Status::kOk)
            return s;
        }
      }
      if constexpr (Coder::kDecodes) {
        if (!coder_.ok())
          return Status::kEntropy;
      }
    }
    return Status::kOk;
  }

 private:
  static constexpr uint32_t kNone = WalkedFaces::kNone;
  static constexpr uint32_t kAsked = 16;  ///< copies that are asked for one by one

  /// The other end of a side of the corner: does it have the copy that the face across has?
  enum OtherEnd : uint32_t { kOther = 0, kSame = 1, kNoFace = 2, kNotCoded = 3 };

  /// The vertices of the face across a side, at both ends of it.
  struct Side {
    uint32_t here = kNone, there = kNone;
    OtherEnd end = kNoFace;
  };

  static uint32_t least(uint32_t x, uint32_t most) { return std::min(x, most); }

  uint32_t used(uint32_t corner) const { return out_.vertices[faces_.corners[corner]]; }

  Status code_corner(uint32_t c, uint32_t before, uint32_t i) {
    const uint32_t after = next_[c], v = faces_.corners[c], count = out_.vertices[v];
    uint32_t copy = 0;
    if (count > 0) {
      Side p, q;
      if (const uint32_t o = faces_.opposite[before]; o != kNone) {
        p = {out_.corners[o], out_.corners[next_[o]], kNotCoded};
        if (i > 0)
          p.end = p.there == out_.corners[before] ? kSame : kOther;
      }
      if (const uint32_t o = faces_.opposite[c]; o != kNone) {
        q = {out_.corners[next_[o]], out_.corners[o], kNotCoded};
        if (after < c)
          q.end = q.there == out_.corners[after] ? kSame : kOther;
      }
      copy =
          code_copy(p, q, i, count, least(used(before), 4), least(used(after), 4), source_.copy(c));
    }
    if (copy > count || (copy == count && left_ == 0))
      return Status::kTopology;
    if (copy == count) {
      --left_;
      ++out_.vertices[v];
      source_.set_copy(c, copy);
    }
    out_.corners[c] = copy;
    return Status::kOk;
  }

  /// A copy of a vertex that has `count`, or `count` for a new one; more is an error.
  uint32_t code_copy(const Side& p, const Side& q, uint32_t i, uint32_t count, uint32_t near_p,
                     uint32_t near_q, uint32_t truth) {
    const uint32_t here = least(count, 4), many = count > 1, place = least(i, 3);
    const uint32_t all = (here * 5 + near_p) * 5 + near_q;
    const uint32_t has_q = q.here != kNone, has_p = p.here != kNone;
    if (has_p) {
      const uint32_t equal = !has_q ? 2 : q.here == p.here;
      across_before_.select(
          {(p.end * 2 + many) * 2 + has_q, (p.end * 4 + q.end) * 125 + all, 4 * answers(4) + p.end,
           (equal * 4 + p.end) * 4 + place, 3 * all + equal, answers(8)},
          p.end, 0);
      if (answer(across_before_.code(coder_, 0, truth == p.here)))
        return p.here;
    }
    const bool other_q = has_q && q.here != p.here;
    if (other_q) {
      across_after_.select(
          {(q.end * 2 + has_p) * 2 + many, ((q.end * 4 + p.end) * 2 + has_p) * 125 + all,
           (answers(4) * 4 + q.end) * 2 + has_p, ((q.end * 4 + p.end) * 2 + has_p) * 4 + place,
           2 * all + has_p, 2 * answers(8) + has_p},
          2 * q.end + has_p, 0);
      if (answer(across_after_.code(coder_, 0, truth == q.here)))
        return q.here;
    }
    uint32_t others = count - has_p - other_q;
    if (others == 0)
      return count;
    new_.select({(least(count, 7) * 2 + has_p) * 2 + has_q, 2 * all + has_p,
                 (answers(4) * 2 + has_p) * 7 + least(count, 6),
                 ((p.end * 4 + q.end) * 2 + has_p) * 2 + has_q},
                has_p, 0);
    if (new_.code(coder_, 0, truth == kNone))
      return count;
    uint32_t asked = 0;
    for (uint32_t copy = count; copy-- > 0;) {
      if (copy == p.here || copy == q.here)
        continue;
      if (--others == 0)
        return copy;
      if (asked == kAsked) {
        const uint32_t number = coder_.raw(floor_log2(count - 1) + 1, truth);
        return number < count ? number : kNone;
      }
      if (coder_.bit(which_[asked++], truth == copy))
        return copy;
    }
    return kNone;
  }

  uint32_t answers(uint32_t count) const { return answers_ & ((1U << count) - 1); }

  bool answer(bool same) {
    answers_ = answers_ << 1 | static_cast<uint32_t>(same);
    return same;
  }

  Coder& coder_;
  Source& source_;
  const WalkedFaces& faces_;
  CornerCopies& out_;
  Vector<uint32_t> next_;  ///< corner of each corner's face
  uint32_t left_ = 0, answers_ = 0;
  MixedModel<6> across_before_{{16, 2000, 64, 48, 375, 256}, {4, 1}, 1};
  MixedModel<6> across_after_{{16, 4000, 128, 128, 250, 512}, {8, 1}, 1};
  MixedModel<4> new_{{32, 250, 224, 64}, {2, 1}, 1};
  AdaptiveBit repeated_, which_[kAsked];
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_COPY_CODING_H_
