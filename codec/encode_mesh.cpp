// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode_mesh.h"

#include "codec/check_file.h"
#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/file/metadata_json.h"
#include "codec/file/root_motion_encode.h"
#include "codec/parallel/thread_count.h"
#include "codec/plan/encoding_memory.h"
#include "codec/search/file_search.h"
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

namespace anicodec {
namespace {

/// The timing of a run of frames; their positions stay.
void cut_timing(const FrameRun& run, MeshSequence& sequence) {
  if (sequence.times.empty()) {
    sequence.start_time += run.first / sequence.rate.value();
    return;
  }
  const double start = sequence.times[run.first];
  sequence.start_time += start;
  std::vector<double> times;
  for (uint32_t f = run.first; f < run.first + run.count; ++f)
    times.push_back(sequence.times[f] - start);
  sequence.times = std::move(times);
}

/// The record of the clips without errors. Cuts the timing of the sequence to the run.
ClipsRecord described(const MeshPlan& plan, MeshSequence& sequence) {
  std::vector<bool> closed;
  uint32_t first = 0;
  for (const ClipTiming& clip : clips_of(sequence)) {
    closed.push_back(!plan.run && is_closed(sequence, {first, clip.frame_count}));
    first += clip.frame_count;
  }
  if (plan.run)
    cut_timing(*plan.run, sequence);
  ClipsRecord record = clips_record(sequence, plan, plan.goals);
  for (size_t c = 0; c < closed.size(); ++c)
    record.clips[c].closed = closed[c];
  return record;
}

/// The motion of the whole is taken out and put back in floats: a bound that leaves room for it.
Bound below_rounding(Bound bound, double rounding) {
  if (bound.metric == ErrorMetric::kMaxError) {
    if (bound.value <= 2 * rounding)
      throw Error(ErrorKind::kUsage,
                  "the largest error asked for is too small for floats to keep beside the "
                  "motion of the whole");
    bound.value -= rounding;
  } else if (bound.metric == ErrorMetric::kKg || bound.metric == ErrorMetric::kRmse) {
    bound.value *= 1 - 1e-5;
  }
  return bound;
}

/// Goals of the search, by which the file keeps its promises.
std::vector<ClipGoal> searched_goals(const MeshPlan& plan, const EncoderInput& input) {
  // Frames between those of the source, and all where exact positions are left closed, play with this error.
  constexpr double kKgBesideExact = 0.2;
  std::vector<ClipGoal> goals = plan.goals;
  for (size_t c = 0; c < goals.size(); ++c) {
    ClipGoal& goal = goals[c];
    if (plan.is_lossless())
      goal.bound = plan.keyframes ? Bound{} : Bound{ErrorMetric::kKg, kKgBesideExact};
    if (input.layout.root_frames > 0) {
      const double rounding = input.clips[c].smallest_bound();
      goal.bound = below_rounding(goal.bound, rounding);
      if (goal.cap)
        goal.cap = below_rounding({ErrorMetric::kMaxError, *goal.cap}, rounding).value;
    }
    limit_goal(std::max(plan.diagonal, input.smallest_bound()), &goal);
  }
  return goals;
}

/// Frame 0 of the whole clip, the same in all runs: on a grid as fine as the error asked for.
std::shared_ptr<const EncodedPose> pose_of_runs(const MeshPlan& plan, const EncoderInput& input,
                                                const Bound& bound) {
  constexpr double kTypical = 1e-4;  // of the diagonal
  double step = kTypical * plan.diagonal;
  if (bound.metric == ErrorMetric::kMaxError)
    step = bound.value / 4;
  else if (bound.metric == ErrorMetric::kRmse)
    step = bound.value;
  Eigen::Vector3d origin;
  const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
  return encode_reference_pose(pose, origin, step, input.layout,
                               bytes_per_nanosecond(plan.smallest));
}

/// The pose that segments must lean on; null: any.
std::shared_ptr<const EncodedPose> given_pose(const MeshPlan& plan, const EncoderInput& input,
                                              const Bound& bound) {
  if (plan.pose) {
    if (plan.pose->grid.points.size() != size_t{3} * input.layout.sizes.coded_vertices)
      throw Error(ErrorKind::kInput, "the reference pose is of another mesh");
    return plan.pose;
  }
  return plan.run ? pose_of_runs(plan, input, bound) : nullptr;
}

/// The clip as it is coded, with its root motion apart.
EncoderInput input_of(MeshSequence sequence, const MeshPlan& plan) {
  EncodedRoot root;
  FrameArray whole;
  if (plan.root_motion) {
    whole = sequence.positions;
    root = take_root_motion(plan.diagonal, &sequence);
  }
  EncoderInput input(std::move(sequence), plan.run, plan.layout.get());
  if (root.frames > 0) {
    input.keep_whole(whole);
    input.layout.root = root.chunk;
    input.layout.root_frames = root.frames;
  }
  input.described = plan;
  input.without = plan.without;
  input.layout.has_bounds = plan.bounds;
  if (plan.learning)
    input.learning = {true, plan.learning->latest(0)};
  return input;
}

std::vector<const Attribute*> addresses(const std::vector<Attribute>& attributes) {
  std::vector<const Attribute*> result;
  for (const Attribute& attribute : attributes)
    result.push_back(&attribute);
  return result;
}

/// Lays out attributes and metadata.
std::vector<StoredAttribute> laid_out(const MeshPlan& plan, EncoderInput& input) {
  std::vector<StoredAttribute> stored;
  if (!plan.layout)
    stored = encode_attributes(input.sequence, plan.attributes, &input.layout);
  else if (plan.stored)
    stored = *plan.stored;
  std::string metadata = plan.metadata;
  if (plan.attributes.keep)
    metadata = with_fields(metadata, addresses(input.sequence.attributes));
  if (!metadata.empty())
    input.layout.metadata = checked_metadata(metadata);
  return stored;
}

/// Adds the exact positions to the segments of a clip.
void keep_exact(const EncoderInput& input, Solution& positions) {
  for (CodedSegment& segment : positions.segments) {
    Limits::Segment& sizes = segment.encoded.sizes;
    segment.encoded.exact =
        encode_exact(input.shown().frames(sizes.first_frame, sizes.frames), input.layout.topology);
    sizes.exact = true;
  }
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

/// Writes what was measured into the record and the result. Throws Error(kInternal) where a promise is not kept.
void promise(const MeshPlan& plan, const EncoderInput& input,
             const std::vector<MeasuredClip>& measured, size_t bytes, EncodedMesh* mesh) {
  const std::vector<ClipTiming> timings = clips_of(input.sequence);
  EncodeResult& result = mesh->result;
  for (size_t c = 0; c < measured.size(); ++c) {
    const Comparison& positions = measured[c].positions;
    ClipRecord& clip = mesh->record.clips[c];
    clip.kg = positions.kg;
    clip.rmse = positions.rmse;
    clip.max_error = positions.max_error;
    clip.max_displacement_error = positions.max_displacement_error;
    clip.attribute_errors = measured[c].attributes;
    result.clips.push_back({std::string(clip.name.begin(), clip.name.end()),
                            input.clips[c].frames.count, timings[c].rate, clip.kg, clip.rmse,
                            clip.max_error, clip.max_displacement_error, clip.diagonal});
    const FileMeasures measures{
        clip.kg, clip.rmse,       clip.max_error, clip.max_displacement_error,
        bytes,   result.vertices, result.frames};
    if (!is_kept(plan.goals[c], measures))
      throw Error(ErrorKind::kInternal, "the encoded file does not keep what was asked");
  }
}

/// A layout without what no file needs: a scene keeps those of all its meshes.
MeshLayout of_file(MeshLayout layout) {
  layout.topology = {};
  layout.coded_source = {};
  layout.source_coded = {};
  layout.vertex_source = {};
  layout.polygon_source = {};
  layout.polygon_first = {};
  return layout;
}

EncodedMesh encode_within(MeshSequence sequence, const MeshPlan& plan, const Progress& progress,
                          std::shared_ptr<MemoryBudget> memory) {
  EncodedMesh mesh;
  mesh.record = described(plan, sequence);
  EncoderInput input = input_of(std::move(sequence), plan);
  SearchProgress steps(progress);
  input.memory = std::move(memory);
  input.progress = &steps;
  const std::vector<ClipGoal> goals = searched_goals(plan, input);
  const Bound& bound = largest_bound(goals);
  input.bound_clips(goals);
  const std::vector<StoredAttribute> stored = laid_out(plan, input);
  input.pose = given_pose(plan, input, bound);

  FileSearch search(input, stored, plan, bound);
  CodedClip coded = search.run(mesh.record);
  if (plan.is_lossless())
    keep_exact(input, coded.positions);

  ClipsRecord unmeasured = mesh.record;
  make_room(coded.attributes.results, &unmeasured);
  const Bytes file = clip_file(unmeasured, input.layout, coded.encoded());
  const CheckedFile checked =
      check_file(file, input, stored, plan.is_lossless(), plan.learning, &coded.attributes.results);
  EncodeResult& result = mesh.result;
  result = result_of(checked.clips, input);
  promise(plan, input, checked.clips, file.size(), &mesh);
  result.kind = coded.positions.segments[0].encoded.sizes.kind;
  for (const CodedSegment& segment : coded.positions.segments) {
    const Limits::Segment& sizes = segment.encoded.sizes;
    result.components = std::max(result.components, sizes.components);
    result.segments.push_back({sizes.first_frame, sizes.frames});
  }
  result.diagonal = plan.diagonal;
  result.attributes = std::move(coded.attributes.results);
  result.trials = search.trials();
  result.search_notes = search.notes();
  for (const EncodedSegment* segment : coded.encoded()) {
    mesh.segments.push_back(*segment);
    mesh.segments.back().bounds = checked.bounds[mesh.segments.size() - 1];
  }
  mesh.layout = of_file(std::move(input.layout));
  return mesh;
}

}  // namespace

std::vector<const EncodedSegment*> EncodedMesh::list() const {
  std::vector<const EncodedSegment*> all;
  for (const EncodedSegment& segment : segments)
    all.push_back(&segment);
  return all;
}

Bytes EncodedMesh::file() const {
  return clip_file(record, layout, list());
}

EncodedMesh encode_mesh(MeshSequence sequence, const MeshPlan& plan, const Progress& progress) {
  if (plan.most_bytes == 0)
    return encode_within(std::move(sequence), plan, progress, nullptr);
  const size_t threads = thread_count();
  const MemoryPlan fitting = plan_memory(EncodingMemory::of(sequence, plan), plan, threads);
  const auto memory = std::make_shared<MemoryBudget>(fitting.left);
  if (fitting.threads == threads)
    return encode_within(std::move(sequence), plan, progress, memory);
  EncodedMesh mesh;
  with_threads(fitting.threads,
               [&] { mesh = encode_within(std::move(sequence), plan, progress, memory); });
  return mesh;
}

}  // namespace anicodec
