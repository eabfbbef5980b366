// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/segment/keep_frames.h"

#include <algorithm>
#include <utility>

namespace anicodec {
namespace {

/// Elements begin .. begin + count - 1 of an array that has some, in memory of their own.
template <class T>
void keep(size_t begin, size_t count, Vector<T>* all) {
  if (!all->empty())
    *all = Vector<T>(all->begin() + static_cast<ptrdiff_t>(begin),
                     all->begin() + static_cast<ptrdiff_t>(begin + count));
}

void keep_corrections(uint32_t first, uint32_t count, Segment* s) {
  if (s->correction_begin.empty())
    return;
  const uint32_t begin = s->correction_begin[first], end = s->correction_begin[first + count];
  keep(begin, end - begin, &s->corrections);
  keep(first, size_t{count} + 1, &s->correction_begin);
  for (uint32_t& at : s->correction_begin)
    at -= begin;
}

/// Components of a block follow one another: those that are used move to the front.
template <class T>
void keep_components(const Vector<uint32_t>& used, uint32_t components, uint32_t channels,
                     uint32_t blocks, Vector<T>* coefficients) {
  const size_t width = size_t{channels} * kBlock;
  Vector<T> kept(blocks * used.size() * width);
  auto to = kept.begin();
  for (size_t b = 0; b < blocks; ++b) {
    for (uint32_t j : used)
      to = std::copy_n(coefficients->begin() + static_cast<ptrdiff_t>((b * components + j) * width),
                       width, to);
  }
  *coefficients = std::move(kept);
}

bool rests(const Segment& s, uint32_t component) {
  const size_t channels = s.weight_channels(), row = s.components * channels;
  const size_t rows = size_t{s.frames} * s.regions;
  for (size_t i = 0; i < rows; ++i) {
    for (size_t c = 0; c < channels; ++c) {
      if (s.weights[i * row + component * channels + c] != 0)
        return false;
    }
  }
  return true;
}

void drop_resting_components(Segment* s) {
  Vector<uint32_t> used, wide, narrow;
  for (uint32_t j = 0; j < s->components; ++j) {
    if (rests(*s, j))
      continue;
    used.push_back(j);
    if (j < s->wide_components)
      wide.push_back(j);
    else
      narrow.push_back(j - s->wide_components);
  }
  if (used.size() == s->components)
    return;
  const uint32_t blocks = block_count(s->vertices);
  keep_components(wide, s->wide_components, s->channels(), blocks, &s->wide);
  keep_components(narrow, s->components - s->wide_components, s->channels(), blocks, &s->narrow);
  const size_t channels = s->weight_channels();
  Vector<float> weights;
  const size_t rows = size_t{s->frames} * s->regions;
  weights.reserve(rows * used.size() * channels);
  for (size_t i = 0; i < rows; ++i) {
    for (uint32_t j : used) {
      const auto from =
          s->weights.begin() + static_cast<ptrdiff_t>((i * s->components + j) * channels);
      weights.insert(weights.end(), from, from + static_cast<ptrdiff_t>(channels));
    }
  }
  s->weights = std::move(weights);
  s->components = static_cast<uint32_t>(used.size());
  s->wide_components = static_cast<uint32_t>(wide.size());
}

}  // namespace

void keep_frames(uint32_t first, uint32_t count, Segment* segment) {
  Segment& s = *segment;
  const size_t row = size_t{s.regions} * s.components * s.weight_channels();
  keep(first * row, count * row, &s.weights);
  keep(size_t{first} * s.regions, size_t{count} * s.regions, &s.pose_maps);
  keep(first, count, &s.motions);
  keep_corrections(first, count, &s);
  if (!s.exact.empty()) {
    const size_t frame = s.exact.size() / s.frames;
    keep(first * frame, count * frame, &s.exact);
  }
  s.first_frame += first;
  s.frames = count;
  if (s.kind != BasisKind::kKeyframes)
    drop_resting_components(&s);
}

}  // namespace anicodec
