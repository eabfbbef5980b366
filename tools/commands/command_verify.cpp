// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/file/live_stream.h"
#include "codec/sequence/error.h"
#include "format/bounds_record.h"
#include "format/container.h"
#include "format/metadata.h"
#include "sdk/clip/file_checks.h"
#include "sdk/clip/sample.h"
#include "tools/inputs/clip_input.h"
#include "tools/inputs/stream_input.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace anicodec::tools {
namespace {

constexpr const char* kVerifyFooter =
    R"(Checks every byte: header, table, the checksum of every chunk, and padding; decodes everything;
compares the decoded integers with the hash the encoder stored; plays every frame, which must lie in
the boxes that the file keeps. No source is needed. The files of a live stream are checked one
after the other, and a lost one is named.

--json prints an object for each file: file, ok, bytes, chunks, frames, meshes; of a live stream
files, keys (that begin anew) and incomplete_bytes instead of meshes; of one that fails: error,
status.)";

/// Checksums of all chunks, those included that this version does not know. Returns their number.
size_t check_chunks(const std::string& path, const std::string& bytes) {
  ContainerReader reader;
  if (Failure failure = reader.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
  for (const Chunk& chunk : reader.chunks()) {
    ByteView payload;
    if (Failure failure = reader.payload(chunk, &payload); !failure.ok())
      fail_clip(path, failure);
  }
  return reader.chunks().size();
}

/// Plays a frame that shows a mesh.
void play(const std::string& path, const Clip& clip, uint32_t mesh, uint32_t frame,
          std::vector<float>* positions) {
  positions->resize(size_t{3} * clip.vertex_count(mesh));
  const Status status = show_positions(clip, mesh, frame, positions->data());
  if (status != Status::kOk)
    throw Error(error_kind(status),
                fmt::format("{}: frame {}: {}", path, frame, status_string(status)));
}

void check_frames(const std::string& path, const Clip& clip, ProgressLine& line) {
  std::vector<float> positions;
  for (uint32_t mesh = 0; mesh < clip.meshes().size(); ++mesh) {
    const Track& track = clip.tracks()[mesh];
    for (uint32_t i = track.begin; i < track.end; ++i) {
      const Segment& segment = clip.segments()[clip.by_frame()[i]];
      for (uint32_t f = segment.first_frame; f < segment.first_frame + segment.frames; ++f) {
        line.show("playing", static_cast<double>(f) / clip.frame_count());
        play(path, clip, mesh, f, &positions);
        for (size_t k = 0; k < positions.size(); ++k) {
          if (!std::isfinite(positions[k]))
            throw Error(ErrorKind::kCorrupt,
                        fmt::format("{}: frame {}: vertex {} is not finite", path, f, k / 3));
        }
      }
    }
  }
}

/// Makes a box larger by what decoders may differ by (spec/09a-segments.md, section 7).
void widen(uint32_t components, anicodec::Box* box) {
  float largest = 0;
  for (size_t c = 0; c < 3; ++c)
    largest = std::max({largest, std::abs(box->low[c]), std::abs(box->high[c])});
  const float tolerance = static_cast<float>(components + 16) * largest / (1 << 23);
  for (size_t c = 0; c < 3; ++c) {
    box->low[c] -= tolerance;
    box->high[c] += tolerance;
  }
}

/// Metadata and boxes, which no opening looks at: boxes must hold all positions.
void check_unopened(const std::string& path, const std::string& bytes, const Clip& clip) {
  ContainerReader reader;
  if (Failure failure = reader.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
  for (const Chunk& chunk : reader.chunks()) {
    const ByteView payload = reader.unchecked(chunk);
    if (chunk.type == chunk_type("META") && !is_metadata(payload))
      fail_clip(path, failure_in(chunk, Status::kRecord,
                                 "the metadata is too long, too deep, or no UTF-8"));
    if (chunk.type == chunk_type("META") &&
        !nlohmann::json::parse(payload.data, payload.data + payload.size, nullptr, false)
             .is_object())
      throw Error(ErrorKind::kCorrupt, path + ": chunk META: is not a JSON object");
    if (chunk.type != chunk_type("BNDS"))
      continue;
    const Limits::Segment& segment = clip.limits().segments[chunk.segment];
    BoundsRecord bounds;
    if (Status s = BoundsRecord::read(payload, segment.frames, &bounds); s != Status::kOk)
      fail_clip(path, failure_in(chunk, s, "the boxes are malformed"));
    std::vector<float> positions;
    for (uint32_t f = 0; f < segment.frames; ++f) {
      anicodec::Box box = bounds.of_frame(f);
      widen(segment.components, &box);
      play(path, clip, segment.mesh, segment.first_frame + f, &positions);
      for (size_t i = 0; i < positions.size(); ++i) {
        if (positions[i] < box.low[i % 3] || positions[i] > box.high[i % 3])
          throw Error(ErrorKind::kCorrupt,
                      fmt::format("{}: chunk BNDS: frame {}: vertex {} is outside of its box", path,
                                  segment.first_frame + f, i / 3));
      }
    }
  }
}

/// Checks an opened clip. Returns the number of its chunks.
size_t check_clip(const std::string& path, const std::string& bytes, const Clip& clip,
                  ProgressLine& line) {
  const size_t chunks = check_chunks(path, bytes);
  if (Failure failure = clip.check_hashes(); !failure.ok())
    fail_clip(path, failure);
  check_frames(path, clip, line);
  check_unopened(path, bytes, clip);
  return chunks;
}

/// Checks the files of a live stream as a program that plays them gets them.
void verify_stream(const std::string& path, const std::string& bytes, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  size_t chunks = 0;
  uint64_t frames = 0;
  const StreamContents stream =
      read_stream(path, view_of(bytes),
                  [&](const StreamedFile& file, const std::string& whole, const Clip& clip) {
                    chunks += check_clip(file.name, whole, clip, line);
                    frames += file.frames;
                  });
  line.clear();
  check_losses(path, stream);
  const auto keys = std::ranges::count_if(stream.files, &StreamedFile::is_key);
  if (common.json)
    print_json({{"file", path},
                {"ok", true},
                {"bytes", bytes.size()},
                {"chunks", chunks},
                {"frames", frames},
                {"files", stream.files.size()},
                {"keys", keys},
                {"incomplete_bytes", stream.incomplete}});
  else if (!common.quiet)
    print_line("{}: ok ({} bytes, {} of a live stream, {} of which begin anew, {}{})", path,
               grouped(bytes.size()), counted(stream.files.size(), "file"), keys,
               counted(frames, "frame"),
               stream.incomplete > 0
                   ? fmt::format(", and {} bytes of a file that is not complete", stream.incomplete)
                   : "");
}

void verify(const std::string& path, const CommonOptions& common) {
  const std::string bytes = read_clip_bytes(path);
  if (is_live_stream(view_of(bytes)))
    return verify_stream(path, bytes, common);
  ProgressLine line(common.quiet);
  check_chunks(path, bytes);
  Clip clip;
  if (Failure failure = clip.open(view_of(bytes)); !failure.ok())
    fail_clip(path, failure);
  const size_t chunks = check_clip(path, bytes, clip, line);
  line.clear();
  if (common.json)
    print_json({{"file", path},
                {"ok", true},
                {"bytes", bytes.size()},
                {"chunks", chunks},
                {"frames", clip.frame_count()},
                {"meshes", clip.meshes().size()}});
  else if (!common.quiet)
    print_line("{}: ok ({} bytes, {} chunks, {} frames of {})", path, grouped(bytes.size()), chunks,
               clip.frame_count(),
               clip.meshes().size() == 1 ? fmt::format("{} vertices", clip.vertex_count())
                                         : fmt::format("{} meshes", clip.meshes().size()));
}

}  // namespace

void add_verify(Commands& commands, CommonOptions& common) {
  auto inputs = std::make_shared<std::vector<std::string>>();
  Options& options = add_command(
      commands, common, kQuiet | kJson,
      {"verify", "FILE.anic...", "Check .anic files: checksums and a full decode", kVerifyFooter},
      [inputs, &common] {
        run_for_each(*inputs, common, [&](const std::string& path) { verify(path, common); });
      });
  options.arguments("FILE", *inputs, "The .anic files to check").required();
}

}  // namespace anicodec::tools
