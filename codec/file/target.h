// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_FILE_TARGET_H_
#define ANICODEC_CODEC_FILE_TARGET_H_

#include "format/records.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anicodec {

/// The bound that the file must keep.
struct Target {
  ErrorMetric metric = ErrorMetric::kNone;
  double value = 0;  ///< KG in per cent, lengths in scene units (or per cent), bytes, or bpfv
  /// A length is per cent of the diagonal of the box over all frames of a clip.
  bool percent = false;
};

/// The target with lengths in scene units. Throws Error(kUsage) for values that make no sense.
Target in_scene_units(Target target, double diagonal);

/// The target and the cap of a clip, lengths in scene units.
struct ClipGoal {
  Target target;
  std::optional<double> cap;  ///< a maximum error beside another target
  double diagonal = 0;        ///< of the clip
};

/// The goals of clips with these diagonals, each of which takes a percentage of its own. Clips that are a single point
/// take that of the smallest other, or where all are points that of the box around them, `whole`. Throws Error(kUsage) for values that make no sense.
std::vector<ClipGoal> clip_goals(const Target& target, const std::optional<Target>& cap,
                                 const std::vector<double>& diagonals, double whole);

/// Makes a goal that every file keeps smaller, so that nothing leaves the range of numbers on the way: an error of at most
/// a million times `length`, the diagonal of all clips, and of a million per cent.
void limit_goal(double length, ClipGoal* goal);

/// The largest of the targets of clips, which are of one metric.
const Target& largest_target(const std::vector<ClipGoal>& goals);

/// The bytes that a target which is a size allows a file of these many vertices and frames; nothing
/// for other targets.
std::optional<double> allowed_bytes(const Target& target, uint32_t vertices, uint32_t frames);

/// Whether the source's positions are to come back bit for bit: a largest error of 0.
inline bool is_lossless(const Target& target) {
  return target.metric == ErrorMetric::kMaxError && target.value == 0;
}

/// Whether the target is a size, so that the error is what remains to be made small.
inline bool is_size(const Target& target) {
  return target.metric == ErrorMetric::kSize || target.metric == ErrorMetric::kBpfv;
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

/// Whether a file keeps to the target, but for a STED, and to the largest maximum error `cap` if there is one.
bool is_kept(const Target& target, std::optional<double> cap, const FileMeasures& file);

/// A number for a message, with four digits.
std::string four_digits(double x);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_FILE_TARGET_H_
