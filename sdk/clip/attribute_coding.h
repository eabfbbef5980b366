// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// Static attributes, written once for encoder and decoder (spec/07a-attributes.md). The elements at
// a coded vertex share entries: an element uses one that is there or makes a new one, whose numbers
// are predicted by the parallelogram rule (Touma and Gotsman 1998) from the polygon across an edge.
#ifndef ANICODEC_SDK_CLIP_ATTRIBUTE_CODING_H_
#define ANICODEC_SDK_CLIP_ATTRIBUTE_CODING_H_

#include "format/attribute_record.h"
#include "format/coding/symbol_model.h"
#include "format/memory.h"
#include "format/status.h"
#include "sdk/mesh/half_edges.h"
#include "sdk/mesh/topology.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <tuple>

namespace anicodec {

/// The corners of a mesh in canonical order, and what lies across their edges.
class CornerGraph {
 public:
  static constexpr uint32_t kNone = HalfEdges::kNone;

  /// Keeps a reference to the topology. Cost: O(corners log corners).
  explicit CornerGraph(const Topology& topology)
      : topology_(topology), polygon_(topology.polygon_corners.size()) {
    for (uint32_t p = 0; p < polygon_count(); ++p) {
      for (uint32_t c = begin(p); c < end(p); ++c)
        polygon_[c] = p;
    }
    const auto coded_at = [this](uint32_t corner) { return coded(corner); };
    across_ = HalfEdges(topology.coded_vertices, corner_count(), coded_at, [this](uint32_t corner) {
                return next(corner);
              }).opposites(coded_at);
    for (uint32_t c = 0; c < corner_count(); ++c) {
      if (across_[c] != kNone && polygon_[across_[c]] >= polygon_[c])
        across_[c] = kNone;
    }
  }

  uint32_t polygon_count() const {
    return static_cast<uint32_t>(topology_.polygon_offsets.size() - 1);
  }

  uint32_t corner_count() const { return static_cast<uint32_t>(polygon_.size()); }

  uint32_t begin(uint32_t polygon) const { return topology_.polygon_offsets[polygon]; }

  uint32_t end(uint32_t polygon) const { return topology_.polygon_offsets[polygon + 1]; }

  uint32_t polygon(uint32_t corner) const { return polygon_[corner]; }

  uint32_t vertex(uint32_t corner) const { return topology_.polygon_corners[corner]; }

  uint32_t coded(uint32_t corner) const { return topology_.vertex_coded[vertex(corner)]; }

  uint32_t next(uint32_t corner) const {
    const uint32_t p = polygon_[corner];
    return corner + 1 == end(p) ? begin(p) : corner + 1;
  }

  uint32_t previous(uint32_t corner) const {
    const uint32_t p = polygon_[corner];
    return corner == begin(p) ? end(p) - 1 : corner - 1;
  }

  /// The corner of an earlier polygon where the edge from this corner to the next one starts in
  /// the opposite direction, the first such, if it is of an earlier polygon; else kNone.
  uint32_t across(uint32_t corner) const { return across_[corner]; }

  const Topology& topology() const { return topology_; }

 private:
  const Topology& topology_;
  Vector<uint32_t> polygon_;
  Vector<uint32_t> across_;
};

/// The values of an attribute: the entry of each element, and the numbers of each entry.
struct AttributeEntries {
  Vector<uint32_t> of_element;
  Vector<int32_t> numbers;  ///< entries x components
  uint32_t count = 0;
};

/// Codes an attribute of numbers. `truth` (elements x max(components, 1)) is what an encoder codes; elements of
/// vertices and corners with equal rows at one coded vertex get one entry, if they also have the same number in
/// `apart` (null: all have). Polygons have an entry each.
template <class Coder>
class AttributeCoding {
 public:
  AttributeCoding(Coder& coder, const CornerGraph& graph, AttributeDomain domain,
                  uint32_t components, const int32_t* truth, AttributeEntries* out,
                  const uint32_t* apart = nullptr)
      : coder_(coder),
        graph_(graph),
        domain_(domain),
        per_corner_(domain == AttributeDomain::kCorner),
        components_(components),
        truth_(truth),
        apart_(apart),
        out_(out),
        entry_(out->of_element),
        numbers_(out->numbers) {
    const Topology& t = graph.topology();
    entry_.assign(domain == AttributeDomain::kPolygon ? graph.polygon_count()
                  : per_corner_                       ? graph.corner_count()
                                                      : t.vertex_coded.size(),
                  CornerGraph::kNone);
    newest_.assign(t.coded_vertices, CornerGraph::kNone);
    last_.assign(components, 0);
    guess_.assign(components, 0);
  }

  Status run() {
    const Status status = run_all();
    out_->count = static_cast<uint32_t>(older_.size());
    return status;
  }

 private:
  Status run_all() {
    for (uint32_t p = 0; p < graph_.polygon_count(); ++p) {
      if (domain_ == AttributeDomain::kPolygon) {
        add_entry(p, CornerGraph::kNone);
        code_numbers(p, guess_polygon(p), guess_.data());
      } else {
        choose(p);
        predict(p);
      }
      if (!alive())
        return Status::kEntropy;
    }
    for (uint32_t v = 0; domain_ == AttributeDomain::kVertex && v < entry_.size(); ++v) {
      if (entry_[v] != CornerGraph::kNone)
        continue;
      if (choose_entry(v, graph_.topology().vertex_coded[v], newest_of(v), 0))
        code_numbers(entry_[v], kNothing, last_.data());
      if (!alive())
        return Status::kEntropy;
    }
    return Status::kOk;
  }

  /// Rules of prediction, by what is known around a corner; contexts of the residuals.
  enum Rule : uint32_t { kInside, kAcross, kStraight, kMiddle, kBefore, kNothing, kRules };

  static constexpr uint32_t kMaxWalk = 255;  ///< of entries at a vertex, newest first

  uint32_t element(uint32_t corner) const { return per_corner_ ? corner : graph_.vertex(corner); }

  uint32_t entry_at(uint32_t corner) const { return entry_[element(corner)]; }

  uint32_t newest_of(uint32_t vertex) const {
    return newest_[graph_.topology().vertex_coded[vertex]];
  }

  /// Chooses the entries of a polygon's elements; the numbers of new ones come after.
  void choose(uint32_t p) {
    first_new_ = static_cast<uint32_t>(older_.size());
    uint32_t before = 0;  // decision of the corner before: none, as guessed, otherwise
    for (uint32_t c = graph_.begin(p); c < graph_.end(p); ++c) {
      const uint32_t e = element(c);
      if (entry_[e] != CornerGraph::kNone)
        continue;
      const uint32_t coded = graph_.coded(c);
      uint32_t guess = newest_[coded], agreement = 0;
      if (per_corner_) {
        // The corners at this vertex across the edges that lead away from it and to it.
        const uint32_t away = graph_.across(c), to = graph_.across(graph_.previous(c));
        const uint32_t a = away == CornerGraph::kNone ? away : entry_[graph_.next(away)];
        const uint32_t b = to == CornerGraph::kNone ? to : entry_[to];
        agreement = a == CornerGraph::kNone && b == CornerGraph::kNone   ? 0
                    : a == b                                             ? 1
                    : a != CornerGraph::kNone && b != CornerGraph::kNone ? 2
                                                                         : 3;
        guess = a != CornerGraph::kNone ? a : b != CornerGraph::kNone ? b : guess;
      }
      const bool first = newest_[coded] == CornerGraph::kNone;
      choose_entry(e, coded, guess, 3 * agreement + before);
      if (!first)
        before = entry_[e] == guess ? 1 : 2;
    }
  }

  /// Whether a new entry was made.
  bool choose_entry(uint32_t e, uint32_t coded, uint32_t guess, uint32_t context) {
    if (guess != CornerGraph::kNone) {
      uint32_t steps = 0;
      const uint32_t wanted = truth_ ? find(e, coded, &steps) : guess;
      if (coder_.bit(as_guessed_[context], wanted == guess)) {
        entry_[e] = guess;
        return false;
      }
      const bool several = older_[newest_[coded]] != CornerGraph::kNone;
      if (several && !coder_.bit(new_, wanted == CornerGraph::kNone)) {
        steps = static_cast<uint32_t>(walk_.code(coder_, static_cast<int32_t>(steps)));
        uint32_t at = newest_[coded];
        for (steps = std::min(steps, kMaxWalk); steps > 0 && older_[at] != CornerGraph::kNone;
             --steps)
          at = older_[at];
        entry_[e] = at;
        return false;
      }
    }
    add_entry(e, newest_[coded]);
    newest_[coded] = entry_[e];
    return true;
  }

  void add_entry(uint32_t e, uint32_t older) {
    entry_[e] = static_cast<uint32_t>(older_.size());
    older_.push_back(older);
    numbers_.resize(numbers_.size() + components_);
    if (truth_)
      maker_.push_back(e);
  }

  /// The entry at a coded vertex that has the element's truth, or kNone.
  uint32_t find(uint32_t e, uint32_t coded, uint32_t* steps) const {
    const size_t columns = std::max(components_, 1U);
    *steps = 0;
    for (uint32_t at = newest_[coded]; at != CornerGraph::kNone && *steps <= kMaxWalk;
         at = older_[at], ++*steps) {
      const int32_t* other = truth_ + columns * maker_[at];
      if (std::equal(other, other + columns, truth_ + columns * e) &&
          (!apart_ || apart_[e] == apart_[maker_[at]]))
        return at;
    }
    return CornerGraph::kNone;
  }

  const int32_t* numbers(uint32_t corner) const {
    return numbers_.data() + size_t{components_} * entry_at(corner);
  }

  /// Whether the numbers at a corner of the polygon are known: its entry is older, or coded by now.
  bool known(uint32_t corner) const {
    const uint32_t entry = entry_at(corner);
    return entry < first_new_ || coded_[entry - first_new_];
  }

  /// Codes the numbers of a polygon's new entries, from a known corner onwards if there is one.
  void predict(uint32_t p) {
    const uint32_t begin = graph_.begin(p), n = graph_.end(p) - begin;
    coded_.assign(older_.size() - first_new_, 0);
    if (components_ == 0 || coded_.empty())
      return;
    uint32_t start = 0;
    while (start + 1 < n && !known(begin + start))
      ++start;
    if (!known(begin + start))
      start = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t c = begin + (start + i) % n;
      if (known(c))
        continue;
      code_numbers(entry_at(c), guess(c, n), guess_.data());
      coded_[entry_at(c) - first_new_] = 1;
    }
  }

  /// Predicts the numbers at a corner of a polygon of n corners from those that are known.
  Rule guess(uint32_t c, uint32_t n) {
    const uint32_t before = graph_.previous(c), after = graph_.next(c);
    if (!known(before) && !known(after)) {
      guess_ = last_;
      return kNothing;
    }
    if (n == 4 && known(before) && known(after) && known(graph_.next(after)))
      return sum(before, after, graph_.next(after), kInside);
    if (n == 3 && known(before) && known(after)) {
      const uint32_t o = graph_.across(after);  // starts at the vertex of `before`
      if (o != CornerGraph::kNone && entry_at(o) == entry_at(before) &&
          entry_at(graph_.next(o)) == entry_at(after))
        return sum(before, after, graph_.next(graph_.next(o)), kAcross);
    }
    if (n > 3 && known(before) && known(graph_.previous(before))) {
      const uint32_t o = graph_.across(graph_.previous(before));  // starts at that of `before`
      if (o != CornerGraph::kNone && entry_at(o) == entry_at(before))
        return sum(before, before, graph_.previous(o), kStraight);
    }
    if (known(before) && known(after)) {
      for (uint32_t i = 0; i < components_; ++i)
        guess_[i] = static_cast<int32_t>((int64_t{numbers(before)[i]} + numbers(after)[i]) >> 1);
      return kMiddle;
    }
    const int32_t* near = numbers(known(before) ? before : after);
    guess_.assign(near, near + components_);
    return kBefore;
  }

  /// Predicts the numbers of a polygon from those of the first two across its edges.
  Rule guess_polygon(uint32_t p) {
    const int32_t* near[2];
    uint32_t found = 0;
    for (uint32_t c = graph_.begin(p); c < graph_.end(p) && found < 2; ++c) {
      if (graph_.across(c) != CornerGraph::kNone)
        near[found++] = numbers_.data() + size_t{components_} * graph_.polygon(graph_.across(c));
    }
    if (found == 0) {
      guess_ = last_;
      return kNothing;
    }
    for (uint32_t i = 0; i < components_; ++i)
      guess_[i] = static_cast<int32_t>((int64_t{near[0][i]} + near[found - 1][i]) >> 1);
    return found == 2 ? kMiddle : kBefore;
  }

  Rule sum(uint32_t a, uint32_t b, uint32_t minus, Rule rule) {
    for (uint32_t i = 0; i < components_; ++i)
      guess_[i] =
          wrapped(static_cast<uint32_t>(numbers(a)[i]) + static_cast<uint32_t>(numbers(b)[i]) -
                  static_cast<uint32_t>(numbers(minus)[i]));
    return rule;
  }

  static int32_t wrapped(uint32_t x) { return static_cast<int32_t>(x); }

  void code_numbers(uint32_t entry, Rule rule, const int32_t* guess) {
    const int32_t* wanted = truth_ ? truth_ + size_t{components_} * maker_[entry] : nullptr;
    int32_t* to = numbers_.data() + size_t{components_} * entry;
    for (uint32_t i = 0; i < components_; ++i) {
      const int32_t residual = residual_[rule][std::min(i, 3U)][size_].code(
          coder_,
          wanted ? wrapped(static_cast<uint32_t>(wanted[i]) - static_cast<uint32_t>(guess[i])) : 0);
      to[i] = wrapped(static_cast<uint32_t>(guess[i]) + static_cast<uint32_t>(residual));
      size_ = static_cast<uint32_t>(
          std::min(floor_log2(static_cast<uint32_t>(std::abs(int64_t{residual})) + 1) / 2, 3));
    }
    std::copy_n(to, components_, last_.begin());
  }

  /// A decoder whose stream ran out stops soon; an encoder is always alive.
  bool alive() const {
    if constexpr (Coder::kDecodes)
      return coder_.ok();
    return true;
  }

  Coder& coder_;
  const CornerGraph& graph_;
  const AttributeDomain domain_;
  const bool per_corner_;
  const uint32_t components_;
  const int32_t* truth_;
  const uint32_t* apart_;
  AttributeEntries* out_;
  Vector<uint32_t>& entry_;  ///< of each element
  Vector<int32_t>& numbers_;
  Vector<uint32_t> newest_;  ///< entry of each coded vertex
  Vector<uint32_t> older_;   ///< entry of the same coded vertex before each entry
  Vector<uint32_t> maker_;   ///< encoder: the element that each entry was made for
  Vector<int32_t> last_, guess_;
  uint32_t first_new_ = 0;  ///< entry of the polygon
  Vector<uint8_t> coded_;   ///< of the entries from first_new_ on
  uint32_t size_ = 0;       ///< magnitude of the residual before

  AdaptiveBit as_guessed_[12], new_;
  UnsignedModel walk_;
  SymbolModel<Sign::kModelled> residual_[kRules][4][4];
};

/// Codes a label for each polygon, below `labels`: as that of a polygon across an edge or of the
/// one before, or any. kEntropy when the stream ran out, kIndexRange for a label that is too large.
template <class Coder>
Status code_labels(Coder& coder, const CornerGraph& graph, uint32_t labels,
                   Vector<uint32_t>* values) {
  AdaptiveBit as_guessed[3];
  UnsignedModel any;
  for (uint32_t p = 0; p < graph.polygon_count(); ++p) {
    uint32_t guess = p > 0 ? (*values)[p - 1] : 0, context = 0;
    for (uint32_t c = graph.begin(p); c < graph.end(p); ++c) {
      if (graph.across(c) == CornerGraph::kNone)
        continue;
      const uint32_t near = (*values)[graph.polygon(graph.across(c))];
      context = context == 0 || near == guess ? 1 : 2;
      guess = near;
    }
    uint32_t& value = (*values)[p];
    if (coder.bit(as_guessed[context], value == guess))
      value = guess;
    else
      value = static_cast<uint32_t>(any.code(coder, static_cast<int32_t>(value)));
    if constexpr (Coder::kDecodes) {
      if (!coder.ok())
        return Status::kEntropy;
    }
    if (value >= labels)
      return Status::kIndexRange;
  }
  return Status::kOk;
}

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_ATTRIBUTE_CODING_H_
