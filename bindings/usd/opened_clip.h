// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_BINDINGS_USD_OPENED_CLIP_H_
#define ANICODEC_BINDINGS_USD_OPENED_CLIP_H_

#include <anicodec/anicodec.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace anicodec::usd {

/// Frames in which a mesh is there: first, and one behind the last.
using FrameRange = std::pair<uint32_t, uint32_t>;

/// An opened .anic file, asked for frames. Threads may share it. Holds the resident memory of the asset, 24 bytes for each mesh and
/// each group of frames that has a box, and no frame. The motion of the whole is left out of positions, but of lossless ones.
class OpenedClip {
 public:
  /// Null with one line in `error` for what is no clip. The bytes are not needed afterwards.
  static std::unique_ptr<OpenedClip> open(const char* bytes, size_t size, std::string* error);

  const anic::Asset& asset() const { return asset_; }

  const anic_asset_info& info() const { return info_; }

  const std::vector<anic_clip>& clips() const { return clips_; }

  /// A JSON object, or nothing.
  const std::string& metadata() const { return metadata_; }

  /// Ascending, not touching one another.
  const std::vector<FrameRange>& frames_of(uint32_t mesh) const { return ranges_[mesh]; }

  /// Whether the positions of a mesh are the same bits in all frames of it, known without decoding.
  bool rests(uint32_t mesh) const;

  /// Whether positions of the clip go without the motion of the whole.
  bool has_root_motion(uint32_t clip) const;

  anic_root_motion root_motion(uint32_t clip, uint32_t frame) const;

  bool has_boxes(uint32_t mesh) const { return !boxes_[mesh].empty(); }

  /// A box around the positions of a frame, as they are without the motion of the whole. O(1).
  anic_box box(uint32_t mesh, uint32_t clip, uint32_t frame) const;

  /// Vertices x 3. Cost: that of a frame.
  anic_status write_positions(uint32_t mesh, uint32_t frame, float* out) const;

  /// Elements x components. Cost: that of a frame.
  anic_status write_attribute(uint32_t mesh, uint32_t attribute, uint32_t frame, float* out) const;

 private:
  OpenedClip() = default;
  bool open_asset(const char* bytes, size_t size, std::string* error);
  void find_frames();
  anic_status read_boxes(const char* bytes, size_t size);

  bool in_place_ = true;
  anic::Asset asset_;
  anic_asset_info info_;
  std::vector<anic_clip> clips_;
  std::string metadata_;
  std::vector<std::vector<FrameRange>> ranges_;
  std::vector<std::vector<anic_box>> boxes_;  ///< of each mesh: one for each group of frames
  uint32_t frames_of_box_ = 64;
  mutable std::mutex mutex_;
  mutable anic::Context context_;  ///< for what anic_write_frames() does not do; guarded by mutex_
};

/// The nearest number of few digits that a float32 stands for: 0.01 of 0.0099999998.
double shortest(float value);

}  // namespace anicodec::usd

#endif  // ANICODEC_BINDINGS_USD_OPENED_CLIP_H_
