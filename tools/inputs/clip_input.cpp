// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/clip_input.h"

#include "codec/connectivity/attribute_encode.h"
#include "codec/file/left_out.h"
#include "codec/file/live_stream.h"
#include "codec/sequence/scene.h"
#include "format/container.h"
#include "tools/io/base/printable.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// The meshes themselves, without positions and timing.
std::vector<MeshSequence> describe_meshes(const Clip& clip, const std::vector<uint32_t>& meshes) {
  std::vector<MeshSequence> described;
  for (uint32_t m : meshes) {
    const anicodec::Mesh& mesh = clip.meshes()[m];
    const Topology& topology = mesh.topology;
    MeshSequence& out = described.emplace_back();
    out.mesh_name.assign(mesh.name.begin(), mesh.name.end());
    out.polygons.offsets.assign(topology.polygon_offsets.begin(), topology.polygon_offsets.end());
    out.polygons.corners.assign(topology.polygon_corners.begin(), topology.polygon_corners.end());
    out.vertex_count = clip.vertex_count(m);
    restore_attributes(mesh.attributes, &out);
  }
  return described;
}

/// The frame, or where it does not show a mesh the last one before that does, or the first.
uint32_t shown_frame(const std::vector<FrameRun>& present_in, uint32_t frame) {
  uint32_t shown = present_in.empty() ? frame : present_in[0].first;
  for (const FrameRun& run : present_in) {
    if (run.first <= frame)
      shown = std::min(frame, run.first + run.count - 1);
  }
  return shown;
}

}  // namespace

bool is_anic(const std::string& path) {
  constexpr std::string_view kExtension = ".anic";
  return path.size() >= kExtension.size() &&
         std::equal(kExtension.rbegin(), kExtension.rend(), path.rbegin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

void check_anic_output(const std::string& path) {
  const std::filesystem::path name(path);
  if (is_anic(path) || name.extension().empty())
    return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: the output is an .anic file, not {} (for other formats: decode)",
                          path, name.extension().string()));
}

ErrorKind error_kind(Status status) {
  switch (status) {
    case Status::kVersion:
    case Status::kFeature:
    case Status::kChunkUnknown:
    case Status::kLimit:
      return ErrorKind::kUnsupported;
    case Status::kArgument:
    case Status::kState:
    case Status::kBufferSize:
    case Status::kFrameRange:
    case Status::kAbsent:
    case Status::kMemory:
    case Status::kCancelled:
    case Status::kInternal:
      return ErrorKind::kInternal;
    case Status::kRead:
      return ErrorKind::kInput;
    default:
      return ErrorKind::kCorrupt;
  }
}

void fail_clip(const std::string& path, const Failure& failure) {
  if (failure.status == Status::kMagic && kind_of(path) != FileKind::kUnknown)
    throw Error(
        ErrorKind::kInput,
        path + ": is no .anic file; encode makes one of a scene, or of a mesh and its frames");
  std::string text = path + ": ";
  if (failure.status != Status::kMagic)
    text += fmt::format("offset {:#x}", failure.offset);
  if (failure.chunk != 0)
    text += ", chunk " + chunk_name(failure.chunk);
  text += failure.status != Status::kMagic ? ": " : "";
  text += status_string(failure.status);
  if (*failure.detail)
    text += fmt::format(" ({})", failure.detail);
  throw Error(error_kind(failure.status), text);
}

std::string join_stream(const std::string& path, const std::string& bytes) {
  const LiveStream stream = read_live_stream({path, view_of(bytes)});
  if (stream.incomplete > 0)
    fmt::print(stderr, "{}: the last {} bytes are of a file that is not complete, and left out\n",
               printable(path), stream.incomplete);
  std::vector<ClipPart> parts;
  for (const Bytes& file : stream.files)
    parts.push_back({fmt::format("{}, file {}", path, parts.size() + 1), file});
  const Bytes clip = join_clips(parts);
  for (const std::string& line : list_left_out(parts, clip))
    fmt::print(stderr, "{}\n", printable(line));
  return {reinterpret_cast<const char*>(clip.data()), clip.size()};
}

std::string read_clip_bytes(const std::string& path) {
  std::string bytes;
  if (path == "-")
    read_standard_input(bytes);
  else
    read_file(path, bytes);
  if (std::optional<std::string> clip = clip_of_glb(bytes, path))
    return *std::move(clip);
  return bytes;
}

std::string read_bytes(const std::string& path) {
  std::string bytes = read_clip_bytes(path);
  return is_live_stream(view_of(bytes)) ? join_stream(path, bytes) : bytes;
}

bool takes_turns(const Clip& clip) {
  const std::vector<uint32_t> meshes = meshes_of(clip);
  for (uint32_t f = 0; f < clip.frame_count() && meshes.size() > 1; ++f) {
    if (std::ranges::count_if(meshes, [&](uint32_t m) { return clip.segment_at(m, f); }) > 1)
      return false;
  }
  return meshes.size() > 1;
}

void open_clip(const std::string& path, const std::string& bytes, const OpenOptions& options,
               Clip& clip, Topologies allowed) {
  if (Failure failure = clip.open(view_of(bytes), options); !failure.ok())
    fail_clip(path, failure);
  if (allowed == Topologies::kOne && takes_turns(clip))
    throw Error(ErrorKind::kUnsupported,
                fmt::format("{}: {} meshes that take turns, where the frames must have one; decode "
                            "makes files of the frames",
                            path, clip.meshes().size()));
}

void choose_clip(const std::string& path, const std::string& name, Clip& clip) {
  if (name == "all" || (name.empty() && clip.clips().size() == 1))
    return;
  const size_t chosen = clip.record().find(name.c_str());
  if (!name.empty() && chosen < clip.clips().size())
    return clip.take_clip(static_cast<uint32_t>(chosen));
  std::string names;
  for (const ClipRecord& c : clip.clips())
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", c.name);
  throw Error(ErrorKind::kUsage,
              name.empty()
                  ? fmt::format("{}: has several clips, one of them must be chosen, or all: {}",
                                path, names)
                  : fmt::format("{}: there is no clip '{}'; it has {}", path, name, names));
}

std::vector<uint32_t> meshes_of(const Clip& clip) {
  std::vector<uint32_t> meshes(clip.meshes().size());
  std::iota(meshes.begin(), meshes.end(), 0U);
  return meshes;
}

std::vector<FrameRun> frames_of_mesh(const Clip& clip, uint32_t mesh) {
  std::vector<FrameRun> runs;
  for (uint32_t f = 0; f < clip.frame_count(); ++f) {
    if (!clip.segment_at(mesh, f))
      continue;
    if (runs.empty() || runs.back().first + runs.back().count != f)
      runs.push_back({f, 0});
    ++runs.back().count;
  }
  return runs;
}

MeshSequence describe_clip(const Clip& clip, const std::vector<uint32_t>& meshes) {
  std::vector<MeshSequence> described = describe_meshes(clip, meshes);
  MeshSequence sequence = described.size() == 1 && described[0].mesh_name.empty()
                              ? std::move(described[0])
                              : merge_meshes(described);
  const ClipRecord& record = clip.clips()[0];
  sequence.name.assign(record.name.begin(), record.name.end());
  sequence.frame_count = clip.frame_count();
  sequence.rate = {record.rate_numerator, record.rate_denominator, record.rate_assumed};
  sequence.start_time = record.start_time;
  sequence.loop = record.loop;
  if (clip.clips().size() == 1)
    sequence.times.assign(record.times.begin(), record.times.end());
  sequence.up = static_cast<UpAxis>(clip.record().up);
  sequence.metres_per_unit = clip.record().metres_per_unit;
  std::copy_n(clip.record().origin, 3, sequence.origin.begin());
  return sequence;
}

std::vector<ClipTiming> clip_timings(const Clip& clip) {
  std::vector<ClipTiming> timings;
  for (const ClipRecord& record : clip.clips()) {
    ClipTiming& timing = timings.emplace_back();
    timing.name.assign(record.name.begin(), record.name.end());
    timing.frame_count = record.frames;
    timing.rate = {record.rate_numerator, record.rate_denominator, record.rate_assumed};
    timing.start_time = record.start_time;
    timing.times.assign(record.times.begin(), record.times.end());
    timing.loop = record.loop;
    for (const ClipEvent& event : record.events)
      timing.events.push_back({{event.name.begin(), event.name.end()}, event.seconds});
  }
  if (timings.size() == 1)
    timings.clear();
  return timings;
}

FrameSource play(const std::string& path, const Clip& clip, const std::vector<uint32_t>& meshes) {
  struct Part {
    uint32_t mesh;
    std::vector<FrameRun> present_in;
    size_t first, count;  // floats
  };

  std::vector<Part> parts;
  size_t count = 0;
  for (uint32_t m : meshes) {
    parts.push_back({m, frames_of_mesh(clip, m), count, size_t{3} * clip.vertex_count(m)});
    count += parts.back().count;
  }
  auto positions = std::make_shared<std::vector<float>>(count);
  return [path, &clip, parts, positions](uint32_t frame) -> std::span<const float> {
    for (const Part& part : parts) {
      const uint32_t shown = shown_frame(part.present_in, frame);
      const std::span<float> own(positions->data() + part.first, part.count);
      const Status status = clip.positions(part.mesh, shown, own.data());
      if (status != Status::kOk)
        throw Error(error_kind(status),
                    fmt::format("{}: frame {}: {}", path, frame, status_string(status)));
      for (size_t i = 3; shown != frame && i < own.size(); ++i)
        own[i] = own[i - 3];
    }
    return *positions;
  };
}

AttributeSource play_attributes(const Clip& clip, const std::vector<uint32_t>& meshes) {
  const bool moves = std::ranges::any_of(clip.tracks(), [&](const Track& track) {
    return track.is_attribute() && std::ranges::count(meshes, track.mesh) > 0;
  });
  if (!moves)
    return {};
  std::vector<std::vector<FrameRun>> present_in;
  for (uint32_t mesh : meshes)
    present_in.push_back(frames_of_mesh(clip, mesh));
  return [&clip, meshes, present_in,
          described = describe_meshes(clip, meshes)](uint32_t frame) mutable {
    for (size_t m = 0; m < meshes.size(); ++m) {
      const Vector<MeshAttribute>& decoded = clip.meshes()[meshes[m]].attributes;
      const uint32_t shown = shown_frame(present_in[m], frame);
      size_t restored = 0;
      for (uint32_t i = 0; i < decoded.size(); ++i) {
        if (decoded[i].header.components() == 0)
          continue;
        Attribute& attribute = described[m].attributes[restored++];
        clip.attribute_values(meshes[m], i, shown, attribute.values.data());
      }
    }
    return described.size() == 1 ? described[0].attributes : merge_meshes(described).attributes;
  };
}

}  // namespace anicodec::tools
