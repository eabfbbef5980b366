// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/bench/bench_encode.h"

#include "codec/sequence/error.h"
#include "format/container.h"
#include "format/records.h"
#include "tests/bench/stopwatch.h"
#include "tools/inputs/clip_input.h"
#include "tools/words/version.h"

#include <algorithm>

#include <fmt/format.h>

namespace anicodec::bench {
namespace {

void require(bool ok) {
  if (!ok)
    throw Error(ErrorKind::kInternal, "the encoded file cannot be read");
}

}  // namespace

ByteShares byte_shares(ByteView file) {
  ContainerReader container;
  require(container.open(file).ok());
  ByteShares shares;
  for (const Chunk& chunk : container.chunks()) {
    ByteView payload;
    require(container.payload(chunk, &payload).ok());
    if (chunk.type == chunk_type("MESH")) {
      shares.mesh += chunk.size;
    } else if (chunk.type == chunk_type("POSE")) {
      shares.pose += chunk.size;
    } else if (chunk.type == chunk_type("SEGM")) {
      SegmentRecord record;
      require(SegmentRecord::read(payload, &record) == Status::kOk);
      shares.pose += record.pose.size;
      shares.weights += record.weights.size;
      shares.basis += record.parameters.size;
    } else if (chunk.type == chunk_type("BASI")) {
      ByteReader layer(payload);
      layer.varint();
      const uint64_t weights = layer.varint();
      shares.weights += weights;
      shares.basis += chunk.size - weights;
    } else if (chunk.type == chunk_type("CORR")) {
      shares.corrections += chunk.size;
    }
  }
  shares.rest =
      file.size - shares.mesh - shares.pose - shares.weights - shares.basis - shares.corrections;
  return shares;
}

void open_encoded(ByteView file, Clip& clip, const OpenOptions& options) {
  if (Failure failure = clip.open(file, options); !failure.ok())
    tools::fail_clip("the encoded clip", failure);
}

ByteView up_to_the_first(const char (&type)[5], ByteView file) {
  ContainerReader container;
  if (!container.open(file).ok())
    return file;
  for (const Chunk& chunk : container.chunks()) {
    if (chunk.type == chunk_type(type))
      return {file.data, static_cast<size_t>(chunk.offset + chunk.size)};
  }
  return file;
}

TimedEncode encode_timed(MeshSequence sequence, const Target& target, BasisChoice basis,
                         Effort effort, bool verbose, OrderMode order, bool smallest) {
  EncodeOptions options;
  options.target = target;
  options.basis = basis;
  options.order = order;
  options.effort = effort;
  options.smallest = smallest;
  options.encoder = fmt::format("anicodec {}", tools::version());

  TimedEncode timed;
  Stopwatch wall(CLOCK_MONOTONIC), cpu(CLOCK_PROCESS_CPUTIME_ID);
  std::string stage = "start";
  double stage_start = 0;
  auto finish_stage = [&](std::string_view next) {
    double now = cpu.seconds();
    timed.stages[stage] = timed.stages.value(stage, 0.0) + now - stage_start;
    stage = next;
    stage_start = now;
  };
  timed.result = encode(std::move(sequence), options, [&](std::string_view name, double) {
    if (name != stage)
      finish_stage(name);
  });
  finish_stage("");
  timed.wall_seconds = wall.seconds();
  timed.cpu_seconds = cpu.seconds();
  if (verbose) {
    for (const Trial& trial : timed.result.trials)
      fmt::print(stderr, "  tried {:<40} {:>10} bytes  RMSE {:<10.4g} max error {:.4g}\n",
                 trial.what, trial.bytes, trial.rmse, trial.max_error);
    for (const auto& [name, seconds] : timed.stages.items())
      fmt::print(stderr, "  stage {:<34} {:>8.2f} s\n", name, seconds.get<double>());
  }
  return timed;
}

double bpfv(uint64_t bytes, const MeshSequence& sequence) {
  return 8 * static_cast<double>(bytes) /
         (static_cast<double>(sequence.vertex_count) * sequence.frame_count);
}

}  // namespace anicodec::bench
