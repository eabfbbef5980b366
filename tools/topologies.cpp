// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/topologies.h"

#include "codec/error.h"
#include "codec/join_clips.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// Length of the diagonal of the box around all frames.
double diagonal_of(const std::vector<MeshSequence>& runs) {
  MeshSequence corners;  // two vertices: of the box around each
  for (const MeshSequence& run : runs) {
    float low[3] = {run.positions[0], run.positions[1], run.positions[2]};
    float high[3] = {low[0], low[1], low[2]};
    for (size_t i = 0; i < run.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], run.positions[i]);
      high[i % 3] = std::max(high[i % 3], run.positions[i]);
    }
    corners.positions.insert(corners.positions.end(), low, low + 3);
    corners.positions.insert(corners.positions.end(), high, high + 3);
  }
  return diagonal(corners);
}

}  // namespace

EncodeResult encode_topologies(std::vector<MeshSequence> runs, EncodeOptions options,
                               const std::string& name, const Progress& progress) {
  if (options.target.metric == format::ErrorMetric::kSize)
    throw Error(ErrorKind::kUsage, "--size cannot be shared out among topologies");
  const double length = diagonal_of(runs);
  for (Target* target : {&options.target, options.cap ? &*options.cap : nullptr}) {
    if (target && target->percent)
      *target = {target->metric, target->value / 100 * length, false};
  }
  EncodeResult all;
  std::vector<EncodeResult> results;
  for (MeshSequence& run : runs) {
    const uint32_t first = all.frames;
    all.frames += run.frame_count;
    try {
      results.push_back(encode(std::move(run), options, progress));
    } catch (const Error& e) {
      throw Error(e.kind(), fmt::format("{}: frames {}:{}: {}", name, first, all.frames, e.what()));
    }
  }
  std::vector<ClipPart> parts;
  for (const EncodeResult& result : results) {
    parts.push_back({name, result.file});
    all.vertices = std::max(all.vertices, result.vertices);
    all.faces = std::max(all.faces, result.faces);
    all.kind = result.kind;
    all.components = std::max(all.components, result.components);
    all.max_error = std::max(all.max_error, result.max_error);
    all.kg = std::max(all.kg, result.kg);
    all.rmse = std::max(all.rmse, result.rmse);
    all.attributes.insert(all.attributes.end(), result.attributes.begin(), result.attributes.end());
    all.trials.insert(all.trials.end(), result.trials.begin(), result.trials.end());
  }
  all.diagonal = length;
  all.file = join_topologies(parts);
  return all;
}

}  // namespace anicodec::tools
