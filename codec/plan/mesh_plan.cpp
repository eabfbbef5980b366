// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/plan/mesh_plan.h"

#include "codec/sequence/error.h"

#include <utility>

namespace anicodec {
namespace {

void check_run(const FrameRun& run, const MeshSequence& sequence, const EncodeOptions& options) {
  if (run.count == 0 || run.first >= sequence.frame_count ||
      run.count > sequence.frame_count - run.first)
    throw Error(ErrorKind::kUsage, "the sequence does not have all frames of the part");
  if (!sequence.clips.empty())
    throw Error(ErrorKind::kUsage, "a part is of one clip, not of several");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage,
                "parts are coded by eigenshapes or eigentrajectories, not by key-frames");
}

void check_goes_together(const MeshSequence& sequence, const EncodeOptions& options) {
  const ErrorMetric metric = options.target.metric;
  if (is_lossless(options.target) && options.surface_change)
    throw Error(ErrorKind::kUsage,
                "lossless is what keeps the source's own positions: none that were moved before");
  if (metric == ErrorMetric::kNone && !options.keyframes)
    throw Error(ErrorKind::kUsage, "an error, a size, or a number of key-frames must be asked for");
  if (options.keyframes && *options.keyframes > sequence.frame_count)
    throw Error(ErrorKind::kUsage, "more key-frames are asked for than there are frames");
  const InterpolationChoice interpolation =
      options.interpolation.value_or(InterpolationChoice::kLinear);
  const bool searches_keyframes =
      options.basis == BasisChoice::kAuto && interpolation == InterpolationChoice::kAuto;
  if (interpolation != InterpolationChoice::kLinear && !options.keyframes &&
      options.basis != BasisChoice::kKeyframes && !searches_keyframes)
    throw Error(ErrorKind::kUsage, "an interpolation can be chosen between key-frames only");
  if (options.part)
    check_run(*options.part, sequence, options);
  if (options.root_motion && options.part)
    throw Error(ErrorKind::kUsage, "the motion of the whole is of a clip, not of a part");
  if (options.root_motion && is_motion(metric))
    throw Error(ErrorKind::kUsage,
                "an error of the motion cannot be kept with the motion of the whole apart");
}

}  // namespace

bool MeshPlan::is_lossless() const {
  const Bound& bound = largest_bound(goals);
  return bound.metric == ErrorMetric::kMaxError && bound.value == 0;
}

MeshPlan plan_mesh(const MeshSequence& sequence, const EncodeOptions& options,
                   std::vector<ClipGoal> goals, double diagonal) {
  check_goes_together(sequence, options);
  MeshPlan plan;
  static_cast<CodingOptions&>(plan) = options;
  plan.goals = std::move(goals);
  plan.diagonal = diagonal;
  plan.run = options.part;
  return plan;
}

MeshPlan plan_mesh(const MeshSequence& sequence, const EncodeOptions& options) {
  const double whole = diagonal(sequence);
  const std::vector<double> diagonals =
      sequence.clips.empty() ? std::vector{whole} : clip_diagonals(sequence);
  return plan_mesh(sequence, options, clip_goals(options.target, options.cap, diagonals, whole),
                   whole);
}

}  // namespace anicodec
