// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The faces of a mesh as a walk from gate to gate, written once for encoder and decoder
// (spec/07-topology.md, section 3). It grows over the surface one vertex after the other, as
// C. Touma and C. Gotsman do ("Triangle mesh compression", 1998), but takes any polygons: borders,
// edges of more than two faces, faces turned against each other, parts that touch in a vertex.
#ifndef ANICODEC_SDK_MESH_GATE_WALK_H_
#define ANICODEC_SDK_MESH_GATE_WALK_H_

#include "format/coding/symbol_model.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/mesh/gate_models.h"
#include "sdk/mesh/open_gates.h"

#include <cstdint>

namespace anicodec {

/// Faces as the walk finds them, over vertices in the order of their first use.
struct WalkedFaces {
  static constexpr uint32_t kNone = OpenGates::kNone;

  uint32_t vertices = 0;
  Vector<uint32_t> offsets;  ///< face f has corners offsets[f] .. offsets[f + 1] - 1
  Vector<uint32_t> corners;  ///< vertex of each corner
  /// For the side that starts at a corner: the corner of an earlier face where the same side starts
  /// that leads the other way, or kNone.
  Vector<uint32_t> opposite;
  Vector<uint8_t> repeats;  ///< whether a face has the corners of the one before, in the same order
};

/// A decoder's knowledge of the faces beforehand: nothing. An encoder chooses a face with find() or
/// find_seed() and is asked about its corners from the one chosen on.
struct NoFaces {
  /// Chooses a face that is not done and has the side a -> b; false if there is none.
  bool find(uint32_t, uint32_t) { return false; }

  /// Chooses any face that is not done.
  void find_seed() {}

  uint32_t corners() const { return 0; }

  /// Number of the k-th vertex of the face, or kNone before it has one.
  uint32_t vertex(uint32_t) const { return 0; }

  void set_vertex(uint32_t, uint32_t) {}

  /// How many more faces have the same corners; all of them are done.
  uint32_t finish() { return 0; }
};

template <class Coder, class Source>
class GateWalk {
 public:
  /// Room for so many vertices and corners of faces, repeats included. Memory: 11 bytes a vertex, 24
  /// a corner, 600 kB for the models.
  GateWalk(Coder& coder, Source& source, uint32_t vertices, uint32_t corners)
      : coder_(coder), source_(source), gates_(vertices, corners), about_(vertices) {}

  /// Codes `faces` faces of at most `corners` corners. `repeats`: some occur more than once.
  /// Cost: O(corners), 24 steps for each corner at a vertex that was seen and is far away.
  Status run(uint32_t faces, uint32_t corners, bool repeats, WalkedFaces* out) {
    out_ = out;
    faces_ = faces;
    most_corners_ = corners;
    repeats_ = repeats;
    out->offsets.reserve(size_t{faces} + 1);
    out->offsets.assign(1, 0);
    out->corners.reserve(corners);
    out->opposite.reserve(corners);
    out->repeats.reserve(faces);
    for (uint32_t pivot = 0; !is_complete();) {
      if (pivot == out->vertices) {
        if (Status s = seed(); s != Status::kOk)
          return s;
        continue;
      }
      about_[pivot].first = about_[pivot].faces;
      for (;;) {
        uint32_t gate = gates_.latest_from(pivot);
        const bool ends = gate == kNone;
        if (ends)
          gate = gates_.latest_to(pivot);
        if (gate == kNone || is_complete())
          break;
        if (Status s = pass(gate, ends); s != Status::kOk)
          return s;
      }
      models_.end_pivot(about_[pivot].faces);
      ++pivot;
    }
    return Status::kOk;
  }

 private:
  static constexpr uint32_t kNone = OpenGates::kNone;

  bool is_complete() const { return out_->repeats.size() == faces_; }

  bool alive() const {
    if constexpr (Coder::kDecodes)
      return coder_.ok();
    return true;
  }

  const WalkedVertex* about(uint32_t v) const { return v == kNone ? nullptr : &about_[v]; }

  /// Number of corners of the next face; 0 if there is no room for one.
  uint32_t code_size() {
    const size_t left = most_corners_ - out_->corners.size();
    return left < 3 ? 0 : models_.corners(coder_, static_cast<uint32_t>(left), source_.corners());
  }

  /// A face that meets no gate.
  Status seed() {
    source_.find_seed();
    const uint32_t n = code_size();
    if (n == 0)
      return Status::kTopology;
    const auto first = static_cast<uint32_t>(out_->corners.size());
    out_->corners.resize(first + n);
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t truth = source_.vertex(i);
      const bool seen = out_->vertices > 0 && models_.seed_seen(coder_, i, truth != kNone);
      if (Status s = seen ? code_number(truth, &out_->corners[first + i]) : add_vertex(first, i);
          s != Status::kOk)
        return s;
      if (!alive())
        return Status::kEntropy;
    }
    models_.add(Way::kSeed);
    return close(first, kNone);
  }

  /// The face beyond a gate, or that there is none.
  Status pass(uint32_t gate, bool pivot_is_b) {
    const uint32_t a = gates_.from(gate), b = gates_.to(gate);
    const uint32_t y = gates_.after(b), x = gates_.before(a);
    GateModels::Gate around{&about_[a], &about_[b], about(y), about(x), pivot_is_b, 0};
    if (models_.border(coder_, around, !source_.find(a, b))) {
      gates_.close(gate);
      WalkedVertex::count(&about_[a].borders);
      WalkedVertex::count(&about_[b].borders);
      models_.add(Way::kBorder);
      return alive() ? Status::kOk : Status::kEntropy;
    }
    const uint32_t n = code_size();
    if (n == 0)
      return Status::kTopology;
    around.shape = std::min(n - 3, 2U);
    const auto first = static_cast<uint32_t>(out_->corners.size());
    out_->corners.resize(first + n);
    uint32_t* const face = out_->corners.data() + first;
    face[0] = a;
    face[1] = b;
    uint32_t low = 2, high = n, e = b;  // corners low .. high - 1 are open
    for (uint32_t z = y; low < high && z != kNone && z != a; z = gates_.after(e)) {
      if (!models_.right(coder_, around, about_[e], about_[z], low == 2, source_.vertex(low) == z))
        break;
      face[low++] = e = z;
    }
    const bool right = low > 2;
    uint32_t g = a;
    for (uint32_t z = x; low < high && z != kNone && z != e; z = gates_.before(g)) {
      if (!models_.left(coder_, around, about_[g], about_[z], about(gates_.before(z)), right,
                        source_.vertex(high - 1) == z))
        break;
      face[--high] = g = z;
    }
    const bool left = high < n;
    bool other = false;
    for (uint32_t k = low; k < high; ++k) {
      const uint32_t truth = source_.vertex(k);
      if (!models_.seen(coder_, around, truth != kNone)) {
        if (Status s = add_vertex(first, k); s != Status::kOk)
          return s;
      } else {
        other = true;
        if (Status s = code_seen(a, b, truth, &face[k]); s != Status::kOk)
          return s;
      }
      if (!alive())
        return Status::kEntropy;
    }
    models_.add(other           ? Way::kOther
                : right && left ? Way::kBoth
                : right         ? Way::kRight
                : left          ? Way::kLeft
                                : Way::kNew);
    return close(first, gate);
  }

  Status add_vertex(uint32_t first, uint32_t corner) {
    if (out_->vertices == about_.size())
      return Status::kTopology;
    source_.set_vertex(corner, out_->vertices);
    out_->corners[first + corner] = out_->vertices++;
    return Status::kOk;
  }

  /// An earlier vertex by its number.
  Status code_number(uint32_t truth, uint32_t* v) {
    const int bits = out_->vertices == 1 ? 0 : floor_log2(out_->vertices - 1) + 1;
    *v = coder_.raw(bits, truth);
    return *v < out_->vertices ? Status::kOk : Status::kIndexRange;
  }

  /// An earlier vertex: some steps along the gates before or after the gate a -> b, else its number.
  Status code_seen(uint32_t a, uint32_t b, uint32_t truth, uint32_t* v) {
    uint32_t ends[2] = {b, a};
    for (uint32_t step = 0; step < GateModels::kSearchSteps; ++step) {
      for (const bool back : {false, true}) {
        uint32_t& z = ends[back];
        if (z == kNone)
          continue;
        z = back ? gates_.before(z) : gates_.after(z);
        if (z == kNone || z == a || z == b || step == 0)  // the first step was asked before
          continue;
        if (models_.step(coder_, step, back, z == truth)) {
          *v = z;
          return Status::kOk;
        }
      }
    }
    return code_number(truth, v);
  }

  /// Opens and closes the gates of the face whose corners begin at `first`; `passed` is the gate of
  /// its first side. Codes how often the face is repeated.
  Status close(uint32_t first, uint32_t passed) {
    const auto end = static_cast<uint32_t>(out_->corners.size());
    for (uint32_t c = first; c < end; ++c) {
      const uint32_t a = out_->corners[c], b = out_->corners[c + 1 < end ? c + 1 : first];
      WalkedVertex::count(&about_[a].faces);
      const uint32_t met = c == first && passed != kNone ? passed : gates_.find(a, b);
      if (met != kNone)
        gates_.close(met);
      else
        gates_.open(c, b, a);
      out_->opposite.push_back(met);
    }
    add_face(false);
    const uint32_t truth = source_.finish();
    if (!repeats_)
      return alive() ? Status::kOk : Status::kEntropy;
    const uint32_t left = faces_ - static_cast<uint32_t>(out_->repeats.size());
    const uint32_t again = models_.repeats(coder_, left, truth);
    if (!alive())
      return Status::kEntropy;
    if (uint64_t{again} * (end - first) > most_corners_ - out_->corners.size())
      return Status::kTopology;
    for (uint32_t i = 0; i < again; ++i) {
      for (uint32_t c = first; c < end; ++c)
        out_->corners.push_back(out_->corners[c]);
      out_->opposite.resize(out_->corners.size(), kNone);
      add_face(true);
    }
    return Status::kOk;
  }

  void add_face(bool repeats) {
    out_->offsets.push_back(static_cast<uint32_t>(out_->corners.size()));
    out_->repeats.push_back(repeats);
  }

  Coder& coder_;
  Source& source_;
  OpenGates gates_;
  Vector<WalkedVertex> about_;
  GateModels models_;
  WalkedFaces* out_ = nullptr;
  uint32_t faces_ = 0, most_corners_ = 0;
  bool repeats_ = false;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_GATE_WALK_H_
