// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/root_motion.h"

#include "sdk/base/quaternion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anicodec {
namespace {

constexpr double kTurn = 6.283185307179586477;

/// The ends of float, where sums leave it.
float bounded(double x) {
  constexpr double kMost = 3.4e38;
  return static_cast<float>(std::clamp(x, -kMost, kMost));
}

bool is_float(double x) {
  return std::isfinite(static_cast<float>(x));
}

}  // namespace

Affine RootState::affine(const GroundAxes& axes) const {
  const UnitQuaternion half = exp_rotation({{0, 0, turn}});
  const double c = 1 - 2 * half.z * half.z, s = 2 * half.w * half.z;
  const uint32_t a = axes.a, b = axes.b;
  Affine result;
  result.m[4 * a + a] = result.m[4 * b + b] = static_cast<float>(c);
  result.m[4 * a + b] = static_cast<float>(-s);
  result.m[4 * b + a] = static_cast<float>(s);
  result.m[4 * a + 3] = bounded(pivot[0] + move[0] - (c * pivot[0] - s * pivot[1]));
  result.m[4 * b + 3] = bounded(pivot[1] + move[1] - (s * pivot[0] + c * pivot[1]));
  return result;
}

Status RootMotion::open(ByteView payload, const Limits& limits, uint8_t up,
                        const Vector<uint8_t>& wanted) {
  RootRecord record;
  if (Status s = RootRecord::read(payload, limits, &record); s != Status::kOk)
    return s;
  axes_ = GroundAxes::of(up);
  BinaryDecoder decoder(record.stream.data, record.stream.size);
  RootCoding coding;
  series_.resize(record.clips.size());
  for (size_t c = 0; c < record.clips.size(); ++c) {
    const RootRecord::Clip& clip = record.clips[c];
    if (!coding.code(decoder, clip.holds, limits.clip_frames[c], &series_[c]))
      return Status::kEntropy;
    for (const Vector<int32_t>& moves : series_[c].moves) {
      for (int32_t x : moves) {
        if (!is_float(x * clip.step))
          return Status::kNonFinite;
      }
    }
    for (int32_t x : series_[c].turns) {
      if (!is_float(x * clip.turn_step))
        return Status::kNonFinite;
    }
    for (double x : clip.pivot) {
      if (!is_float(2 * x))
        return Status::kNonFinite;
    }
    if (!wanted[c])
      series_[c] = RootSeries();
  }
  if (!decoder.finish())
    return Status::kEntropy;
  clips_ = std::move(record.clips);
  for (size_t c = 0; c < clips_.size(); ++c) {
    if (!wanted[c])
      clips_[c].holds = 0;
  }
  return Status::kOk;
}

RootState RootMotion::at(uint32_t clip, uint32_t frame) const {
  RootState state;
  if (holds(clip) == 0)
    return state;
  const RootRecord::Clip& c = clips_[clip];
  for (size_t i = 0; i < 2; ++i) {
    state.pivot[i] = c.pivot[i];
    if (c.holds & RootRecord::kMoves)
      state.move[i] = c.step * series_[clip].moves[i][frame];
  }
  if (c.holds & RootRecord::kTurns)
    state.turn = c.turn_step * series_[clip].turns[frame];
  return state;
}

size_t RootMotion::resident_bytes() const {
  size_t total = clips_.size() * sizeof(RootRecord::Clip) + series_.size() * sizeof(RootSeries);
  each_series([&](const int32_t*, size_t count) { total += sizeof(int32_t) * count; });
  return total;
}

RootState mean_root(const RootState* states, const double* weights, uint32_t count) {
  if (count == 1)
    return states[0];
  RootState mean;
  mean.turn = states[0].turn;
  for (uint32_t i = 0; i < count; ++i) {
    const double turn = states[i].turn - states[0].turn;
    mean.turn += weights[i] * (turn - kTurn * std::round(turn / kTurn));
    for (size_t k = 0; k < 2; ++k) {
      mean.move[k] += weights[i] * states[i].move[k];
      mean.pivot[k] += weights[i] * states[i].pivot[k];
    }
  }
  return mean;
}

Affine after(const Affine& a, const Affine& b) {
  Affine result;
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 4; ++c) {
      double sum = c == 3 ? static_cast<double>(a.m[4 * r + 3]) : 0;
      for (size_t k = 0; k < 3; ++k)
        sum += static_cast<double>(a.m[4 * r + k]) * static_cast<double>(b.m[4 * k + c]);
      result.m[4 * r + c] = bounded(sum);
    }
  }
  return result;
}

}  // namespace anicodec
