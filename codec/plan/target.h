// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_PLAN_TARGET_H_
#define ANICODEC_CODEC_PLAN_TARGET_H_

#include "format/records.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

/// An error or a size that a file must keep, as it is asked for.
struct Target {
  ErrorMetric metric = ErrorMetric::kNone;
  double value = 0;  ///< KG in per cent, lengths in scene units (or per cent), bytes, or bpfv
  /// A length is per cent of the diagonal of the box over all frames of a clip.
  bool percent = false;
};

/// The same for a clip, no longer relative: lengths are in scene units.
struct Bound {
  ErrorMetric metric = ErrorMetric::kNone;
  double value = 0;
};

/// The target of a clip of this diagonal. Throws Error(kUsage) for values that make no sense.
Bound bound_of(const Target& target, double diagonal);

/// The bounds that one of the clips of a file must keep.
struct ClipGoal {
  Bound bound;
  std::optional<double> cap;  ///< a maximum error beside another bound
  double diagonal = 0;        ///< of the clip
};

/// The goals of clips with these diagonals, each of which takes a percentage of its own. Clips that are a single point
/// take that of the smallest other, or where all are points that of the box around them, `whole`. Throws Error(kUsage) for values that make no sense.
std::vector<ClipGoal> clip_goals(const Target& target, const std::optional<Target>& cap,
                                 const std::vector<double>& diagonals, double whole);

/// Makes a goal that every file keeps smaller, so that nothing leaves the range of numbers on the way: an error of at most
/// a million times `length`, the diagonal of all clips, and of a million per cent.
void limit_goal(double length, ClipGoal* goal);

/// The largest of the bounds of clips, which are of one metric.
const Bound& largest_bound(const std::vector<ClipGoal>& goals);

/// The bytes that a bound which is a size allows a file of these many vertices and frames; nothing
/// for others.
std::optional<double> allowed_bytes(const Bound& bound, uint32_t vertices, uint32_t frames);

/// Whether the source's positions are to come back bit for bit: a largest error of 0.
inline bool is_lossless(const Target& target) {
  return target.metric == ErrorMetric::kMaxError && target.value == 0;
}

/// Whether a target is a size, so that the error is what remains to be made small.
inline bool is_size(ErrorMetric metric) {
  return metric == ErrorMetric::kSize || metric == ErrorMetric::kBpfv;
}

/// Whether a target is about how a clip moves, which is measured over pairs of frames and not frame
/// by frame.
inline bool is_motion(ErrorMetric metric) {
  return metric == ErrorMetric::kDisplacement || metric == ErrorMetric::kSted;
}

/// Errors measured on a file: KG in per cent, lengths in scene units.
struct FileMeasures {
  double kg = 0;
  double rmse = 0;
  double max_error = 0;
  double max_displacement_error = 0;
  size_t bytes = 0;
  uint32_t vertices = 0;
  uint32_t frames = 0;
};

/// Whether a file keeps to a goal, but for a STED.
bool is_kept(const ClipGoal& goal, const FileMeasures& file);

/// A number for a message, with four digits.
std::string four_digits(double x);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_PLAN_TARGET_H_
