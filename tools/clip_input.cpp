// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/clip_input.h"

#include "codec/attribute_encode.h"
#include "format/container.h"
#include "tools/io/byte_source.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {

bool is_anic(const std::string& path) {
  constexpr std::string_view kExtension = ".anic";
  return path.size() >= kExtension.size() &&
         std::equal(kExtension.rbegin(), kExtension.rend(), path.rbegin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

ErrorKind error_kind(Status status) {
  switch (status) {
    case Status::kVersion:
    case Status::kFeature:
    case Status::kCoder:
    case Status::kChunkUnknown:
    case Status::kLimit:
      return ErrorKind::kUnsupported;
    case Status::kArgument:
    case Status::kState:
    case Status::kBufferSize:
    case Status::kFrameRange:
    case Status::kMemory:
    case Status::kInternal:
      return ErrorKind::kInternal;
    case Status::kRead:
      return ErrorKind::kInput;
    default:
      return ErrorKind::kCorrupt;
  }
}

void fail_clip(const std::string& path, const Failure& failure) {
  std::string text = path + ": ";
  if (failure.status != Status::kMagic)
    text += fmt::format("offset {:#x}", failure.offset);
  if (failure.chunk != 0)
    text += ", chunk " + format::chunk_name(failure.chunk);
  text += failure.status != Status::kMagic ? ": " : "";
  text += status_string(failure.status);
  if (*failure.detail)
    text += fmt::format(" ({})", failure.detail);
  throw Error(error_kind(failure.status), text);
}

std::string read_bytes(const std::string& path) {
  std::string bytes;
  if (path == "-") {
    read_standard_input(bytes);
    return bytes;
  }
  read_file(path, bytes);
  return bytes;
}

void open_clip(const std::string& path, const std::string& bytes, const OpenOptions& options,
               Clip& clip, Topologies allowed) {
  if (Failure failure = clip.open(view_of(bytes), options); !failure.ok())
    fail_clip(path, failure);
  if (allowed == Topologies::kOne && clip.meshes().size() != 1)
    throw Error(ErrorKind::kUnsupported,
                fmt::format("{}: {} meshes, where one is wanted; decode makes files of the frames",
                            path, clip.meshes().size()));
}

MeshFrames frames_of_mesh(const Clip& clip, uint32_t mesh) {
  MeshFrames frames{UINT32_MAX, 0};
  for (const format::Limits::Segment& s : clip.limits().segments) {
    if (s.mesh != mesh || s.attribute != format::kPositions)
      continue;
    frames.first = std::min(frames.first, s.first_frame);
    frames.end = std::max(frames.end, s.first_frame + s.frames);
  }
  return frames;
}

MeshSequence describe_clip(const Clip& clip, uint32_t mesh) {
  const format::ClipRecord& record = clip.record();
  const Topology& topology = clip.meshes()[mesh].topology;
  MeshSequence sequence;
  sequence.name.assign(record.name.begin(), record.name.end());
  sequence.polygons.offsets.assign(topology.polygon_offsets.begin(),
                                   topology.polygon_offsets.end());
  sequence.polygons.corners.assign(topology.polygon_corners.begin(),
                                   topology.polygon_corners.end());
  sequence.vertex_count = clip.vertex_count(mesh);
  sequence.frame_count = clip.frame_count();
  sequence.rate = {record.rate_numerator, record.rate_denominator, record.rate_assumed};
  sequence.start_time = record.start_time;
  sequence.times.assign(record.times.begin(), record.times.end());
  sequence.up = static_cast<UpAxis>(record.up);
  sequence.metres_per_unit = record.metres_per_unit;
  restore_attributes(clip.meshes()[mesh].attributes, &sequence);
  return sequence;
}

std::function<std::vector<Attribute>(uint32_t)> play_attributes(const Clip& clip, uint32_t mesh) {
  const bool moves = std::ranges::any_of(clip.tracks(), [mesh](const Track& track) {
    return track.mesh == mesh && track.is_attribute();
  });
  if (!moves)
    return {};
  return [&clip, mesh](uint32_t frame) {
    const Vector<MeshAttribute>& decoded = clip.meshes()[mesh].attributes;
    MeshSequence sequence;
    restore_attributes(decoded, &sequence);
    size_t restored = 0;
    for (uint32_t i = 0; i < decoded.size(); ++i) {
      if (decoded[i].header.components() == 0)
        continue;
      Attribute& attribute = sequence.attributes[restored++];
      if (!attribute.per_corner)
        clip.attribute_values(mesh, i, frame, attribute.values.data());
    }
    return std::move(sequence.attributes);
  };
}

FrameSource play(const std::string& path, const Clip& clip, uint32_t mesh) {
  auto positions = std::make_shared<std::vector<float>>(size_t{3} * clip.vertex_count(mesh));
  return [path, &clip, mesh, positions](uint32_t frame) -> std::span<const float> {
    Status status = clip.positions(mesh, frame, positions->data());
    if (status != Status::kOk)
      throw Error(error_kind(status),
                  fmt::format("{}: frame {}: {}", path, frame, status_string(status)));
    return *positions;
  };
}

}  // namespace anicodec::tools
