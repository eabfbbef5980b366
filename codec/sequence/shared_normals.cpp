// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/shared_normals.h"

#include "codec/sequence/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace anicodec {

std::vector<uint32_t> rows_of_corners(const Polygons& polygons, AttributeDomain domain) {
  std::vector<uint32_t> rows = polygons.corners;
  if (domain == AttributeDomain::kCorner)
    std::iota(rows.begin(), rows.end(), 0U);
  if (domain == AttributeDomain::kPolygon) {
    for (uint32_t p = 0; p < polygons.size(); ++p)
      std::fill(rows.begin() + polygons.offsets[p], rows.begin() + polygons.offsets[p + 1], p);
  }
  return rows;
}

std::vector<uint32_t> share_normals(const Attribute& normals, std::span<const uint32_t> rows,
                                    std::span<const uint32_t> places, uint32_t place_count) {
  constexpr uint32_t kComponents = 3;
  constexpr uint32_t kNone = UINT32_MAX;
  const double kSame = std::cos(0.5 * std::numbers::pi / 180);
  if (normals.components != kComponents)
    throw Error(ErrorKind::kInput, normals.name + ": normals have three components");
  auto same = [&](uint32_t a, uint32_t b) {
    const float* n = normals.values.data() + size_t{kComponents} * rows[a];
    const float* m = normals.values.data() + size_t{kComponents} * rows[b];
    double ab = 0, aa = 0, bb = 0;
    for (uint32_t i = 0; i < kComponents; ++i) {
      const auto x = static_cast<double>(n[i]), y = static_cast<double>(m[i]);
      ab += x * y, aa += x * x, bb += y * y;
    }
    return ab >= kSame * std::sqrt(aa * bb);
  };
  std::vector<uint32_t> shared(rows.size()), newest(place_count, kNone), older(rows.size(), kNone);
  for (uint32_t c = 0; c < rows.size(); ++c) {
    uint32_t& first = newest[places[c]];
    uint32_t other = first;
    while (other != kNone && !same(c, other))
      other = older[other];
    shared[c] = other == kNone ? c : shared[other];
    if (other == kNone) {
      older[c] = first;
      first = c;
    }
  }
  return shared;
}

std::vector<uint32_t> known_shared_normals(const MeshSequence& sequence,
                                           const std::vector<bool>& flat) {
  const auto normals =
      std::ranges::find(sequence.attributes, AttributeKind::kNormal, &Attribute::kind);
  if (!sequence.shared_normals.empty() || (normals == sequence.attributes.end() && flat.empty()))
    return sequence.shared_normals;
  const std::vector<uint32_t>& corners = sequence.polygons.corners;
  if (normals == sequence.attributes.end()) {  // no two corners share one
    std::vector<uint32_t> own(corners.size());
    std::iota(own.begin(), own.end(), 0U);
    return own;
  }
  const std::vector<uint32_t> rows = rows_of_corners(sequence.polygons, normals->domain);
  std::vector<uint32_t> places = corners;
  if (!sequence.positions.empty()) {
    std::map<std::array<float, 3>, uint32_t> first;
    for (uint32_t& place : places) {
      const float* at = sequence.positions.data() + size_t{3} * place;
      place = first.try_emplace({at[0], at[1], at[2]}, place).first->second;
    }
  }
  uint32_t place_count = sequence.vertex_count;
  for (size_t p = 0; p < flat.size(); ++p) {
    for (uint32_t c = sequence.polygons.offsets[p]; flat[p] && c < sequence.polygons.offsets[p + 1];
         ++c)
      places[c] = place_count++;
  }
  return share_normals(*normals, rows, places, place_count);
}

}  // namespace anicodec
