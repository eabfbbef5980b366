// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/clock.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

/// A time this close to a frame, in parts of the way to the next one, is that frame.
constexpr double kWholeFrame = 1.0 / 1024;

/// x modulo a period, in [0, period).
double modulo(double x, double period) {
  x -= period * std::floor(x / period);
  return x >= 0 && x < period ? x : 0;
}

}  // namespace

void FrameMix::add(uint32_t frame, double weight) {
  for (uint32_t i = 0; i < count; ++i) {
    if (terms[i].frame == frame) {
      terms[i].weight += weight;
      return;
    }
  }
  terms[count++] = {frame, weight};
}

bool FrameMix::blend(const FrameMix& other, double share) {
  if (share == 0)
    return true;
  if (share == 1) {
    *this = other;
    return true;
  }
  FrameMix result = *this;
  for (uint32_t i = 0; i < other.count; ++i) {
    uint32_t t = 0;
    while (t < count && terms[t].frame != other.terms[i].frame)
      ++t;
    if (t == count) {
      if (result.count == kMost)
        return false;
      result.terms[result.count++] = {other.terms[i].frame, 0};
    }
  }
  for (uint32_t t = 0; t < result.count; ++t) {
    double target = 0;
    for (uint32_t i = 0; i < other.count; ++i) {
      if (other.terms[i].frame == result.terms[t].frame)
        target = other.terms[i].weight;
    }
    result.terms[t].weight += share * (target - result.terms[t].weight);
  }
  *this = result;
  return true;
}

double Clock::since_start(uint32_t frame) const {
  frame = std::min(frame, frames_ - 1);
  if (!record_.times.empty())
    return record_.times[frame];
  return static_cast<double>(frame) * record_.rate_denominator / record_.rate_numerator;
}

double Clock::last_period() const {
  if (record_.times.empty() || frames_ == 1)
    return static_cast<double>(record_.rate_denominator) / record_.rate_numerator;
  return record_.times[frames_ - 1] - record_.times[frames_ - 2];
}

double Clock::loop_duration() const {
  const double last = since_start(frames_ - 1) - since_start(0);
  return loop_frames() < frames_ ? last : last + last_period();
}

FrameMix Clock::at(double seconds, Sampling sampling, Wrap wrap) const {
  FrameMix mix;
  const double first = since_start(0), span = since_start(frames_ - 1) - first;
  double t = seconds;
  if (frames_ == 1) {
    mix.add(0, 1);
    return mix;
  }
  if (wrap == Wrap::kLoop) {
    t = modulo(t, loop_duration());
  } else if (wrap == Wrap::kPingPong) {
    t = modulo(t, 2 * span);
    t = std::min(t, 2 * span - t);
  } else {
    t = std::clamp(t, 0.0, span);
  }
  // The frame before, and how far the way to the next one is gone.
  uint32_t frame = 0;
  double s = 0;
  if (record_.times.empty()) {
    const double position = t * record_.rate_numerator / record_.rate_denominator;
    frame = static_cast<uint32_t>(std::min(position, static_cast<double>(frames_ - 1)));
    s = position - frame;
  } else {
    auto after = std::upper_bound(record_.times.begin(), record_.times.end(), t + first);
    frame = after == record_.times.begin()
                ? 0
                : static_cast<uint32_t>(after - record_.times.begin() - 1);
    const double period =
        frame + 1 < frames_ ? since_start(frame + 1) - since_start(frame) : last_period();
    s = (t + first - since_start(frame)) / period;
  }
  if (s > 1 - kWholeFrame) {
    ++frame;
    s = 0;
  }
  if (wrap == Wrap::kLoop)
    frame = frame >= loop_frames() ? 0 : frame;
  else
    frame = std::min(frame, frames_ - 1);
  const bool has_next = wrap == Wrap::kLoop || frame + 1 < frames_;
  if (!(s >= kWholeFrame) || sampling == Sampling::kStep || !has_next) {
    mix.add(frame, 1);
    return mix;
  }
  if (sampling == Sampling::kCubic)
    return smooth(frame, s, wrap);
  mix.add(frame, 1 - s);
  mix.add(wrap == Wrap::kLoop && frame + 1 == loop_frames() ? 0 : frame + 1, s);
  return mix;
}

/// Hermite's curve whose tangents are the differences of the neighbours (Catmull and Rom 1974), at
/// times that need not be even.
FrameMix Clock::smooth(uint32_t frame, double s, Wrap wrap) const {
  const uint32_t n = wrap == Wrap::kLoop ? loop_frames() : frames_;
  const double turn = loop_duration();
  // Frames -1, 0, 1, 2 of the curve, and their times.
  uint32_t index[4];
  double time[4];
  for (int i = 0; i < 4; ++i) {
    const int64_t k = int64_t{frame} + i - 1;
    if (k >= 0 && k < n) {
      index[i] = static_cast<uint32_t>(k);
      time[i] = since_start(index[i]);
    } else if (wrap == Wrap::kLoop) {
      const int64_t turns = k < 0 ? -1 : k / n;  // a loop of one frame is passed twice
      index[i] = static_cast<uint32_t>(k - turns * n);
      time[i] = since_start(index[i]) + static_cast<double>(turns) * turn;
    } else if (wrap == Wrap::kPingPong) {  // mirrored, so that the curve stands still at its ends
      index[i] = k < 0 ? 1 : n - 2;
      const double end = since_start(k < 0 ? 0 : n - 1);
      time[i] = 2 * end - since_start(index[i]);
    } else {
      index[i] = k < 0 ? 0 : n - 1;
      time[i] = since_start(index[i]);
    }
  }
  const double h = time[2] - time[1];
  const double before = h / (time[2] - time[0]), after = h / (time[3] - time[1]);
  const double t0 = s * (1 - s) * (1 - s), t1 = -s * s * (1 - s);  // of the tangents
  const double p1 = s * s * (3 - 2 * s);
  FrameMix mix;
  mix.add(index[1], 1 - p1 - t1 * after);
  mix.add(index[2], p1 + t0 * before);
  mix.add(index[0], -t0 * before);
  mix.add(index[3], t1 * after);
  return mix;
}

FrameMix mix_at(const ClipRecord& clip, double seconds, Sampling sampling, Wrap wrap) {
  FrameMix mix = Clock(clip).at(seconds, sampling, wrap);
  for (uint32_t t = 0; t < mix.count; ++t)
    mix.terms[t].frame += clip.first_frame;
  return mix;
}

}  // namespace anicodec
