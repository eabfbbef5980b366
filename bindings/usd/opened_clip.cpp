// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "bindings/usd/opened_clip.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace anicodec::usd {

namespace {

std::string told(const anic_failure& failure) {
  std::string text = anic_get_status_text(failure.status);
  if (failure.chunk[0] != 0)
    text = "chunk " + std::string(failure.chunk) + ", byte " + std::to_string(failure.offset) +
           ": " + text;
  if (failure.detail != nullptr && failure.detail[0] != 0)
    text += std::string(" (") + failure.detail + ")";
  return text;
}

/// The smallest box around a box that a map turns back.
anic_box turned_back(const anic_box& box, const float* m) {
  anic_box out;
  for (int c = 0; c < 3; ++c) {
    out.min[c] = std::numeric_limits<float>::max();
    out.max[c] = std::numeric_limits<float>::lowest();
  }
  for (int corner = 0; corner < 8; ++corner) {
    double from_move[3];
    for (int r = 0; r < 3; ++r)
      from_move[r] =
          static_cast<double>(((corner >> r) & 1) != 0 ? box.max[r] : box.min[r]) - m[4 * r + 3];
    for (int c = 0; c < 3; ++c) {  // the inverse of a turn is its transpose
      const double x = m[c] * from_move[0] + m[4 + c] * from_move[1] + m[8 + c] * from_move[2];
      out.min[c] = std::min(out.min[c], static_cast<float>(x));
      out.max[c] = std::max(out.max[c], static_cast<float>(x));
    }
  }
  return out;
}

}  // namespace

bool OpenedClip::open_asset(const char* bytes, size_t size, std::string* error) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = in_place_ ? ANIC_OPEN_IN_PLACE : 0;
  anic_failure failure = ANIC_INIT(anic_failure);
  const auto* begin = reinterpret_cast<const uint8_t*>(bytes);
  anic::Status status = asset_.open({begin, size}, &options, &failure);
  if (!status) {
    failure.status = status.code();
    *error = told(failure);
    return false;
  }
  status = context_.create(asset_);
  if (!status) {
    *error = status.text();
    return false;
  }
  info_ = asset_.info();
  clips_.assign(anic_get_clip_count(asset_.get()), ANIC_INIT(anic_clip));
  for (uint32_t clip = 0; clip < clips_.size(); ++clip)
    anic_get_clip(asset_.get(), clip, &clips_[clip]);
  return true;
}

std::unique_ptr<OpenedClip> OpenedClip::open(const char* bytes, size_t size, std::string* error) {
  std::unique_ptr<OpenedClip> file(new OpenedClip);
  if (!file->open_asset(bytes, size, error))
    return nullptr;
  // Positions that come back bit for bit have the motion of the whole in them.
  for (uint32_t clip = 0; file->in_place_ && clip < file->clips_.size(); ++clip) {
    if (file->clips_[clip].max_error == 0 && file->has_root_motion(clip)) {
      file->in_place_ = false;
      file->context_ = {};
      if (!file->open_asset(bytes, size, error))
        return nullptr;
    }
  }
  const char* text = nullptr;
  size_t length = 0;
  anic::Status status = anic_read_metadata(bytes, size, &text, &length);
  if (status)
    file->metadata_.assign(text, length);
  else if (!(status == ANIC_E_ABSENT)) {
    *error = std::string("chunk META: ") + status.text();
    return nullptr;
  }
  file->find_frames();
  status = file->read_boxes(bytes, size);
  if (!status) {
    *error = std::string("chunk BNDS: ") + status.text();
    return nullptr;
  }
  return file;
}

void OpenedClip::find_frames() {
  ranges_.resize(info_.mesh_count);
  for (uint32_t segment = 0; segment < info_.segment_count; ++segment) {
    anic_basis basis = ANIC_INIT(anic_basis);
    if (!asset_.basis(segment, &basis) || basis.target != ANIC_TARGET_POSITIONS)
      continue;
    ranges_[basis.mesh].emplace_back(basis.first_frame, basis.first_frame + basis.frame_count);
  }
  for (std::vector<FrameRange>& ranges : ranges_) {
    std::sort(ranges.begin(), ranges.end());
    std::vector<FrameRange> joined;
    for (const FrameRange& range : ranges) {
      if (!joined.empty() && joined.back().second >= range.first)
        joined.back().second = std::max(joined.back().second, range.second);
      else
        joined.push_back(range);
    }
    ranges = std::move(joined);
  }
}

anic_status OpenedClip::read_boxes(const char* bytes, size_t size) {
  // A thousand boxes of a mesh at most, as each is looked for in the file.
  while (info_.frame_count / frames_of_box_ >= 1024)
    frames_of_box_ *= 2;
  boxes_.resize(info_.mesh_count);
  for (uint32_t mesh = 0; mesh < info_.mesh_count; ++mesh) {
    for (uint32_t first = 0; first < info_.frame_count; first += frames_of_box_) {
      anic_box box = {};
      const uint32_t count = std::min(frames_of_box_, info_.frame_count - first);
      const anic_status status = anic_read_bounds(bytes, size, mesh, first, count, &box);
      const std::vector<FrameRange>& ranges = ranges_[mesh];
      const bool shown = std::any_of(ranges.begin(), ranges.end(), [&](const FrameRange& range) {
        return range.first < first + count && first < range.second;
      });
      if (status != ANIC_OK && status != ANIC_E_ABSENT)
        return status;
      if (status == ANIC_E_ABSENT && shown) {
        boxes_[mesh].clear();  // the file has none
        break;
      }
      boxes_[mesh].push_back(box);
    }
  }
  return ANIC_OK;
}

bool OpenedClip::rests(uint32_t mesh) const {
  for (uint32_t segment = 0; segment < info_.segment_count; ++segment) {
    anic_basis basis = ANIC_INIT(anic_basis);
    if (asset_.basis(segment, &basis) && basis.target == ANIC_TARGET_POSITIONS &&
        basis.mesh == mesh &&
        (basis.components != 0 || basis.reconstruction != ANIC_RECONSTRUCTION_LINEAR))
      return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  anic_parts first = ANIC_INIT(anic_parts);
  bool any = false;
  for (const FrameRange& range : ranges_[mesh]) {
    for (uint32_t frame = range.first; frame < range.second; ++frame) {
      anic_parts parts = ANIC_INIT(anic_parts);
      if (!context_.seek_frame(frame) || !context_.parts(&parts, ANIC_WHEN_CURRENT, mesh) ||
          parts.count != 1 || parts.parts[0].correction_count != 0)
        return false;
      if (!any)
        first = parts;
      any = true;
      if (first.parts[0].segment != parts.parts[0].segment ||
          std::memcmp(first.parts[0].pose_map, parts.parts[0].pose_map,
                      sizeof parts.parts[0].pose_map) != 0 ||
          std::memcmp(first.parts[0].motion, parts.parts[0].motion, sizeof parts.parts[0].motion) !=
              0)
        return false;
    }
  }
  return any;
}

bool OpenedClip::has_root_motion(uint32_t clip) const {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  return in_place_ &&
         anic_get_root_motion(asset_.get(), clip, 0, ANIC_SAMPLE_STEP, ANIC_WRAP_CLAMP, &motion) ==
             ANIC_OK &&
         (motion.moves != 0 || motion.turns != 0);
}

anic_root_motion OpenedClip::root_motion(uint32_t clip, uint32_t frame) const {
  anic_root_motion motion = ANIC_INIT(anic_root_motion);
  (void)anic_get_root_motion(asset_.get(), clip, asset_.frame_time(frame), ANIC_SAMPLE_LINEAR,
                             ANIC_WRAP_CLAMP, &motion);
  return motion;
}

anic_box OpenedClip::box(uint32_t mesh, uint32_t clip, uint32_t frame) const {
  const anic_box& box = boxes_[mesh][frame / frames_of_box_];
  return has_root_motion(clip) ? turned_back(box, root_motion(clip, frame).matrix) : box;
}

anic_status OpenedClip::write_positions(uint32_t mesh, uint32_t frame, float* out) const {
  const uint32_t count = asset_.mesh(mesh).vertex_count;
  const anic_output output = anic::output({out, size_t{3} * count});
  const anic::Status status = asset_.write_frames({&frame, 1}, {&output, 1}, 0, count, mesh);
  if (!(status == ANIC_E_STATE))
    return status.code();
  const std::lock_guard<std::mutex> lock(mutex_);
  const anic::Status sought = context_.seek_frame(frame);
  return sought ? context_.write_positions(output, 0, count, ANIC_WHEN_CURRENT, mesh).code()
                : sought.code();
}

anic_status OpenedClip::write_attribute(uint32_t mesh, uint32_t attribute, uint32_t frame,
                                        float* out) const {
  const anic_attribute what = asset_.attribute(attribute, mesh);
  const anic_value_output output = anic::value_output({out, size_t{what.count} * what.components});
  const std::lock_guard<std::mutex> lock(mutex_);
  const anic::Status sought = context_.seek_frame(frame);
  return sought
             ? context_.write_attribute(attribute, output, 0, what.count, ANIC_WHEN_CURRENT, mesh)
                   .code()
             : sought.code();
}

double shortest(float value) {
  char text[32];
  for (int digits = 1; digits <= 9; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
    if (std::strtof(text, nullptr) == value)
      break;
  }
  return std::strtod(text, nullptr);
}

}  // namespace anicodec::usd
