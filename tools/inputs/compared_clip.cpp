// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tools/inputs/compared_clip.h"

#include "tools/inputs/clip_input.h"
#include "tools/io/base/frame_attributes.h"
#include "tools/io/file_formats.h"
#include "tools/io/load_sequence.h"

#include <algorithm>
#include <vector>

namespace anicodec::tools {
namespace {

/// The polygons as sorted lists of corners, each turned so that the least list stands first.
std::vector<std::vector<uint32_t>> canonical(const Polygons& polygons) {
  std::vector<std::vector<uint32_t>> list;
  list.reserve(polygons.size());
  for (size_t p = 0; p < polygons.size(); ++p) {
    std::vector<uint32_t> corners(polygons[p].begin(), polygons[p].end());
    std::vector<uint32_t> least = corners;
    for (size_t turn = 1; turn < corners.size(); ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      least = std::min(least, corners);
    }
    list.push_back(std::move(least));
  }
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace

ComparedClip::ComparedClip(const std::string& path, const std::string& mesh,
                           const Progress& progress, const ComparedPart& part)
    : path_(path) {
  if (is_anic(path)) {
    std::string bytes = read_bytes(path);
    bytes_ = bytes.size();
    clip_ = std::make_unique<PlayedClip>(path, view_of(bytes));
    clip_->choose(part.clip);
    sequence_ = clip_->describe(clip_->meshes());
  } else {
    LoadOptions options;
    options.progress = progress;
    options.origin.reset();
    options.rate = part.rate;
    if (is_cache(path))
      options.mesh = mesh;
    if (is_scene(path))
      options.clip = part.clip;
    sequence_ = load_sequence(std::vector<std::string>{path}, options);
  }
  range_ = {0, sequence_.frame_count, 1};
  if (!part.frames.empty())
    range_ = parse_frames(part.frames, path, sequence_.frame_count);
  sequence_.frame_count = range_.size();
}

void ComparedClip::check_empty_frames() const {
  if (clip_)
    clip_->check_empty_frames(range_);
}

bool ComparedClip::has_free_order() const {
  return clip_ && clip_->order() == ANIC_ORDER_FREE;
}

FrameSource ComparedClip::frames() const {
  FrameSource all = clip_ ? clip_->play(clip_->meshes()) : frames_of(sequence_);
  return [all = std::move(all), range = range_](uint32_t f) {
    return all(range.first + f * range.step);
  };
}

AttributeSource ComparedClip::attributes() const {
  AttributeSource all;
  if (clip_)
    all = clip_->play_attributes(clip_->meshes());
  if (!all)
    all = [this](uint32_t f) { return attributes_of_frame(sequence_.attributes, f); };
  return [all = std::move(all), range = range_](uint32_t f) {
    return all(range.first + f * range.step);
  };
}

bool same_faces(const Polygons& a, const Polygons& b) {
  return a == b || (a.size() == b.size() && canonical(a) == canonical(b));
}

}  // namespace anicodec::tools
