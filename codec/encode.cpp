// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/file/clip_file.h"
#include "codec/file/clip_record.h"
#include "codec/metrics/metrics.h"
#include "codec/search/keyframe_coder.h"
#include "codec/search/moving_attributes.h"
#include "codec/search/rate_control.h"
#include "codec/search/search_progress.h"
#include "codec/segment/linear_segment_encode.h"
#include "codec/sequence/error.h"
#include "sdk/clip/clip.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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
                                                 double clip_diagonal, bool slow) {
  constexpr double kTypical = 1e-4;  // of the diagonal
  double step = kTypical * clip_diagonal;
  if (target.metric == ErrorMetric::kMaxError)
    step = target.value / 4;
  else if (target.metric == ErrorMetric::kRmse)
    step = target.value;
  Eigen::Vector3d origin;
  const Eigen::MatrixXd pose = input.centred_first_pose(&origin);
  return encode_reference_pose(pose, origin, step, slow, input.layout);
}

Clip opened(const Bytes& file) {
  Clip clip;
  if (Failure failure = clip.open(file); !failure.ok())
    throw Error(ErrorKind::kInternal,
                std::string("the encoded file cannot be opened: ") + status_string(failure.status));
  if (Failure failure = clip.check_hashes(); !failure.ok())
    throw Error(ErrorKind::kInternal, "the encoded file decodes to other integers");
  return clip;
}

/// Plays a file and compares it with the source, in the source's vertex order whatever the file's.
Comparison check_positions(const Clip& clip, const EncoderInput& input) {
  const MeshLayout& layout = input.layout;
  const uint32_t vertices = input.sequence.vertex_count;
  std::vector<uint32_t> played_of(vertices);  // the played vertex that shows a vertex of the source
  if (clip.record().order == OrderMode::kFree) {
    const Vector<uint32_t>& coded = clip.meshes()[0].topology.vertex_coded;
    std::vector<uint32_t> place(layout.sizes.coded_vertices);
    for (uint32_t v = 0; v < coded.size(); ++v)
      place[coded[v]] = v;
    for (uint32_t v = 0; v < vertices; ++v)
      played_of[v] = place[layout.source_coded[v]];
  } else {
    std::iota(played_of.begin(), played_of.end(), 0U);
  }
  auto gather = [vertices](const float* rows, const std::vector<uint32_t>& row, float* out) {
    for (uint32_t v = 0; v < vertices; ++v)
      out = std::copy_n(rows + size_t{3} * row[v], 3, out);
  };
  std::vector<float> original(size_t{3} * vertices), played(original.size()),
      decoded(original.size());
  CompareOptions options;
  options.sted = false;
  return compare(
      input.sequence.polygons, vertices, input.sequence.frame_count,
      [&](uint32_t f) -> std::span<const float> {
        gather(input.frames().frame(f), layout.source_coded, original.data());
        return original;
      },
      [&](uint32_t f) -> std::span<const float> {
        clip.positions(0, f, played.data());
        gather(played.data(), played_of, decoded.data());
        return decoded;
      },
      options);
}

/// Plays the attributes that move and fills in their errors. Throws Error(kInternal) when one is
/// above what was asked for.
void check_attributes(const Clip& clip, const EncoderInput& input,
                      const std::vector<StoredAttribute>& stored, uint32_t first_frame,
                      std::vector<AttributeResult>& results) {
  const bool free = clip.record().order == OrderMode::kFree;
  const uint32_t vertices = input.sequence.vertex_count;
  for (AttributeResult& result : results) {
    if (!result.kept)
      continue;
    const auto of = std::ranges::find(stored, result.number, &StoredAttribute::number);
    const Attribute& attribute = input.sequence.attributes[of->source];
    const uint32_t n = attribute.components;
    std::vector<float> played(size_t{vertices} * n);
    double squared = 0;
    for (uint32_t f = 0; f < clip.frame_count(); ++f) {
      clip.attribute_values(0, result.number, f, played.data());
      const float* source = attribute.values.data() + size_t{f + first_frame} * vertices * n;
      for (uint32_t v = 0; v < vertices; ++v) {
        const float* source_values = source + size_t{free ? input.layout.vertex_source[v] : v} * n;
        for (uint32_t c = 0; c < n; ++c) {
          const double d = static_cast<double>(source_values[c]) -
                           static_cast<double>(played[size_t{v} * n + c]);
          squared += d * d;
          result.max_error = std::max(result.max_error, std::abs(d));
        }
      }
    }
    result.rmse = std::sqrt(squared / n / vertices / clip.frame_count());
    if (result.max_error > result.asked)
      throw Error(ErrorKind::kInternal, attribute.name + ": the error is above what was asked for");
  }
}

/// Segments in the order of the file.
std::vector<const EncodedSegment*> all_segments(const Solution& solution,
                                                const MovingAttributes& moving) {
  std::vector<const EncodedSegment*> list = solution.segments();
  for (const CodedPart& part : moving.parts)
    list.push_back(&part.encoded);
  std::ranges::stable_sort(list, {}, [](const EncodedSegment* s) { return s->sizes.first_frame; });
  return list;
}

/// The clip and its moving attributes, coded.
struct EncodedClip {
  Solution positions;
  MovingAttributes attributes;
  Bytes file;
};

/// What the file says of the errors of attributes that move; 0 until they are measured.
Vector<AttributeError> errors_of(const std::vector<AttributeResult>& attributes) {
  Vector<AttributeError> errors;
  for (const AttributeResult& a : attributes) {
    if (a.kept)
      errors.push_back({0, static_cast<uint16_t>(a.number), a.max_error, a.rmse});
  }
  return errors;
}

/// Bytes of a file of a target that is a size; nothing for others.
std::optional<double> allowed_bytes(const Target& target, const MeshSequence& sequence) {
  if (target.metric == ErrorMetric::kSize)
    return target.value;
  if (target.metric == ErrorMetric::kBpfv)
    return target.value / 8 * sequence.vertex_count * sequence.frame_count;
  return std::nullopt;
}

/// Codes the clip. A size that is asked for is that of the file: positions get what the attributes
/// leave.
EncodedClip code(RateControl& control, const EncoderInput& input,
                 const std::vector<StoredAttribute>& stored, const EncodeOptions& options,
                 const Target& target, double clip_diagonal, ClipRecord record) {
  constexpr int kRounds = 4;
  constexpr double kRoom = 0.003;
  const std::optional<double> allowed = allowed_bytes(target, input.sequence);
  double positions_bytes = allowed.value_or(0);
  EncodedClip coded;
  Target remaining = target;
  for (int round = 0; round < kRounds; ++round) {
    if (round == 0) {
      coded.positions = control.solve();
    } else {
      RateControl retry(input, options, remaining, clip_diagonal);
      coded.positions = retry.solve();
    }
    coded.attributes = encode_moving_attributes(input, stored, options,
                                                coded.positions.parts[0].encoded.reference);
    record.attribute_errors = errors_of(coded.attributes.results);
    coded.file = clip_file(record, input.layout, all_segments(coded.positions, coded.attributes));
    const auto bytes = static_cast<double>(coded.file.size());
    if (!allowed || bytes <= *allowed || coded.attributes.parts.empty())
      break;
    // With another pose the attributes take some bytes more or less: room for them.
    positions_bytes -= bytes - *allowed + (round + 1) * kRoom * *allowed;
    remaining = {ErrorMetric::kSize, std::max(positions_bytes, 1.0), false};
  }
  return coded;
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
  EncoderInput input(std::move(sequence), options.mesh_coder, options.part);
  const std::vector<StoredAttribute> stored =
      encode_attributes(input.sequence, options.attributes, &input.layout);
  constexpr int kSlowEffort = 7;
  if (options.part)
    input.pose = pose_of_parts(input, target, clip_diagonal, options.effort >= kSlowEffort);
  RateControl control(input, options, target, clip_diagonal);
  SearchProgress search(progress, control.expected_trials());
  input.on_trial = [&search] { search.trial(); };
  EncodedClip coded = code(control, input, stored, options, target, clip_diagonal, record);

  const Clip clip = opened(coded.file);
  Comparison measured = check_positions(clip, input);
  control.require_kept(measured.kg, measured.rmse, measured.max_error, coded.file.size());
  std::vector<AttributeResult>& attributes = coded.attributes.results;
  check_attributes(clip, input, stored, options.part ? options.part->first : 0, attributes);
  record.kg = measured.kg;
  record.rmse = measured.rmse;
  record.max_error = measured.max_error;

  record.attribute_errors = errors_of(attributes);

  EncodeResult result;
  result.file = clip_file(record, input.layout, all_segments(coded.positions, coded.attributes));
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
  result.trials = control.trials();
  return result;
}

}  // namespace anicodec
