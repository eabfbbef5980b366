// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/prediction/vertex_order.h"

#include "format/compiler.h"
#include "format/sort.h"
#include "sdk/prediction/nearest_candidates.h"
#include "sdk/prediction/vertex_order_cost.h"

#include <algorithm>
#include <utility>

namespace anicodec {
namespace {

// Bounds that keep the cost linear whatever the graph (normative). Surfaces have a mean degree of
// about six and never meet them, save for poles of fans.
constexpr uint64_t kMinRemovedFraction = 16;  // a graph that loses less of it is replaced
constexpr int kGridBits = 15;                 // per axis: squared distances fit 32 bits
constexpr int kIdBits = 30, kCurveBits = 30;  // of a place on the curve, and the region above them

/// Sorts by distance from `to`, then by index.
uint64_t nearness(const GridVertex& a, const GridVertex& to) {
  return uint64_t{squared_distance(a, to)} << 32 | a.id;
}

uint32_t floor_log2(uint32_t x) {  // 0 for 0
  return x < 2 ? 0 : static_cast<uint32_t>(highest_bit(x));
}

uint64_t spread_bits(uint64_t x) {  // ten bits to every third
  x = (x | x << 16) & 0x30000ff;
  x = (x | x << 8) & 0x300f00f;
  x = (x | x << 4) & 0x30c30c3;
  return (x | x << 2) & 0x9249249;
}

uint64_t morton_key(const GridVertex& v, uint8_t region) {
  constexpr int drop = kGridBits - 10;
  const auto part = [](int32_t c) { return spread_bits(static_cast<uint64_t>(c) >> drop); };
  return uint64_t{region} << (kIdBits + kCurveBits) |
         (part(v.x) | part(v.y) << 1 | part(v.z) << 2) << kIdBits | v.id;
}

uint32_t id_of(uint64_t key) {
  return static_cast<uint32_t>(key & ((uint64_t{1} << kIdBits) - 1));
}

bool same_region(uint64_t a, uint64_t b) {
  return a >> (kIdBits + kCurveBits) == b >> (kIdBits + kCurveBits);
}

/// Undirected graph without loops and multiple edges: vertex v has adjacent[start[v]] ..
/// [start[v+1]-1].
struct Graph {
  Vector<uint32_t> start, adjacent;

  uint32_t degree(uint32_t v) const { return start[v + 1] - start[v]; }

  const uint32_t* begin(uint32_t v) const { return adjacent.data() + start[v]; }

  const uint32_t* end(uint32_t v) const { return adjacent.data() + start[v + 1]; }
};

class Contraction {
 public:
  Contraction(MeshGraph mesh, int m, int colours, const uint8_t* regions,
              const HostThreads& threads)
      : m_(m), colours_(colours), is_dense_(mesh.is_dense()), regions_(regions), threads_(threads) {
    const size_t vertex_count = mesh.vertex_count();
    nodes_.resize(vertex_count);
    neighbours_.assign(vertex_count * static_cast<size_t>(m), -1);
    removal_.reserve(vertex_count);
    isolated_.reserve(vertex_count);
    rank_.resize(vertex_count);
    if (!threads.run || vertex_count < kShared)
      teams_ = 1;
    for (size_t t = 0; t < teams_; ++t)
      stamps_[t].last.assign(vertex_count, 0);
    std::move(mesh).take(&graph_.start, &graph_.adjacent);
    if (regions && !is_dense_)
      cut_regions();
  }

  void set_grid(const int32_t* positions);
  void run();
  void write(VertexOrder* out);

  uint64_t visits() const {
    uint64_t sum = 0;
    for (const Stamps& s : stamps_)
      sum += s.visits;
    return sum;
  }

 private:
  enum State : uint8_t { kKept, kRemoved, kLocked };

  /// The last tick that met a vertex, by local index.
  struct Stamps {
    Vector<uint32_t> last;
    uint32_t tick = 0;
    uint64_t visits = 0;  ///< see vertex_order_cost.h
  };

  static constexpr size_t kTeams = 4;         ///< parts of a level, for threads
  static constexpr size_t kShared = 1 << 12;  ///< vertices of a level that is worth it

  void cut_regions();
  void drop_isolated();
  void link_all();
  void select_removed();
  void contract();
  void colour();
  void find_neighbours();
  void find_neighbours(size_t first, size_t last, Stamps& stamps);
  void add_same_level(uint32_t v, NearestCandidates& nearest, Stamps& stamps);
  void append_level();
  void end_level(size_t first);
  void advance();

  int m_, colours_;
  bool is_dense_;               // the mesh, whose edges are not here
  const uint8_t* regions_;      // of all vertices, by index; may be null
  Vector<GridVertex> nodes_;    // all vertices
  Vector<int32_t> neighbours_;  // indices, of all vertices by rank
  Vector<uint32_t> removal_;    // vertices, finest level first
  Vector<uint32_t> level_end_;  // in removal_
  Vector<uint32_t> rank_;       // of the vertices that are removed
  Vector<uint32_t> isolated_;   // alive vertices without edges, not part of the graph

  // The graph G of the current level over the local indices of its active vertices, ascending in
  // index; G' over those that stay.
  Vector<GridVertex> active_, next_active_;
  Graph graph_, next_;
  Vector<uint8_t> state_, colour_;
  Vector<uint32_t> removed_, target_, renumbered_, visit_, merged_, merged_next_;
  size_t teams_ = kTeams;
  Stamps stamps_[kTeams];
  HostThreads threads_;
};

void Contraction::set_grid(const int32_t* positions) {
  const size_t n = nodes_.size();
  int32_t low[3], extent = 0;
  for (int d = 0; d < 3; ++d) {
    int32_t high = low[d] = n ? positions[d] : 0;
    for (size_t v = 1; v < n; ++v) {
      low[d] = std::min(low[d], positions[3 * v + static_cast<size_t>(d)]);
      high = std::max(high, positions[3 * v + static_cast<size_t>(d)]);
    }
    extent = std::max(extent, high - low[d]);
  }
  int shift = 0;
  while (extent >> shift >= 1 << kGridBits)
    ++shift;
  for (size_t v = 0; v < n; ++v) {
    const int32_t* p = positions + 3 * v;
    nodes_[v] = {(p[0] - low[0]) >> shift, (p[1] - low[1]) >> shift, (p[2] - low[2]) >> shift,
                 static_cast<uint32_t>(v)};
  }
}

// Edges between regions leave the graph.
void Contraction::cut_regions() {
  uint32_t size = 0;
  for (uint32_t v = 0; v < nodes_.size(); ++v) {
    const uint32_t first = graph_.start[v], last = graph_.start[v + 1];
    graph_.start[v] = size;
    for (uint32_t e = first; e < last; ++e) {
      const uint32_t u = graph_.adjacent[e];
      if (regions_[u] == regions_[v])
        graph_.adjacent[size++] = u;
    }
  }
  graph_.start[nodes_.size()] = size;
  graph_.adjacent.resize(size);
}

// Vertices without edges leave the graph; the others are renumbered.
void Contraction::drop_isolated() {
  const auto n = static_cast<uint32_t>(active_.size());
  uint32_t kept = 0;
  for (uint32_t v = 0; v < n; ++v)
    kept += graph_.degree(v) > 0;
  if (kept == n)
    return;
  renumbered_.resize(n);
  kept = 0;
  for (uint32_t v = 0; v < n; ++v) {
    renumbered_[v] = kept;
    if (graph_.degree(v) > 0) {
      graph_.start[kept] = graph_.start[v];
      active_[kept++] = active_[v];
    } else {
      isolated_.push_back(active_[v].id);
    }
  }
  graph_.start[kept] = graph_.start[n];
  graph_.start.resize(size_t{kept} + 1);
  active_.resize(kept);
  for (uint32_t& u : graph_.adjacent)
    u = renumbered_[u];
}

// The graph is replaced by one along a space-filling curve over all alive vertices of a region: each
// is linked to the two before and the two after it.
void Contraction::link_all() {
  for (const GridVertex& v : active_)
    isolated_.push_back(v.id);
  sort_ascending(isolated_.begin(), isolated_.end());
  active_.clear();
  Vector<uint64_t> curve;
  curve.reserve(isolated_.size());
  for (uint32_t i = 0; i < isolated_.size(); ++i) {
    active_.push_back(nodes_[isolated_[i]]);
    GridVertex local = active_.back();
    local.id = i;
    curve.push_back(morton_key(local, regions_ ? regions_[isolated_[i]] : uint8_t{0}));
  }
  isolated_.clear();
  sort_ascending(curve.begin(), curve.end());
  const auto n = static_cast<int64_t>(curve.size());
  Vector<uint32_t> place(curve.size());
  for (size_t i = 0; i < curve.size(); ++i)
    place[id_of(curve[i])] = static_cast<uint32_t>(i);
  graph_.start.assign(1, 0);
  graph_.adjacent.clear();
  for (const uint32_t at : place) {
    for (const int d : {-2, -1, 1, 2}) {
      const int64_t other = int64_t{at} + d;
      if (other >= 0 && other < n && same_region(curve[static_cast<size_t>(other)], curve[at]))
        graph_.adjacent.push_back(id_of(curve[static_cast<size_t>(other)]));
    }
    graph_.start.push_back(static_cast<uint32_t>(graph_.adjacent.size()));
  }
  drop_isolated();  // the last vertex of a region
}

// A maximal independent set of low degree, short edges and low degrees first.
void Contraction::select_removed() {
  constexpr uint32_t buckets = 32 * 16;
  const auto n = static_cast<uint32_t>(active_.size());
  uint32_t count[buckets + 1] = {};
  Vector<uint32_t>& key = renumbered_;
  key.resize(n);
  visit_.resize(n);
  for (uint32_t v = 0; v < n; ++v) {
    uint32_t shortest = UINT32_MAX;
    for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u)
      shortest = std::min(shortest, squared_distance(active_[*u], active_[v]));
    key[v] = floor_log2(shortest) * 16 + std::min(graph_.degree(v), 15u);
    ++count[key[v] + 1];
  }
  for (uint32_t b = 0; b < buckets; ++b)
    count[b + 1] += count[b];
  for (uint32_t v = 0; v < n; ++v)
    visit_[count[key[v]]++] = v;
  state_.assign(n, kKept);
  for (const uint32_t v : visit_) {
    if (state_[v] != kKept || graph_.degree(v) > kMaxRemovedDegree)
      continue;
    state_[v] = kRemoved;
    for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u)
      state_[*u] = kLocked;
  }
  removed_.clear();
  for (uint32_t v = 0; v < n; ++v)
    if (state_[v] == kRemoved)
      removed_.push_back(v);
}

// G' = G with every removed vertex merged into its nearest neighbour.
void Contraction::contract() {
  const auto n = static_cast<uint32_t>(active_.size());
  constexpr uint32_t none = UINT32_MAX;
  target_.resize(n);
  merged_.assign(n, none);
  merged_next_.resize(n);
  renumbered_.resize(n);
  next_active_.clear();
  for (uint32_t v = 0; v < n; ++v)
    if (state_[v] != kRemoved) {
      renumbered_[v] = static_cast<uint32_t>(next_active_.size());
      next_active_.push_back(active_[v]);
    }
  for (const uint32_t v : removed_) {
    uint64_t best = UINT64_MAX;
    uint32_t target = none;
    for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u) {
      const uint64_t d = nearness(active_[*u], active_[v]);
      if (d < best) {
        best = d;
        target = *u;
      }
    }
    renumbered_[v] = renumbered_[target];
    merged_next_[v] = merged_[target];
    merged_[target] = v;
  }
  next_.start.clear();
  next_.start.push_back(0);
  next_.adjacent.resize(graph_.adjacent.size());
  Vector<uint32_t>& stamp = stamps_[0].last;
  uint32_t size = 0;
  for (uint32_t v = 0; v < n; ++v) {
    if (state_[v] == kRemoved)
      continue;
    const uint32_t tick = ++stamps_[0].tick;
    stamp[renumbered_[v]] = tick;
    const auto add_ring = [&](uint32_t w) {
      for (const uint32_t* u = graph_.begin(w); u != graph_.end(w); ++u) {
        const uint32_t x = renumbered_[*u];
        next_.adjacent[size] = x;
        size += stamp[x] != tick;
        stamp[x] = tick;
      }
    };
    add_ring(v);
    for (uint32_t w = merged_[v]; w != none; w = merged_next_[w])
      add_ring(w);
    next_.start.push_back(size);
  }
  next_.adjacent.resize(size);
}

// Removed vertices that share a neighbour get different colours as far as there are colours.
void Contraction::colour() {
  if (colours_ == 1)
    return;
  constexpr uint8_t none = 255;
  colour_.assign(active_.size(), none);
  for (const uint32_t v : removed_) {
    uint32_t used = 0;
    for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u) {
      if (graph_.degree(*u) > kMaxRingDegree)
        continue;
      stamps_[0].visits += graph_.degree(*u);
      for (const uint32_t* w = graph_.begin(*u); w != graph_.end(*u); ++w)
        if (colour_[*w] != none)
          used |= 1u << colour_[*w];
    }
    int c = 0;
    while (c < colours_ - 1 && (used >> c & 1))
      ++c;
    colour_[v] = static_cast<uint8_t>(c);
  }
}

// Removed vertices of lower colour around v: they are decoded earlier.
void Contraction::add_same_level(uint32_t v, NearestCandidates& nearest, Stamps& stamps) {
  const uint32_t tick = ++stamps.tick;
  for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u) {
    if (graph_.degree(*u) > kMaxRingDegree)
      continue;
    stamps.visits += graph_.degree(*u);
    for (const uint32_t* w = graph_.begin(*u); w != graph_.end(*u); ++w) {
      if (colour_[*w] < colour_[v] && stamps.last[*w] != tick) {
        stamps.last[*w] = tick;
        nearest.add(active_[*w], active_[v]);
      }
    }
  }
}

void Contraction::find_neighbours() {
  const size_t count = removed_.size();
  const size_t grain = teams_ == 1 || count < kShared ? count : (count + teams_ - 1) / teams_;
  for_ranges(threads_, count, std::max<size_t>(grain, 1), [&](size_t first, size_t last) {
    find_neighbours(first, last, stamps_[first / std::max<size_t>(grain, 1)]);
  });
}

void Contraction::find_neighbours(size_t first, size_t last, Stamps& stamps) {
  // Local copies: stores through candidates must not force reloads of the members.
  uint32_t candidates[kMaxCandidates + 1];  // local to G'
  uint32_t* const stamp = stamps.last.data();
  const GridVertex* const kept = next_active_.data();
  const auto m = static_cast<size_t>(m_);
  NearestCandidates nearest;
  for (size_t i = first; i < last; ++i) {
    const uint32_t v = removed_[i];
    const GridVertex self = active_[v];
    const uint32_t tick = ++stamps.tick;
    size_t count = 0;
    for (const uint32_t* u = graph_.begin(v); u != graph_.end(v); ++u) {
      const uint32_t w = renumbered_[*u];
      stamp[w] = tick;
      candidates[count++] = w;
    }
    const auto add_rings = [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        const uint32_t u = candidates[c];
        if (next_.degree(u) > kMaxRingDegree)
          continue;
        for (const uint32_t *w = next_.begin(u), *stop = next_.end(u); w != stop; ++w) {
          candidates[count] = *w;
          count += stamp[*w] != tick;  // without a branch: nothing to predict here
          stamp[*w] = tick;
        }
      }
    };
    const size_t ring1 = count;
    add_rings(0, ring1);
    if (count <= m)
      add_rings(ring1, count);
    stamps.visits += count;
    nearest.clear();
    for (size_t c = 0; c < count; ++c)
      nearest.add(kept[candidates[c]], self);
    if (colours_ > 1 && colour_[v] > 0)
      add_same_level(v, nearest, stamps);
    nearest.select(m, neighbours_.data() + rank_[self.id] * m);
  }
}

// Finest level first, highest colour first: write() reverses both.
void Contraction::append_level() {
  for (int c = colours_ - 1; c >= 0; --c) {
    const size_t before = removal_.size();
    for (const uint32_t v : removed_)
      if (colours_ == 1 || colour_[v] == c)
        removal_.push_back(active_[v].id);
    if (removal_.size() > before)
      end_level(before);
  }
}

/// The vertices of removal_ from `first` on are a level: all that are left have lower ranks.
void Contraction::end_level(size_t first) {
  const size_t end = removal_.size();
  level_end_.push_back(static_cast<uint32_t>(end));
  for (size_t i = first; i < end; ++i)
    rank_[removal_[i]] = static_cast<uint32_t>(nodes_.size() - end + (i - first));
}

void Contraction::advance() {
  std::swap(graph_, next_);
  std::swap(active_, next_active_);
}

void Contraction::run() {
  active_ = nodes_;
  while (true) {
    drop_isolated();
    for (size_t t = 0; t < teams_; ++t) {
      if (stamps_[t].tick > UINT32_MAX / 4) {  // a level takes at most three per vertex
        std::fill(stamps_[t].last.begin(), stamps_[t].last.end(), 0);
        stamps_[t].tick = 0;
      }
    }
    if (active_.empty()) {
      link_all();
      if (active_.empty())
        break;
    } else if (is_dense_ || is_dense(graph_.adjacent.size(), active_.size())) {
      link_all();
    }
    is_dense_ = false;
    select_removed();
    if (removed_.size() * kMinRemovedFraction < active_.size()) {
      link_all();
      select_removed();
    }
    contract();
    stamps_[0].visits += active_.size() + graph_.adjacent.size();
    colour();
    append_level();
    find_neighbours();
    advance();
  }
  // One vertex of each region is left.
  const size_t first = removal_.size();
  removal_.insert(removal_.end(), isolated_.begin(), isolated_.end());
  if (!isolated_.empty())
    end_level(first);
}

void Contraction::write(VertexOrder* out) {
  const size_t n = nodes_.size();
  out->neighbour_count = m_;
  out->order.clear();
  out->order.reserve(n);
  out->level_start.assign(1, 0);
  for (size_t l = level_end_.size(); l-- > 0;) {
    const uint32_t first = l ? level_end_[l - 1] : 0;
    out->order.insert(out->order.end(), removal_.data() + first, removal_.data() + level_end_[l]);
    out->level_start.push_back(static_cast<uint32_t>(out->order.size()));
  }
  for (int32_t& neighbour : neighbours_) {
    if (neighbour >= 0)
      neighbour = static_cast<int32_t>(rank_[static_cast<size_t>(neighbour)]);
  }
  out->neighbours = std::move(neighbours_);
}

Status make_order(MeshGraph graph, const int32_t* positions, int neighbours, int colours,
                  const uint8_t* regions, VertexOrder* out, uint64_t* visits,
                  const HostThreads& threads = {}) {
  if (neighbours < 1 || neighbours > kMaxNeighbours || colours < 1 || colours > kMaxColours)
    return Status::kArgument;
  for (size_t i = 0; i < 3 * graph.vertex_count(); ++i)
    if (positions[i] > kMaxReferenceCoordinate || positions[i] < -kMaxReferenceCoordinate)
      return Status::kQuantizer;
  Contraction contraction(std::move(graph), neighbours, colours, regions, threads);
  contraction.set_grid(positions);
  contraction.run();
  contraction.write(out);
  *visits = contraction.visits();
  return Status::kOk;
}

}  // namespace

Status make_vertex_order(MeshGraph graph, const int32_t* positions, int neighbours, int colours,
                         VertexOrder* out, const uint8_t* regions, const HostThreads& threads) {
  uint64_t visits = 0;
  return make_order(std::move(graph), positions, neighbours, colours, regions, out, &visits,
                    threads);
}

Status make_vertex_order(const uint32_t* triangles, size_t triangle_count, const int32_t* positions,
                         size_t vertex_count, int neighbours, int colours, VertexOrder* out) {
  uint64_t visits = 0;
  return make_counted_vertex_order(triangles, triangle_count, positions, vertex_count, neighbours,
                                   colours, out, &visits);
}

Status make_counted_vertex_order(const uint32_t* triangles, size_t triangle_count,
                                 const int32_t* positions, size_t vertex_count, int neighbours,
                                 int colours, VertexOrder* out, uint64_t* visits) {
  MeshGraph graph;
  if (Status s = graph.init(triangles, triangle_count, vertex_count); s != Status::kOk)
    return s;
  return make_order(std::move(graph), positions, neighbours, colours, nullptr, out, visits);
}

}  // namespace anicodec
