// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/clip_input.h"

#include "codec/file/left_out.h"
#include "codec/file/live_stream.h"
#include "format/container.h"
#include "tools/io/base/printable.h"
#include "tools/io/file_formats.h"
#include "tools/io/files/byte_source.h"
#include "tools/io/gltf/moving_glb.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
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
  if (failure.status == Status::kMagic && format_of(path))
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

}  // namespace anicodec::tools
