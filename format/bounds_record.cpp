// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "format/bounds_record.h"

#include "format/record_fields.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

constexpr double kSteps = 255;

uint32_t box_count(uint32_t frames, uint32_t every) {
  return every == 0 ? 0 : (frames - 1) / every + 1;
}

Box around(const Box& a, const Box& b) {
  Box out;
  for (size_t c = 0; c < 3; ++c) {
    out.low[c] = std::min(a.low[c], b.low[c]);
    out.high[c] = std::max(a.high[c], b.high[c]);
  }
  return out;
}

/// A side of a box, `steps` away from that of the box around all.
float side(float from, float to, uint8_t steps) {
  const double a = static_cast<double>(from), b = static_cast<double>(to);
  return static_cast<float>(a + (b - a) * (steps / kSteps));
}

}  // namespace

Box BoundsRecord::of_frame(uint32_t frame) const {
  if (every == 0)
    return all;
  const auto& box = boxes[frame / every];
  Box out;
  for (size_t c = 0; c < 3; ++c) {
    out.low[c] = side(all.low[c], all.high[c], box[c]);
    out.high[c] = side(all.high[c], all.low[c], box[3 + c]);
  }
  return out;
}

void BoundsRecord::set(const Vector<Box>& frames, uint32_t shared) {
  const auto count = static_cast<uint32_t>(frames.size());
  all = frames[0];
  for (const Box& box : frames)
    all = around(all, box);
  every = shared < count ? shared : 0;
  boxes.clear();
  for (uint32_t first = 0; every > 0 && first < count; first += every) {
    Box run = frames[first];
    for (uint32_t f = first + 1; f < std::min(count, first + every); ++f)
      run = around(run, frames[f]);
    std::array<uint8_t, 6> steps = {};
    for (size_t c = 0; c < 3; ++c) {
      // The most steps that leave the box outside.
      while (steps[c] < 255 &&
             side(all.low[c], all.high[c], static_cast<uint8_t>(steps[c] + 1)) <= run.low[c])
        ++steps[c];
      uint8_t& high = steps[3 + c];
      while (high < 255 &&
             side(all.high[c], all.low[c], static_cast<uint8_t>(high + 1)) >= run.high[c])
        ++high;
    }
    boxes.push_back(steps);
  }
}

BoundsRecord BoundsRecord::unmeasured(uint32_t frames, uint32_t shared) {
  BoundsRecord record;
  record.every = shared < frames ? shared : 0;
  record.boxes.resize(box_count(frames, record.every));
  return record;
}

Bytes BoundsRecord::write() const {
  ByteWriter w;
  w.varint(every);
  for (float x : all.low)
    w.f32(x);
  for (float x : all.high)
    w.f32(x);
  for (const auto& box : boxes)
    w.raw({box.data(), box.size()});
  return std::move(w.bytes());
}

Status BoundsRecord::read(ByteView view, uint32_t frames, BoundsRecord* out) {
  ByteReader r(view);
  out->every = r.varint32(frames);
  bool valid = true;
  for (float& x : out->all.low)
    x = r.f32();
  for (float& x : out->all.high)
    x = r.f32();
  for (size_t c = 0; c < 3; ++c)
    valid &= std::isfinite(out->all.low[c]) && std::isfinite(out->all.high[c]) &&
             out->all.low[c] <= out->all.high[c];
  const uint32_t count = box_count(frames, out->every);
  if (!r.ok() || !valid || r.remaining() / 6 < count)
    return Status::kRecord;
  out->boxes.resize(count);
  for (auto& box : out->boxes) {
    const ByteView steps = r.raw(box.size());
    std::copy_n(steps.data, box.size(), box.begin());
  }
  return skip_fields(r) ? Status::kOk : Status::kRecord;
}

}  // namespace anicodec
