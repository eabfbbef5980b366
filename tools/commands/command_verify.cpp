// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/sequence/error.h"
#include "format/container.h"
#include "sdk/clip/clip.h"
#include "tools/inputs/clip_input.h"
#include "tools/program/command.h"
#include "tools/program/print.h"
#include "tools/words/progress_line.h"
#include "tools/words/quantity.h"

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
compares the decoded integers with the hash the encoder stored; plays every frame. No source is
needed.

--json prints an object for each file: file, ok, bytes, chunks, frames, meshes; of one that fails:
error, status.)";

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

void check_frames(const std::string& path, const Clip& clip, ProgressLine& line) {
  for (uint32_t mesh = 0; mesh < clip.meshes().size(); ++mesh) {
    FrameSource frames = play(path, clip, {mesh});
    for (uint32_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.segment_at(mesh, f))
        continue;
      line.show("playing", static_cast<double>(f) / clip.frame_count());
      std::span<const float> positions = frames(f);
      for (size_t i = 0; i < positions.size(); ++i) {
        if (!std::isfinite(positions[i]))
          throw Error(ErrorKind::kCorrupt,
                      fmt::format("{}: frame {}: vertex {} is not finite", path, f, i / 3));
      }
    }
  }
}

void verify(const std::string& path, const CommonOptions& common) {
  ProgressLine line(common.quiet);
  std::string bytes = read_bytes(path);
  size_t chunks = check_chunks(path, bytes);
  Clip clip;
  open_clip(path, bytes, {}, clip, Topologies::kAny);
  if (Failure failure = clip.check_hashes(); !failure.ok())
    fail_clip(path, failure);
  check_frames(path, clip, line);
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
