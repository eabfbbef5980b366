// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/check_file.h"
#include "codec/file/clip_record.h"
#include "codec/file/encoding_memory.h"
#include "codec/file/metadata_json.h"
#include "codec/file/root_motion_encode.h"
#include "codec/parallel/thread_count.h"
#include "codec/search/clip_search.h"
#include "codec/search/opening_time.h"
#include "codec/search/search_progress.h"
#include "codec/segment/exact_encode.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"
#include "sdk/clip/kept_learning.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anicodec {
namespace {

/// Whether a clip ends where it began.
bool is_closed(const MeshSequence& sequence, const FrameRun& clip) {
  return clip.count > 1 && std::ranges::equal(sequence.frame(clip.first),
                                              sequence.frame(clip.first + clip.count - 1));
}

/// Counts, and errors over all clips.
EncodeResult result_of(const std::vector<MeasuredClip>& clips, const EncoderInput& input) {
  EncodeResult result;
  result.vertices = input.sequence.vertex_count;
  result.faces = static_cast<uint32_t>(input.sequence.polygons.size());
  result.frames = input.sequence.frame_count;
  result.rate = input.sequence.rate;
  result.positions = uint64_t{result.vertices} * result.frames;
  double squared = 0;
  for (size_t c = 0; c < clips.size(); ++c) {
    const Comparison& clip = clips[c].positions;
    squared += clip.rmse * clip.rmse * input.clips[c].frames.count;
    result.max_error = std::max(result.max_error, clip.max_error);
    result.max_displacement_error =
        std::max(result.max_displacement_error, clip.max_displacement_error);
  }
  result.rmse = clips.size() == 1 ? clips[0].positions.rmse : std::sqrt(squared / result.frames);
  result.kg = clips.size() == 1 ? clips[0].positions.kg
                                : 100 * std::sqrt(squared * result.vertices / input.kg_reference);
  return result;
}

std::vector<const Attribute*> addresses(const std::vector<Attribute>& attributes) {
  std::vector<const Attribute*> result;
  for (const Attribute& attribute : attributes)
    result.push_back(&attribute);
  return result;
}

void check_part(const FrameRun& part, const MeshSequence& sequence, const EncodeOptions& options) {
  if (part.count == 0 || part.first >= sequence.frame_count ||
      part.count > sequence.frame_count - part.first)
    throw Error(ErrorKind::kUsage, "the sequence does not have all frames of the part");
  if (!sequence.clips.empty())
    throw Error(ErrorKind::kUsage, "a part is of one clip, not of several");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage,
                "parts are coded by eigenshapes or eigentrajectories, not by key-frames");
}

/// The target of what plays between frames, and of all frames where exact positions are left closed.
Target basis_target(const EncodeOptions& options) {
  constexpr double kKg = 0.2;
  return options.keyframes ? Target{} : Target{ErrorMetric::kKg, kKg, false};
}

/// Adds the exact positions to the segments of a clip.
void keep_exact(const EncoderInput& input, Solution& positions) {
  for (CodedPart& part : positions.parts) {
    Limits::Segment& sizes = part.encoded.sizes;
    part.encoded.exact =
        encode_exact(input.shown().frames(sizes.first_frame, sizes.frames), input.layout.topology);
    sizes.exact = true;
  }
}

/// The timing of a part; its positions stay.
void cut_timing(const FrameRun& part, MeshSequence& sequence) {
  if (sequence.times.empty()) {
    sequence.start_time += part.first / sequence.rate.value();
    return;
  }
  const double start = sequence.times[part.first];
  sequence.start_time += start;
  std::vector<double> times;
  for (uint32_t f = part.first; f < part.first + part.count; ++f)
    times.push_back(sequence.times[f] - start);
  sequence.times = std::move(times);
}

/// The motion of the whole is taken out and put back in floats: a target that leaves room for it.
Target below_rounding(Target target, double bound) {
  if (target.metric == ErrorMetric::kMaxError) {
    if (target.value <= 2 * bound)
      throw Error(ErrorKind::kUsage,
                  "the largest error asked for is too small for floats to keep beside the "
                  "motion of the whole");
    target.value -= bound;
  } else if (target.metric == ErrorMetric::kKg || target.metric == ErrorMetric::kRmse) {
    target.value *= 1 - 1e-5;
  }
  return target;
}

/// Frame 0 of the whole clip, the same in all parts: on a grid as fine as the error asked for.
std::shared_ptr<const EncodedPose> pose_of_parts(const EncoderInput& input, const Target& target,
                                                 double clip_diagonal, bool smallest) {
  constexpr double kTypical = 1e-4;  // of the diagonal
  double step = kTypical * clip_diagonal;
  if (target.metric == ErrorMetric::kMaxError)
    step = target.value / 4;
  else if (target.metric == ErrorMetric::kRmse)
    step = target.value;
  Eigen::Vector3d origin;
  const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
  return encode_reference_pose(pose, origin, step, input.layout, bytes_per_nanosecond(smallest));
}

EncodeResult encode_within(MeshSequence sequence, const EncodeOptions& options,
                           const Progress& progress, std::shared_ptr<MemoryBudget> memory) {
  const double whole_diagonal = diagonal(sequence);
  const std::vector<ClipGoal> asked =
      clip_goals(options.target, options.cap, clip_diagonals(sequence), whole_diagonal);
  const Target target = largest_target(asked);
  const bool lossless = is_lossless(options.target);
  if (lossless && options.surface_change)
    throw Error(ErrorKind::kUsage,
                "lossless is what keeps the source's own positions: none that were moved before");
  if (target.metric == ErrorMetric::kNone && !options.keyframes)
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

  std::vector<bool> closed;
  std::vector<FrameRate> rates;
  uint32_t first = 0;
  for (const ClipTiming& clip : clips_of(sequence)) {
    rates.push_back(clip.rate);
    closed.push_back(is_closed(sequence, {first, clip.frame_count}));
    first += clip.frame_count;
  }
  if (options.part) {
    check_part(*options.part, sequence, options);
    cut_timing(*options.part, sequence);
    closed[0] = false;
  }
  ClipsRecord record = clips_record(sequence, options, asked);
  for (size_t c = 0; c < closed.size(); ++c)
    record.clips[c].closed = closed[c];
  EncodedRoot root;
  FrameArray whole;
  if (options.root_motion) {
    if (options.part)
      throw Error(ErrorKind::kUsage, "the motion of the whole is of a clip, not of a part");
    if (is_motion(target.metric))
      throw Error(ErrorKind::kUsage,
                  "an error of the motion cannot be kept with the motion of the whole apart");
    whole = sequence.positions;
    root = take_root_motion(whole_diagonal, &sequence);
  }
  EncoderInput input(std::move(sequence), options.part, options.layout.get());
  input.memory = std::move(memory);
  std::vector<ClipGoal> goals = asked;
  if (lossless) {
    for (ClipGoal& goal : goals)
      goal.target = basis_target(options);
  }
  if (root.frames > 0) {
    input.keep_whole(whole);
    input.layout.root = root.chunk;
    input.layout.root_frames = root.frames;
    for (size_t c = 0; c < goals.size(); ++c) {
      ClipGoal& goal = goals[c];
      const double rounding = input.clips[c].smallest_bound();
      goal.target = below_rounding(goal.target, rounding);
      if (goal.cap)
        goal.cap = below_rounding({ErrorMetric::kMaxError, *goal.cap, false}, rounding).value;
    }
  }
  whole = {};
  for (ClipGoal& goal : goals)
    limit_goal(std::max(whole_diagonal, input.smallest_bound()), &goal);
  input.bound_clips(goals);
  const Target searched = largest_target(goals);
  std::vector<StoredAttribute> stored;
  if (!options.layout)
    stored = encode_attributes(input.sequence, options.attributes, &input.layout);
  else if (options.stored)
    stored = *options.stored;
  if (options.part)
    input.pose = pose_of_parts(input, searched, whole_diagonal, options.smallest);
  if (options.pose) {
    if (options.pose->grid.points.size() != size_t{3} * input.layout.sizes.coded_vertices)
      throw Error(ErrorKind::kInput, "the reference pose is of another mesh");
    input.pose = options.pose;
  }
  if (options.learning)
    input.learning = {true, options.learning->latest(0)};
  input.layout.has_bounds = options.bounds;
  std::string metadata = options.metadata;
  if (options.attributes.keep)
    metadata = with_fields(metadata, addresses(input.sequence.attributes));
  if (!metadata.empty())
    input.layout.metadata = checked_metadata(metadata);
  ClipSearch search(input, stored, options, searched);
  SearchProgress steps(progress);
  input.without = options.without;
  input.progress = &steps;
  CodedClip coded = search.run(record);
  if (lossless)
    keep_exact(input, coded.positions);

  const Bytes file = coded.file(record, input.layout);
  std::vector<AttributeResult>& attributes = coded.attributes.results;
  const CheckedFile checked =
      check_file(file, input, stored, options.part ? options.part->first : 0, lossless,
                 options.learning, &attributes);
  const std::vector<MeasuredClip>& measured = checked.clips;
  EncodeResult result = result_of(measured, input);
  for (size_t c = 0; c < measured.size(); ++c) {
    const Comparison& positions = measured[c].positions;
    ClipRecord& clip = record.clips[c];
    clip.kg = positions.kg;
    clip.rmse = positions.rmse;
    clip.max_error = positions.max_error;
    clip.max_displacement_error = positions.max_displacement_error;
    clip.attribute_errors = measured[c].attributes;
    result.clips.push_back({std::string(clip.name.begin(), clip.name.end()),
                            input.clips[c].frames.count, rates[c], clip.kg, clip.rmse,
                            clip.max_error, clip.max_displacement_error, clip.diagonal});
    const FileMeasures measures{
        clip.kg,     clip.rmse,       clip.max_error, clip.max_displacement_error,
        file.size(), result.vertices, result.frames};
    if (!is_kept(asked[c].target, asked[c].cap, measures))
      throw Error(ErrorKind::kInternal, "the encoded file does not keep what was asked");
  }
  for (size_t i = 0; i < coded.positions.parts.size(); ++i)
    coded.positions.parts[i].encoded.bounds = checked.bounds[i];
  result.file = coded.file(record, input.layout);
  result.kind = coded.positions.parts[0].encoded.sizes.kind;
  for (const CodedPart& part : coded.positions.parts) {
    const Limits::Segment& sizes = part.encoded.sizes;
    result.components = std::max(result.components, sizes.components);
    result.segments.push_back({sizes.first_frame, sizes.frames});
  }
  result.diagonal = whole_diagonal;
  result.attributes = std::move(attributes);
  result.trials = search.trials();
  result.search_notes = search.notes();
  return result;
}

}  // namespace

EncodeResult encode(MeshSequence sequence, const EncodeOptions& options, const Progress& progress) {
  check(sequence);
  if (options.most_bytes == 0)
    return encode_within(std::move(sequence), options, progress, nullptr);
  const size_t threads = thread_count();
  const MemoryPlan plan = plan_memory(EncodingMemory::of(sequence, options), options, threads);
  const auto memory = std::make_shared<MemoryBudget>(plan.left);
  if (plan.threads == threads)
    return encode_within(std::move(sequence), options, progress, memory);
  EncodeResult result;
  with_threads(plan.threads,
               [&] { result = encode_within(std::move(sequence), options, progress, memory); });
  return result;
}

}  // namespace anicodec
