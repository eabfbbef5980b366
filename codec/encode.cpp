// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/check_file.h"
#include "codec/file/clip_record.h"
#include "codec/search/clip_search.h"
#include "codec/search/search_progress.h"
#include "codec/segment/reference_pose_encode.h"
#include "codec/sequence/error.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace anicodec {
namespace {

/// Whether a clip ends where it began.
bool is_closed(const MeshSequence& sequence) {
  return sequence.frame_count > 1 &&
         std::ranges::equal(sequence.frame(0), sequence.frame(sequence.frame_count - 1));
}

void check_part(const FrameRun& part, const MeshSequence& sequence, const EncodeOptions& options) {
  if (part.count == 0 || part.first >= sequence.frame_count ||
      part.count > sequence.frame_count - part.first)
    throw Error(ErrorKind::kUsage, "the sequence does not have all frames of the part");
  if (options.keyframes || options.basis == BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage,
                "parts are coded by eigenshapes or eigentrajectories, not by key-frames");
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

/// Frame 0 of the whole clip, the same in all parts: on a grid as fine as the error asked for.
std::shared_ptr<const EncodedPose> pose_of_parts(const EncoderInput& input, const Target& target,
                                                 double clip_diagonal) {
  constexpr double kTypical = 1e-4;  // of the diagonal
  double step = kTypical * clip_diagonal;
  if (target.metric == ErrorMetric::kMaxError)
    step = target.value / 4;
  else if (target.metric == ErrorMetric::kRmse)
    step = target.value;
  Eigen::Vector3d origin;
  const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
  return encode_reference_pose(pose, origin, step, input.layout);
}

}  // namespace

EncodeResult encode(MeshSequence sequence, const EncodeOptions& options, const Progress& progress) {
  check(sequence);
  double clip_diagonal = diagonal(sequence);
  Target target = in_scene_units(options.target, clip_diagonal);
  if (target.metric == ErrorMetric::kNone && !options.keyframes)
    throw Error(ErrorKind::kUsage, "an error, a size, or a number of key-frames must be asked for");
  if (options.interpolation != InterpolationChoice::kLinear && !options.keyframes &&
      options.basis != BasisChoice::kKeyframes)
    throw Error(ErrorKind::kUsage, "an interpolation can be chosen between key-frames only");

  bool closed = is_closed(sequence);
  if (options.part) {
    check_part(*options.part, sequence, options);
    cut_timing(*options.part, sequence);
    closed = false;
  }
  ClipRecord record = clip_record(sequence, options, target, clip_diagonal);
  record.closed = closed;
  EncoderInput input(std::move(sequence), options.part);
  const std::vector<StoredAttribute> stored =
      encode_attributes(input.sequence, options.attributes, &input.layout);
  if (options.part)
    input.pose = pose_of_parts(input, target, clip_diagonal);
  ClipSearch search(input, stored, options, target, clip_diagonal);
  SearchProgress steps(progress, search.expected_trials());
  input.on_trial = [&steps] { steps.trial(); };
  CodedClip coded = search.run(record);

  const Bytes file = coded.file(record, input.layout);
  std::vector<AttributeResult>& attributes = coded.attributes.results;
  const Comparison measured =
      check_file(file, input, stored, options.part ? options.part->first : 0, &attributes);
  const FileMeasures measures{measured.kg,
                              measured.rmse,
                              measured.max_error,
                              file.size(),
                              input.sequence.vertex_count,
                              input.sequence.frame_count};
  std::optional<double> cap;
  if (options.cap)
    cap = in_scene_units(*options.cap, clip_diagonal).value;
  if (!is_kept(target, cap, measures))
    throw Error(ErrorKind::kInternal, "the encoded file does not keep what was asked");
  record.kg = measured.kg;
  record.rmse = measured.rmse;
  record.max_error = measured.max_error;

  EncodeResult result;
  result.file = coded.file(record, input.layout);
  result.vertices = input.sequence.vertex_count;
  result.faces = static_cast<uint32_t>(input.sequence.polygons.size());
  result.frames = input.sequence.frame_count;
  result.positions = uint64_t{result.vertices} * result.frames;
  result.kind = coded.positions.parts[0].encoded.sizes.kind;
  result.components = coded.positions.parts[0].encoded.sizes.components;
  result.kg = measured.kg;
  result.rmse = measured.rmse;
  result.max_error = measured.max_error;
  result.diagonal = clip_diagonal;
  result.attributes = std::move(attributes);
  result.trials = search.trials();
  return result;
}

}  // namespace anicodec
