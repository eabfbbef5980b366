// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/vertex_walk.h"

#include "format/sort.h"

#include <tuple>

namespace anicodec {
namespace {

/// 1, 2, 3, 4-5, 6-9, 10-17, 18-65, more.
uint8_t nearness_of(uint32_t distance) {
  if (distance <= 3)
    return static_cast<uint8_t>(distance - 1);
  constexpr uint32_t kEnds[] = {5, 9, 17, 65};
  uint8_t nearness = 3;
  for (uint32_t end : kEnds)
    nearness = static_cast<uint8_t>(nearness + (distance > end));
  return nearness;
}

}  // namespace

VertexWalk::VertexWalk(const Topology& topology)
    : vertex_coded_(topology.vertex_coded),
      offsets_(topology.polygon_offsets),
      first_(topology.vertex_coded.size() + 1),
      first_face_(topology.vertex_coded.size() + 1, 0),
      faces_(topology.polygon_corners.size()),
      polygons_(topology.polygon_offsets.empty() ? 0 : topology.polygon_offsets.size() - 1),
      place_(topology.vertex_coded.size(), kNotYet),
      offered_(topology.vertex_coded.size(), kNotYet) {
  const Vector<uint32_t>&offsets = topology.polygon_offsets, &corners = topology.polygon_corners;
  // Both ends of each side of a polygon, and the vertex at the other one.
  auto each_pair = [&](auto&& take) {
    for (size_t p = 0; p + 1 < offsets.size(); ++p) {
      for (uint32_t c = offsets[p]; c < offsets[p + 1]; ++c) {
        const uint32_t a = corners[c], b = corners[c + 1 < offsets[p + 1] ? c + 1 : offsets[p]];
        if (a == b)
          continue;
        take(a, b);
        take(b, a);
      }
    }
  };
  each_pair([&](uint32_t a, uint32_t) { ++first_[a + 1]; });
  for (size_t v = 1; v < first_.size(); ++v)
    first_[v] += first_[v - 1];
  neighbours_.resize(first_.back());
  each_pair([&](uint32_t a, uint32_t b) { neighbours_[first_[a]++] = b; });  // now the ends
  uint32_t begin = 0, kept = 0;
  for (size_t v = 0; v + 1 < first_.size(); ++v) {
    const uint32_t end = first_[v];
    uint32_t* list = neighbours_.data();
    sort_ascending(list + begin, list + end);
    uint32_t* last = std::unique(list + begin, list + end);
    std::copy(list + begin, last, list + kept);
    first_[v] = kept;
    kept += static_cast<uint32_t>(last - (list + begin));
    begin = end;
  }
  first_.back() = kept;
  for (const uint32_t v : corners)
    ++first_face_[v + 1];
  for (size_t v = 1; v < first_face_.size(); ++v)
    first_face_[v] += first_face_[v - 1];
  Vector<uint32_t> end(first_face_.begin(), first_face_.end() - 1);
  for (uint32_t p = 0; p + 1 < offsets.size(); ++p) {
    for (uint32_t c = offsets[p]; c < offsets[p + 1]; ++c)
      faces_[end[corners[c]]++] = p;
  }
  order_.reserve(vertex_coded_.size());
}

VertexWalk::Range VertexWalk::copies(uint32_t v) const {
  Range copies{v, v + 1};
  while (copies.begin > 0 && v - copies.begin < kMaxCopies &&
         vertex_coded_[copies.begin - 1] == vertex_coded_[v])
    --copies.begin;
  while (copies.end < vertex_coded_.size() && copies.end - v <= kMaxCopies &&
         vertex_coded_[copies.end] == vertex_coded_[v])
    ++copies.end;
  return copies;
}

VertexWalk::Candidate VertexWalk::look_at(uint32_t v) const {
  const auto now = static_cast<uint32_t>(order_.size());
  uint32_t touched = 0, copied = 0, count = 0, free = 0;  // one more than the latest places
  Candidate found{};
  const Range near = neighbours(v);
  for (uint32_t i = near.begin; i < near.end; ++i) {
    const uint32_t place = place_[neighbours_[i]];
    if (place == kNotYet) {
      ++free;
      continue;
    }
    ++count;
    touched = std::max(touched, place + 1);
    if (place + 3 >= now)
      found.beside = static_cast<uint8_t>(found.beside | 1U << (place + 3 - now));
    for (uint32_t k = 0; k < along_count_ && place + 1 < now; ++k) {
      if (place == along_[k] + 1)
        found.parallel = 2;
      else if (place + 1 == along_[k])
        found.parallel = std::max<uint8_t>(found.parallel, 1);
    }
  }
  const Range same = copies(v);
  for (uint32_t i = same.begin; i < same.end; ++i) {
    if (place_[i] != kNotYet)
      copied = std::max(copied, place_[i] + 1);
  }
  const uint32_t faces_end = std::min(first_face_[v + 1], first_face_[v] + kMaxFaces);
  for (uint32_t i = first_face_[v]; i < faces_end; ++i) {
    const uint32_t p = faces_[i];
    const Face& face = polygons_[p];
    found.filled = std::max(found.filled, static_cast<uint8_t>(std::min(face.placed, 4U)));
    found.completes |= face.placed + 1 == offsets_[p + 1] - offsets_[p];
    found.together |= face.latest + 1 == now && face.second + 2 == now;
  }
  found.vertex = v;
  found.distance = now + 1 - std::max(touched, copied);
  found.nearness = nearness_of(found.distance);
  found.copy = copied > touched;
  found.count = static_cast<uint8_t>(std::min(count, 3U));
  found.free = static_cast<uint8_t>(std::min(free, 7U));
  return found;
}

void VertexWalk::select(const Candidate& c, uint32_t rank) {
  const auto now = static_cast<uint32_t>(order_.size());
  const uint32_t last = ways_[0], two = last * kWayCount + ways_[1];
  const uint32_t three = two * kWayCount + ways_[2], tried = std::min(rank, 3U);
  const uint32_t adjacent = c.beside >> 2;
  // By how much the canonical number goes on, and did.
  const auto before = static_cast<int32_t>(order_[now - 1]);
  const int32_t step = static_cast<int32_t>(c.vertex) - before;
  const int32_t step_before = now > 1 ? before - static_cast<int32_t>(order_[now - 2]) : 0;
  const uint32_t forward = step == 1 ? 1 : step < 4 ? 3 : step < 16 ? 4 : 5;
  const uint32_t back = step == -1 ? 2 : step > -4 ? 6 : step > -16 ? 7 : 8;
  const uint32_t going = step > 0 ? forward : back;
  const uint32_t went = step_before == 0    ? 0
                        : step_before == 1  ? 1
                        : step_before == -1 ? 2
                        : step_before > 0   ? 3
                                            : 4;
  const uint32_t close = (((c.nearness * 2U + c.copy) * 3 + c.parallel) * 4 + c.count) * 4 + tried;
  const uint32_t numbers = (going * 5 + went) * 2 + (step == step_before);
  const uint32_t faces = ((c.beside * 2U + c.completes) * 2 + c.together) * 5 + c.filled;
  model_.select({close * kWayCount + last,
                 (((three * 4 + tried) * 8 + c.nearness) * 3 + c.parallel) * 2 + c.copy,
                 (three * 8 + std::min(rank, 7U)) * 3 + c.parallel,
                 (faces * kWayCount + last) * 3 + c.parallel, (numbers * 4 + tried) * 2 + adjacent,
                 (((c.free * 8U + free_before_) * 8 + c.nearness) * 4 + tried) * kWayCount + last,
                 (std::min(rank, 20U) * 21 + std::min(candidate_count_, 20U)) * kWayCount + last},
                (tried * 2 + adjacent) * kWayCount + last,
                step == 1 ? c.nearness : 8U + c.nearness + 8U * c.completes + 16U * c.copy);
}

void VertexWalk::offer(uint32_t v) {
  const auto now = static_cast<uint32_t>(order_.size());
  if (place_[v] != kNotYet || offered_[v] == now || candidate_count_ == kMaxCandidates)
    return;
  offered_[v] = now;
  candidates_[candidate_count_++] = look_at(v);
}

void VertexWalk::offer_neighbours(uint32_t v) {
  const Range beside = neighbours(v);
  for (uint32_t i = beside.begin; i < beside.end; ++i)
    offer(neighbours_[i]);
}

void VertexWalk::start_candidates() {
  candidate_count_ = along_count_ = free_before_ = 0;
  if (order_.empty())
    return;
  const Range beside = neighbours(order_.back());
  for (uint32_t i = beside.begin; i < beside.end; ++i) {
    const uint32_t place = place_[neighbours_[i]];
    if (place != kNotYet)
      along_[along_count_++] = place;
    else
      free_before_ = std::min(free_before_ + 1, 7U);
  }
}

void VertexWalk::find_beside() {
  if (order_.empty())
    return;
  offer_neighbours(order_.back());
  sort_from(0);
}

void VertexWalk::find_others() {
  const auto now = static_cast<uint32_t>(order_.size());
  const uint32_t beside = candidate_count_;
  for (uint32_t k = 0; k < along_count_; ++k) {
    if (along_[k] + 2 < now)
      offer_neighbours(order_[along_[k] + 1]);
    if (along_[k] > 0)
      offer_neighbours(order_[along_[k] - 1]);
  }
  for (uint32_t k = 1; k <= std::min(kWindow, now) && candidate_count_ < kMaxCandidates; ++k) {
    offer_neighbours(order_[now - k]);
    const Range same = copies(order_[now - k]);
    for (uint32_t i = same.begin; i < same.end; ++i)
      offer(i);
  }
  sort_from(beside);
}

void VertexWalk::sort_from(uint32_t first) {
  auto key = [](const Candidate& c) {
    return std::tuple(-c.parallel, c.distance, c.copy, -c.count, c.vertex);
  };
  sort_ascending(candidates_ + first, candidates_ + candidate_count_,
                 [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); });
}

void VertexWalk::append(uint32_t v) {
  const auto now = static_cast<uint32_t>(order_.size());
  place_[v] = now;
  order_.push_back(v);
  for (uint32_t i = first_face_[v]; i < first_face_[v + 1]; ++i) {
    Face& face = polygons_[faces_[i]];
    ++face.placed;
    face.second = face.latest;
    face.latest = now;
  }
}

}  // namespace anicodec
