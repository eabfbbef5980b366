// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/root_step.h"

#include "sdk/base/quaternion.h"
#include "sdk/clip/sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anicodec {
namespace {

/// Adds a vector of the ground, turned, to `to`.
void add_turned(double turn, const double v[2], double to[2]) {
  const UnitQuaternion half = exp_rotation({{0, 0, turn}});
  const double c = 1 - 2 * half.z * half.z, s = 2 * half.w * half.z;
  to[0] += c * v[0] - s * v[1];
  to[1] += s * v[0] + c * v[1];
}

/// First one step, then the other.
RootState then(const RootState& a, const RootState& b) {
  RootState both = a;
  both.turn += b.turn;
  add_turned(a.turn, b.move, both.move);
  return both;
}

RootState inverse(const RootState& a) {
  RootState back;
  back.turn = -a.turn;
  const double away[2] = {-a.move[0], -a.move[1]};
  add_turned(back.turn, away, back.move);
  return back;
}

/// The same map with the origin as its pivot.
RootState about_origin(const RootState& a) {
  RootState moved;
  moved.turn = a.turn;
  const double away[2] = {-a.pivot[0], -a.pivot[1]};
  for (size_t i = 0; i < 2; ++i)
    moved.move[i] = a.pivot[i] + a.move[i];
  add_turned(a.turn, away, moved.move);
  return moved;
}

RootState repeated(RootState step, double times) {
  RootState all;
  if (times < 0) {
    step = inverse(step);
    times = -times;
  }
  for (auto n = static_cast<uint64_t>(times); n > 0; n >>= 1) {
    if (n & 1)
      all = then(all, step);
    step = then(step, step);
  }
  return all;
}

class Path {
 public:
  Path(const Clip& clip, uint32_t number, Sampling sampling, Wrap wrap)
      : clip_(clip),
        record_(clip.clips()[number]),
        clock_(record_),
        sampling_(sampling),
        wrap_(wrap),
        duration_(clock_.time(record_.frames - 1)),
        loop_(wrap == Wrap::kLoop ? clock_.loop_duration() : 0) {}

  RootState step(double from, double to) const {
    if (!(loop_ > 0))
      return then(inverse(at(from, wrap_)), at(to, wrap_));
    const double turns_from = std::floor(from / loop_), turns_to = std::floor(to / loop_);
    const RootState begin = since_start(from - loop_ * turns_from),
                    end = since_start(to - loop_ * turns_to);
    return then(then(inverse(begin), repeated(since_start(loop_), turns_to - turns_from)), end);
  }

 private:
  RootState at(double seconds, Wrap wrap) const {
    return about_origin(root_state(clip_, mix_at(record_, seconds, sampling_, wrap)));
  }

  /// From the first frame to a time of one turn.
  RootState since_start(double seconds) const {
    const RootState last = at(duration_, Wrap::kClamp);
    const double behind = std::min(seconds - duration_, duration_);
    const RootState now =
        behind > 0 ? then(last, then(inverse(at(duration_ - behind, Wrap::kClamp)), last))
                   : at(seconds, Wrap::kClamp);
    return then(inverse(at(0, Wrap::kClamp)), now);
  }

  const Clip& clip_;
  const ClipRecord& record_;
  Clock clock_;
  Sampling sampling_;
  Wrap wrap_;
  double duration_, loop_;
};

}  // namespace

RootState root_step(const Clip& clip, uint32_t number, double from, double to, Sampling sampling,
                    Wrap wrap) {
  return Path(clip, number, sampling, wrap).step(from, to);
}

}  // namespace anicodec
