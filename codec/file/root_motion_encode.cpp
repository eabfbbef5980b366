// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/root_motion_encode.h"

#include "codec/sequence/error.h"
#include "format/coding/binary_coder.h"
#include "format/root_record.h"
#include "sdk/clip/root_coding.h"
#include "sdk/clip/root_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anicodec {
namespace {

/// Moves shorter than this share of the diagonal, and turns of fewer radians, are none.
constexpr double kLeastMove = 1e-3, kLeastTurn = 1e-2;
/// Steps, of the diagonal and in radians: well below the errors that are asked for, so that rounding adds
/// nothing to the basis.
constexpr double kStep = 1e-5;

struct Point {
  double a = 0, b = 0;
};

Point mean_of(std::span<const float> frame, const GroundAxes& axes) {
  Point mean;
  for (size_t v = 0; v < frame.size(); v += 3) {
    mean.a += static_cast<double>(frame[v + axes.a]);
    mean.b += static_cast<double>(frame[v + axes.b]);
  }
  const double vertices = static_cast<double>(frame.size()) / 3;
  return {mean.a / vertices, mean.b / vertices};
}

/// The turn that takes one frame to another; nothing where all turns fit alike.
std::optional<double> turn_between(std::span<const float> from, const Point& from_mean,
                                   std::span<const float> to, const Point& to_mean,
                                   const GroundAxes& axes) {
  double along = 0, across = 0, size = 0;
  for (size_t v = 0; v < from.size(); v += 3) {
    const Point p{static_cast<double>(from[v + axes.a]) - from_mean.a,
                  static_cast<double>(from[v + axes.b]) - from_mean.b};
    const Point q{static_cast<double>(to[v + axes.a]) - to_mean.a,
                  static_cast<double>(to[v + axes.b]) - to_mean.b};
    along += p.a * q.a + p.b * q.b;
    across += p.a * q.b - p.b * q.a;
    size += std::hypot(p.a, p.b) * std::hypot(q.a, q.b);
  }
  constexpr double kLeastFit = 0.05;
  if (!(std::hypot(along, across) > kLeastFit * size))
    return std::nullopt;
  return std::atan2(across, along);
}

struct Motion {
  RootRecord::Clip header;
  RootSeries series;
};

int32_t rounded(double x, const std::string& name) {
  if (!(std::abs(x) < SeriesCoding::kLimit - 1))
    throw Error(ErrorKind::kInput,
                "clip '" + name + "' moves too far as a whole to have the motion apart");
  return static_cast<int32_t>(std::lround(x));
}

Motion motion_of(const MeshSequence& sequence, uint32_t first, const ClipTiming& clip,
                 double diagonal, const GroundAxes& axes) {
  const std::span<const float> still = sequence.frame(first);
  const Point pivot = mean_of(still, axes);
  std::vector<Point> moves;
  std::vector<double> turns;
  double before = 0, furthest = 0, most = 0;
  for (uint32_t f = 0; f < clip.frame_count; ++f) {
    const std::span<const float> frame = sequence.frame(first + f);
    const Point mean = mean_of(frame, axes);
    const double turn = turn_between(still, pivot, frame, mean, axes).value_or(before);
    constexpr double kRound = 2 * std::numbers::pi;
    before = f == 0 ? 0 : turn + kRound * std::round((before - turn) / kRound);
    turns.push_back(before);
    moves.push_back({mean.a - pivot.a, mean.b - pivot.b});
    furthest = std::max(furthest, std::hypot(moves.back().a, moves.back().b));
    most = std::max(most, std::abs(before));
  }
  Motion motion;
  RootRecord::Clip& header = motion.header;
  header.pivot[0] = pivot.a;
  header.pivot[1] = pivot.b;
  if (furthest > kLeastMove * diagonal) {
    header.holds |= RootRecord::kMoves;
    header.step = std::exp2(std::floor(std::log2(kStep * diagonal)));
    for (const Point& move : moves) {
      motion.series.moves[0].push_back(rounded(move.a / header.step, clip.name));
      motion.series.moves[1].push_back(rounded(move.b / header.step, clip.name));
    }
  }
  if (most > kLeastTurn) {
    header.holds |= RootRecord::kTurns;
    header.turn_step = std::exp2(std::floor(std::log2(2 * kStep)));
    for (double turn : turns)
      motion.series.turns.push_back(rounded(turn / header.turn_step, clip.name));
  }
  return motion;
}

[[noreturn]] void refuse_large() {
  throw Error(ErrorKind::kInput,
              "the coordinates are too large to have the motion of the whole apart");
}

/// Undoes the motion of a frame, as the decoder will do it.
void put_back(const RootState& state, const GroundAxes& axes, std::span<float> frame) {
  if (state.turn == 0 && state.move[0] == 0 && state.move[1] == 0)
    return;
  const double c = std::cos(state.turn), s = std::sin(state.turn);
  for (size_t v = 0; v < frame.size(); v += 3) {
    const double a = static_cast<double>(frame[v + axes.a]) - state.pivot[0] - state.move[0];
    const double b = static_cast<double>(frame[v + axes.b]) - state.pivot[1] - state.move[1];
    frame[v + axes.a] = static_cast<float>(state.pivot[0] + c * a + s * b);
    frame[v + axes.b] = static_cast<float>(state.pivot[1] - s * a + c * b);
    if (!std::isfinite(frame[v + axes.a]) || !std::isfinite(frame[v + axes.b]))
      refuse_large();
  }
}

}  // namespace

EncodedRoot take_root_motion(double diagonal, MeshSequence* sequence) {
  EncodedRoot result;
  if (!(diagonal > 0))
    return result;
  const GroundAxes axes = GroundAxes::of(static_cast<uint8_t>(sequence->up));
  const std::vector<ClipTiming> clips = clips_of(*sequence);
  RootRecord record;
  Limits limits;
  BinaryEncoder encoder;
  RootCoding coding;
  uint32_t first = 0;
  for (const ClipTiming& clip : clips) {
    Motion motion = motion_of(*sequence, first, clip, diagonal, axes);
    if (!coding.code(encoder, motion.header.holds, clip.frame_count, &motion.series))
      throw Error(ErrorKind::kInternal, "the motion of the whole cannot be coded");
    record.clips.push_back(motion.header);
    limits.clip_frames.push_back(clip.frame_count);
    result.frames += motion.header.holds != 0 ? clip.frame_count : 0;
    first += clip.frame_count;
  }
  if (result.frames == 0)
    return result;
  limits.root_frames = result.frames;
  const Bytes stream = encoder.finish();
  record.stream = stream;
  result.chunk = record.write();
  // The motion that the decoder will read is subtracted, not the original.
  RootMotion decoded;
  const Vector<uint8_t> all(clips.size(), 1);
  const Status status = decoded.open(result.chunk, limits, static_cast<uint8_t>(sequence->up), all);
  if (status == Status::kNonFinite)
    refuse_large();
  if (status != Status::kOk)
    throw Error(ErrorKind::kInternal, "the motion of the whole cannot be read again");
  uint32_t frame = 0;
  for (uint32_t c = 0; c < clips.size(); ++c) {
    for (uint32_t f = 0; f < clips[c].frame_count; ++f)
      put_back(decoded.at(c, f), axes, sequence->frame(frame++));
  }
  return result;
}

}  // namespace anicodec
