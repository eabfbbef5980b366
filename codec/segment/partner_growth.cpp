// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/segment/partner_growth.h"

#include <algorithm>
#include <cmath>

namespace anicodec {

bool PartnerGrowth::grow(const Triple& from, const Triple& to, const Rules& rules) {
  // Steps for each vertex, and in all: `anicodec_bench pose` finds the same partners with them on face, dance, horse and flag.
  constexpr size_t kMostWasted = 32, kFreeWaste = 4096;
  clear();
  if (wasted_ > kMostWasted * map_.size() + kFreeWaste)
    return false;
  rules_ = rules;
  steps_ = 0;
  const bool worth = grow_from(from, to);
  wasted_ += worth ? 0 : steps_;
  return worth;
}

bool PartnerGrowth::grow_from(const Triple& from, const Triple& to) {
  constexpr uint32_t kTrial = 24;
  constexpr double kLeastGain = 3, kWorth = 40;  // bits, a vertex and in all
  for (size_t i = 0; i < 3; ++i) {
    if (map_[from[i]] == to[i])
      continue;
    if (!free(from[i], to[i]))
      return false;
    put(from[i], to[i]);
  }
  for (size_t i = 0; i < 3; ++i)
    push_gates(from[i]);
  uint32_t tries = 0;
  double gain = 0;
  while (!queue_.empty()) {
    const Step step = queue_.top();
    queue_.pop();
    if (map_[step.v] != kNone)
      continue;
    if (!free(step.v, step.image)) {
      push(step.corner);
      continue;
    }
    ++tries;
    gain += step.gain;
    put(step.v, step.image);
    push_gates(step.v);
    if (rules_.symmetric && step.image != step.v)
      push_gates(step.image);
    if (tries >= kTrial && gain < kLeastGain * tries)
      return false;
  }
  return gain > kWorth + kLeastGain * tries;
}

void PartnerGrowth::clear() {
  for (const uint32_t v : sources_) {
    inverse_[map_[v]] = kNone;
    map_[v] = kNone;
  }
  sources_.clear();
  queue_ = {};
}

bool PartnerGrowth::free(uint32_t v, uint32_t u) const {
  if (map_[v] != kNone || (*rules_.taken)[v] != kNone)
    return false;
  if (rules_.symmetric)
    return map_[u] == kNone && (*rules_.taken)[u] == kNone && (u != v || rules_.mirrored);
  return inverse_[u] == kNone && (*rules_.part)[u] == rules_.part_of_images && u != v;
}

void PartnerGrowth::put(uint32_t v, uint32_t u) {
  map_[v] = u;
  inverse_[u] = v;
  sources_.push_back(v);
  if (rules_.symmetric && u != v) {
    map_[u] = v;
    inverse_[v] = u;
    sources_.push_back(u);
  }
}

/// Gates that have become known with v, whose vertices beyond are not.
void PartnerGrowth::push_gates(uint32_t v) {
  const CornerTable& table = surface_.table;
  const uint32_t corners = std::min(table.valence(v), PartnerSurface::kMostTriangles);
  for (uint32_t i = 0; i < corners; ++i) {
    const uint32_t c = table.corner(v, i), n = next_corner(c), p = previous_corner(c);
    if (map_[table.vertex(n)] == kNone || map_[table.vertex(p)] == kNone)
      continue;
    push(c);
    push(n);
    push(p);
  }
}

/// Looks for the image of the vertex beyond the edge that faces a corner.
void PartnerGrowth::push(uint32_t corner) {
  ++steps_;
  constexpr double kSlack = 0.1;  // of an edge: how far from where it is expected a partner may be
  const CornerTable& table = surface_.table;
  const uint32_t beyond = table.opposite(corner);
  if (beyond == CornerTable::kNone)
    return;
  const uint32_t v = table.vertex(beyond);
  if (map_[v] != kNone || (*rules_.taken)[v] != kNone)
    return;
  const uint32_t a = table.vertex(next_corner(corner)), b = table.vertex(previous_corner(corner)),
                 o = table.vertex(corner);
  const uint32_t x = map_[a], y = map_[b], z = map_[o];
  Eigen::Vector3d off;
  if (!turned_offset(surface_, {a, b, o}, v, {x, y, z}, rules_.mirrored, &off))
    return;
  const Eigen::Vector3d expected = surface_[x] + surface_[y] - surface_[z] + off;
  uint32_t best = kNone;
  double least = 0;
  for (const uint32_t w : {x, y}) {
    surface_.neighbours(w, [&](uint32_t u) {
      const double d = (surface_[u] - expected).squaredNorm();
      if ((best == kNone || d < least) && u != best && free(v, u)) {
        best = u;
        least = d;
      }
    });
  }
  if (best == kNone)
    return;
  const double edge =
      0.5 * ((surface_[v] - surface_[a]).norm() + (surface_[v] - surface_[b]).norm());
  const double error = std::sqrt(least), alone = off.norm();
  if (!(error <= kSlack * edge))
    return;
  queue_.push({error / edge, 3 * partner_gain(alone, error, edge), corner, v, best});
}

}  // namespace anicodec
