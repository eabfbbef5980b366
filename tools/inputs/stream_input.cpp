// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/stream_input.h"

#include "codec/file/live_stream.h"
#include "codec/sequence/error.h"
#include "format/container.h"
#include "format/records.h"
#include "sdk/clip/kept_learning.h"
#include "tools/inputs/clip_input.h"
#include "tools/words/quantity.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace anicodec::tools {
namespace {

/// The time of a file, and whether it begins anew.
void read_facts(const Bytes& whole, StreamedFile* file) {
  ContainerReader reader;
  Limits limits;
  ClipsRecord clips;
  const auto chunk = [&](const char(&type)[5]) {
    const Chunk* found = reader.find(type);
    return found ? reader.unchecked(*found) : ByteView();
  };
  if (const Failure failure = reader.open(whole); !failure.ok())
    fail_clip(file->name, failure);
  Status status = Limits::read(chunk("LIMI"), &limits);
  if (status == Status::kOk)
    status = ClipsRecord::read(chunk("CLIP"), limits, &clips);
  if (status != Status::kOk)
    fail_clip(file->name, {status, chunk_type("LIMI"), 0, ""});
  const ClipRecord& clip = clips.clips[0];
  file->frames = limits.frames;
  file->start = clip.start_time;
  file->end =
      clip.start_time + double{1} * limits.frames * clip.rate_denominator / clip.rate_numerator;
  file->is_key = true;
  for (uint32_t s = 0; s < limits.segments.size(); ++s) {
    SegmentRecord record;
    const Chunk* found = reader.find("SEGM", limits.segments[s].mesh, s);
    if (limits.segments[s].learns && found &&
        SegmentRecord::read(reader.unchecked(*found), &record) == Status::kOk) {
      file->is_key = record.continued == 0;
      break;
    }
  }
}

/// Collects the times that no file plays.
class Losses {
 public:
  void refuse(const StreamedFile& file) {
    ++refused_;
    last_ = file.end;
  }

  void play(const StreamedFile& file) {
    constexpr double kHalf = 0.5;
    const double frame = (file.end - file.start) / std::max(file.frames, 1U);
    if (end_ && (refused_ > 0 || file.start > *end_ + kHalf * frame))
      add(*end_, file.start);
    refused_ = 0;
    end_ = file.end;
  }

  std::vector<std::string> finish() && {
    if (refused_ > 0)
      add(end_.value_or(0), last_);
    return std::move(lines_);
  }

 private:
  void add(double from, double to) {
    lines_.push_back(fmt::format(
        "{:.2f} s to {:.2f} s: {}", from, to,
        refused_ > 0 ? fmt::format("{} one that was lost",
                                   refused_ == 1 ? "a file continues"
                                                 : fmt::format("{} files continue", refused_))
                     : "a file was lost"));
  }

  std::vector<std::string> lines_;
  std::optional<double> end_;  // of the last file that plays
  double last_ = 0;
  uint32_t refused_ = 0;  // files since
};

}  // namespace

StreamContents read_stream(
    const std::string& path, ByteView bytes,
    const std::function<void(const StreamedFile&, const std::string&, Clip&)>& show) {
  LiveStream stream = read_live_stream({path, bytes});
  StreamContents contents;
  contents.incomplete = stream.incomplete;
  Losses losses;
  KeptLearning learning;
  for (size_t i = 0; i < stream.files.size(); ++i) {
    StreamedFile file;
    file.offset = stream.places[i].offset;
    file.size = stream.places[i].size;
    file.has_mesh = !stream.places[i].is_continuation;
    file.name = fmt::format("{}, file {} (at byte {})", path, i + 1, file.offset);
    const std::string whole(stream.files[i].begin(), stream.files[i].end());
    read_facts(stream.files[i], &file);
    Clip clip;
    OpenOptions options;
    options.learning = &learning;
    const Failure failure = clip.open(view_of(whole), options);
    file.plays = failure.status != Status::kSegmentMissing;
    if (file.plays && !failure.ok())
      fail_clip(file.name, failure);
    if (file.plays) {
      losses.play(file);
      show(file, whole, clip);
    } else {
      losses.refuse(file);
    }
    contents.files.push_back(std::move(file));
  }
  contents.losses = std::move(losses).finish();
  return contents;
}

void check_losses(const std::string& path, const StreamContents& stream) {
  if (!stream.losses.empty())
    throw Error(ErrorKind::kCorrupt, fmt::format("{}: {}", path, fmt::join(stream.losses, "; ")));
}

}  // namespace anicodec::tools
