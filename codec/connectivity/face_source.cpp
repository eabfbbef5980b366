// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/connectivity/face_source.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace anicodec {

FaceSource::FaceSource(const Polygons& polygons, const Weld& weld)
    : polygons_(polygons), weld_(weld) {
  gather_faces();
  index_sides();
}

void FaceSource::begin(SeedOrder order) {
  done_.assign(offsets_.size() - 1, false);
  for (SideItem& side : sides_)
    side.next = 0;
  order_seeds(order);
  seed_ = 0;
  number_.assign(weld_.representative.size(), kNone);
  copy_of_.assign(weld_.welded.size(), kNone);
  coded_welded_.clear();
  places_.clear();
  place_corners_.assign(1, 0);
  corner_vertices_.clear();
  spare_.clear();
  canonical_.clear();
}

void FaceSource::order_seeds(SeedOrder order) {
  const auto count = static_cast<uint32_t>(done_.size());
  seeds_.clear();
  for (uint32_t f = 0; f < count; ++f)
    seeds_.push_back({f, 0});
  if (order == SeedOrder::kMiddle)
    std::rotate(seeds_.begin(), seeds_.begin() + count / 2, seeds_.end());
  if (order != SeedOrder::kFullest)
    return;
  const auto faces_at = [&](const Seed& s) {
    const uint32_t v = corners_[offsets_[s.face] + s.start];
    return side_begin_[v + 1] - side_begin_[v];
  };
  for (Seed& seed : seeds_) {
    for (uint32_t k = 1; k < size_of(seed.face); ++k) {
      if (faces_at({seed.face, k}) > faces_at(seed))
        seed.start = k;
    }
  }
  std::ranges::stable_sort(seeds_,
                           [&](const Seed& a, const Seed& b) { return faces_at(a) > faces_at(b); });
}

void FaceSource::gather_faces() {
  // Each polygon's welded vertices from the smallest on: equal for the same face.
  std::vector<uint32_t> turned, begin(polygons_.size() + 1, 0), sorted;
  std::vector<uint32_t> order;
  turned.reserve(polygons_.corners.size());
  for (uint32_t p = 0; p < polygons_.size(); ++p) {
    for (const uint32_t v : polygons_[p])
      turned.push_back(weld_.welded[v]);
    begin[p + 1] = static_cast<uint32_t>(turned.size());
    const auto from = turned.begin() + begin[p];
    sorted.assign(from, turned.end());
    std::ranges::sort(sorted);
    if (sorted.size() < 3 || std::ranges::adjacent_find(sorted) != sorted.end()) {
      apart_.push_back(p);
      continue;
    }
    std::rotate(from, std::min_element(from, turned.end()), turned.end());
    order.push_back(p);
  }
  const auto key = [&](uint32_t p) {
    return std::span(turned).subspan(begin[p], begin[p + 1] - begin[p]);
  };
  std::ranges::sort(order, [&](uint32_t p, uint32_t q) {
    const auto x = key(p), y = key(q);
    const auto three_way =
        std::lexicographical_compare_three_way(x.begin(), x.end(), y.begin(), y.end());
    return three_way != 0 ? three_way < 0 : p < q;
  });
  // Faces come in the order of their first polygons.
  std::vector<uint32_t> first_of(polygons_.size(), kNone), next_of(polygons_.size(), kNone);
  for (size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && std::ranges::equal(key(order[i - 1]), key(order[i]));
    first_of[order[i]] = again ? first_of[order[i - 1]] : order[i];
    if (again)
      next_of[order[i - 1]] = order[i];
    has_repeats_ |= again;
  }
  for (uint32_t p = 0; p < polygons_.size(); ++p) {
    if (first_of[p] != p)
      continue;
    for (const uint32_t v : polygons_[p])
      corners_.push_back(weld_.welded[v]);
    corner_face_.resize(corners_.size(), static_cast<uint32_t>(offsets_.size() - 1));
    offsets_.push_back(static_cast<uint32_t>(corners_.size()));
    triangles_ += static_cast<uint32_t>(polygons_[p].size()) - 2;
    for (uint32_t q = p; q != kNone; q = next_of[q])
      instances_.push_back(q);
    instance_end_.push_back(static_cast<uint32_t>(instances_.size()));
  }
}

void FaceSource::index_sides() {
  side_begin_.assign(weld_.representative.size() + 1, 0);
  for (const uint32_t v : corners_)
    ++side_begin_[v + 1];
  std::partial_sum(side_begin_.begin(), side_begin_.end(), side_begin_.begin());
  std::vector<uint32_t> end(side_begin_.begin(), side_begin_.end() - 1);
  sides_.resize(corners_.size());
  for (uint32_t c = 0; c < corners_.size(); ++c) {
    const uint32_t face = corner_face_[c];
    const uint32_t after = c + 1 < offsets_[face + 1] ? c + 1 : offsets_[face];
    sides_[end[corners_[c]]++] = {corners_[after], c, 0};
  }
  for (size_t v = 0; v + 1 < side_begin_.size(); ++v)
    std::sort(sides_.begin() + side_begin_[v], sides_.begin() + side_begin_[v + 1],
              [](const SideItem& x, const SideItem& y) {
                return x.to != y.to ? x.to < y.to : x.corner < y.corner;
              });
}

bool FaceSource::find(uint32_t a, uint32_t b) {
  const uint32_t from = coded_welded_[a], to = coded_welded_[b];
  const auto begin = sides_.begin() + side_begin_[from];
  const auto end = sides_.begin() + side_begin_[from + 1];
  const auto first =
      std::lower_bound(begin, end, to, [](const SideItem& s, uint32_t v) { return s.to < v; });
  if (first == end)
    return false;
  auto side = first + first->next;
  while (side != end && side->to == to && done_[corner_face_[side->corner]])
    ++side;
  first->next = static_cast<uint32_t>(side - first);
  if (side == end || side->to != to)
    return false;
  face_ = corner_face_[side->corner];
  start_ = side->corner - offsets_[face_];
  return true;
}

void FaceSource::find_seed() {
  while (done_[seeds_[seed_].face])
    ++seed_;
  face_ = seeds_[seed_].face;
  start_ = seeds_[seed_].start;
}

void FaceSource::set_vertex(uint32_t k, uint32_t number) {
  number_[welded_at(k)] = number;
  coded_welded_.push_back(welded_at(k));
}

uint32_t FaceSource::finish() {
  done_[face_] = true;
  const uint32_t n = corners(), lead = welded_at(0);
  const uint32_t begin = face_ == 0 ? 0 : instance_end_[face_ - 1], end = instance_end_[face_];
  for (uint32_t i = begin; i < end; ++i) {
    const auto polygon = polygons_[instances_[i]];
    uint32_t turn = 0;  // the polygon's corner that comes first here
    while (weld_.welded[polygon[turn]] != lead)
      ++turn;
    for (uint32_t k = 0; k < n; ++k)
      corner_vertices_.push_back(polygon[(turn + k) % n]);
    places_.push_back({instances_[i], (n - turn) % n});
    place_corners_.push_back(static_cast<uint32_t>(corner_vertices_.size()));
  }
  return end - begin - 1;
}

bool FaceSource::repeats_copies(uint32_t polygon) const {
  const auto begin = corner_vertices_.begin() + place_corners_[polygon];
  const auto end = corner_vertices_.begin() + place_corners_[polygon + 1];
  return std::equal(begin, end, begin - (end - begin));
}

void FaceSource::set_copy(uint32_t corner, uint32_t copy) {
  copy_of_[corner_vertices_[corner]] = copy;
}

uint32_t FaceSource::spare_copy(uint32_t i) {
  complete();
  return spare_[i];
}

const std::vector<uint32_t>& FaceSource::canonical() {
  complete();
  return canonical_;
}

const std::vector<uint32_t>& FaceSource::coded_welded() {
  complete();
  return coded_welded_;
}

std::vector<FaceSource::PolygonPlace> FaceSource::polygon_places() const {
  std::vector<PolygonPlace> places = places_;
  for (const uint32_t p : apart_)
    places.push_back({p, 0});
  return places;
}

/// Numbers welded vertices that no face of the walk uses, and copies that none does.
void FaceSource::complete() {
  if (!canonical_.empty())
    return;
  const size_t walked = coded_welded_.size();
  for (uint32_t w = 0; w < number_.size(); ++w) {
    if (number_[w] == kNone) {
      number_[w] = static_cast<uint32_t>(coded_welded_.size());
      coded_welded_.push_back(w);
    }
  }
  std::vector<uint32_t> used(number_.size(), 0), coded(copy_of_.size());
  for (size_t v = 0; v < coded.size(); ++v) {
    coded[v] = number_[weld_.welded[v]];
    if (copy_of_[v] != kNone)
      ++used[coded[v]];
  }
  // Coded vertices that are not welded have their copy without being asked for it.
  const bool welded = copy_of_.size() != number_.size();
  for (size_t v = 0; v < coded.size(); ++v) {
    if (copy_of_[v] != kNone)
      continue;
    copy_of_[v] = used[coded[v]]++;
    if (welded && (coded[v] < walked || copy_of_[v] > 0))
      spare_.push_back(coded[v]);
  }
  std::ranges::sort(spare_);
  std::vector<uint32_t> first(used.size());
  std::exclusive_scan(used.begin(), used.end(), first.begin(), 0U);
  canonical_.resize(coded.size());
  for (size_t v = 0; v < coded.size(); ++v)
    canonical_[v] = first[coded[v]] + copy_of_[v];
}

}  // namespace anicodec
