// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/encode.h"

#include "codec/clip_file.h"
#include "codec/error.h"
#include "codec/keyframe_search.h"
#include "codec/metrics.h"
#include "codec/rate_control.h"
#include "codec/search_progress.h"
#include "sdk/clip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anicodec {
namespace {

/// Whether a clip ends where it began.
bool is_closed(const MeshSequence& sequence) {
  return sequence.frame_count > 1 &&
         std::ranges::equal(sequence.frame(0), sequence.frame(sequence.frame_count - 1));
}

format::ClipRecord describe(const MeshSequence& sequence, const EncodeOptions& options,
                            const Target& target, double clip_diagonal) {
  format::ClipRecord record;
  record.name = sequence.name;
  record.encoder = options.encoder;
  record.rate_numerator = sequence.rate.numerator;
  record.rate_denominator = sequence.rate.denominator;
  record.rate_assumed = sequence.rate.assumed;
  record.loop = sequence.loop;
  record.closed = is_closed(sequence);
  record.up = static_cast<uint8_t>(sequence.up);
  record.order = options.order;
  record.start_time = sequence.start_time;
  record.metres_per_unit = sequence.metres_per_unit;
  record.times = sequence.times;
  record.asked = target.metric;
  record.asked_value = target.value;
  record.diagonal = clip_diagonal;
  return record;
}

/// Plays a file and compares it with the source, in the source's vertex order whatever the file's.
Comparison check_file(const format::Bytes& file, const MeshSequence& sequence,
                      const MeshLayout& layout) {
  Clip clip;
  if (Failure failure = clip.open(file); !failure.ok())
    throw Error(ErrorKind::kInternal,
                std::string("the encoded file cannot be opened: ") + status_string(failure.status));
  if (Failure failure = clip.check_hashes(); !failure.ok())
    throw Error(ErrorKind::kInternal, "the encoded file decodes to other integers");
  std::vector<float> played(size_t{3} * sequence.vertex_count), ordered;
  const std::vector<uint32_t>& coded = clip.meshes()[0].topology.vertex_coded;
  bool source_order = clip.record().order != format::OrderMode::kFree;
  std::vector<uint32_t> place(layout.sizes.coded_vertices);  // a played vertex of each coded one
  for (uint32_t v = 0; v < coded.size(); ++v)
    place[coded[v]] = v;
  CompareOptions options;
  options.sted = false;
  return compare(
      sequence.polygons, sequence.vertex_count, sequence.frame_count,
      [&](uint32_t f) { return sequence.frame(f); },
      [&](uint32_t f) -> std::span<const float> {
        clip.positions(0, f, played.data());
        if (source_order)
          return played;
        ordered.resize(played.size());
        for (size_t v = 0; v < sequence.vertex_count; ++v)
          std::copy_n(played.begin() + ptrdiff_t{3} * place[layout.source_coded[v]], 3,
                      ordered.begin() + static_cast<ptrdiff_t>(3 * v));
        return ordered;
      },
      options);
}

}  // namespace

EncodeResult encode(const MeshSequence& sequence, const EncodeOptions& options,
                    const Progress& progress) {
  check(sequence);
  double clip_diagonal = diagonal(sequence);
  Target target = in_scene_units(options.target, clip_diagonal);
  if (target.metric == format::ErrorMetric::kNone && !options.keyframes)
    throw Error(ErrorKind::kUsage, "an error, a size, or a number of key-frames must be asked for");

  EncoderInput input(sequence, options.mesh_coder);
  RateControl control(input, options, target, clip_diagonal);
  SearchProgress search(progress, control.expected_trials());
  input.on_trial = [&search] { search.trial(); };
  Solution solution = control.solve();
  for (Part& part : solution.parts) {
    if (!part.encoded.corrections.empty())  // added after it was opened
      part.opened = open_encoded(part.encoded, input.layout);
  }

  format::ClipRecord record = describe(sequence, options, target, clip_diagonal);
  format::Bytes file = clip_file(record, input.layout, solution.segments());
  Comparison measured = check_file(file, sequence, input.layout);
  control.require_kept(measured.kg, measured.rmse, measured.max_error, file.size());
  record.kg = measured.kg;
  record.rmse = measured.rmse;
  record.max_error = measured.max_error;

  EncodeResult result;
  result.file = clip_file(record, input.layout, solution.segments());
  result.kind = solution.parts[0].encoded.sizes.kind;
  result.components = solution.parts[0].encoded.sizes.components;
  result.kg = measured.kg;
  result.rmse = measured.rmse;
  result.max_error = measured.max_error;
  result.diagonal = clip_diagonal;
  result.trials = control.trials();
  return result;
}

}  // namespace anicodec
