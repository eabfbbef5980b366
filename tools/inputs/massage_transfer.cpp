// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/massage_transfer.h"

#include "codec/remesh/remesh.h"
#include "codec/sequence/error.h"
#include "tools/io/file_formats.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace anicodec::tools {

SurfaceChange TransferredInput::change() const {
  SurfaceChange change;
  for (const TransferredFrame& frame : result.frames) {
    change.mean += frame.mean / static_cast<double>(result.frames.size());
    change.max = std::max(change.max, frame.max);
  }
  return change;
}

std::string TransferredInput::reason(uint32_t f) const {
  const TransferredFrame& frame = result.frames[f];
  return fmt::format(
      "{}: {} (mean distance {:.3g} % of the diagonal, turned {:.2f} %, distortion {:.3f}, "
      "dropped {:.1f} %)",
      files[f], alarm_names(frame.alarms), 100 * frame.tried_mean / result.diagonal, frame.turned,
      frame.conformal, frame.dropped);
}

TransferredInput transfer_inputs(std::span<const std::string> inputs, const Progress& progress,
                                 const std::optional<Count>& vertices) {
  TransferredInput input;
  input.files = sequence_files(inputs);
  for (const std::string& file : input.files) {
    if (is_cache(file))
      throw Error(ErrorKind::kUsage,
                  file + ": a vertex cache has one connectivity; there is nothing to transfer");
  }
  auto source = [&input](uint32_t f) {
    MeshSequence mesh = load_sequence({&input.files[f], 1});
    return SurfaceFrame{std::move(mesh.polygons), std::move(mesh.positions)};
  };
  TransferOptions options;
  if (vertices) {
    options.first_mesh = [&vertices](const SurfaceFrame& frame) {
      RemeshOptions remeshing;
      remeshing.vertices = vertices->of(static_cast<uint32_t>(frame.positions.size() / 3));
      return remesh(frame, remeshing).mesh;
    };
  }
  input.result =
      transfer_connectivity(source, static_cast<uint32_t>(input.files.size()), options, progress);
  for (TransferSegment& segment : input.result.segments)
    segment.sequence.name = std::filesystem::path(input.files[0]).stem().string();
  return input;
}

MeshSequence transfer_to_one(std::span<const std::string> inputs, const Progress& progress,
                             SurfaceChange* change) {
  TransferredInput input = transfer_inputs(inputs, progress);
  if (input.result.segments.size() > 1) {
    const uint32_t f = input.result.segments[1].first_frame;
    throw Error(ErrorKind::kInput,
                fmt::format("frame {} cannot be given the connectivity of frame 0: {}; a file "
                            "holds one connectivity (anicodec massage transfer writes a clip "
                            "for each)",
                            f, input.reason(f)));
  }
  *change = input.change();
  return std::move(input.result.segments[0].sequence);
}

}  // namespace anicodec::tools
