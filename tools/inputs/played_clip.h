// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_INPUTS_PLAYED_CLIP_H_
#define ANICODEC_TOOLS_INPUTS_PLAYED_CLIP_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "format/bytes.h"
#include "tools/words/quantity.h"

#include <anicodec/anicodec.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// The part of ascending runs that a range takes, counted in the range. O(runs).
std::vector<FrameRun> runs_in(const std::vector<FrameRun>& runs, const FrameRange& range);

/// Clips that a command can work on: kOne, only clips of one connectivity.
enum class Topologies { kOne, kAny };

/// An .anic file that a command plays, through the interface that other programs use. For one thread.
class PlayedClip {
 public:
  /// Opens a file whose bytes are not needed afterwards, with a share of its components. Throws as
  /// fail_clip(); std::bad_alloc; Error(kUnsupported) for meshes that take turns where that is not allowed.
  PlayedClip(const std::string& path, ByteView bytes, Topologies allowed = Topologies::kOne,
             double quality = 1);
  PlayedClip(const PlayedClip&) = delete;
  PlayedClip& operator=(const PlayedClip&) = delete;

  /// Throws Error(kCorrupt) if the decoded integers are not those that the encoder saw. For full quality.
  void verify() const;

  /// Makes one clip of a file the only one, by its name: frames are counted from its first one on. Without a name
  /// there must be no other, "all" takes all. Throws Error(kUsage) that lists the clips.
  void choose(const std::string& name);

  /// The clips at hand: those of the file, or the chosen one.
  std::span<const anic_clip> clips() const { return clips_; }

  /// The clips at hand as those of a sequence, with their events.
  std::vector<ClipTiming> timings() const;

  uint32_t frame_count() const { return frame_count_; }

  uint32_t vertex_count(uint32_t mesh) const { return asset_.mesh(mesh).vertex_count; }

  anic_order order() const { return info_.order; }

  UpAxis up() const { return static_cast<UpAxis>(info_.up); }

  /// Numbers of all meshes.
  std::vector<uint32_t> meshes() const;

  /// The runs of frames that show a mesh, ascending.
  const std::vector<FrameRun>& present_in(uint32_t mesh) const { return present_in_[mesh]; }

  /// True for several meshes that no frame shows together: a clip whose connectivity changes.
  bool takes_turns() const;

  /// Throws Error(kInput) where a range takes more than a million frames that show nothing: a file of a few bytes may
  /// announce 16 million.
  void check_empty_frames(const FrameRange& range) const;

  /// Some meshes as one, see merge_meshes(): counts, polygons, metadata, and the timing of all
  /// frames: of several clips, at the rate of the first.
  MeshSequence describe(const std::vector<uint32_t>& meshes) const;

  /// Plays some meshes as one. The clip must outlive the source. Frames are given in any order. In
  /// those that do not show a mesh, all its vertices are where its first one was last, or will be
  /// first. Throws Error(kCorrupt) naming the path.
  FrameSource play(const std::vector<uint32_t>& meshes) const;

  /// The same of their attributes, moving or not, in the form of those of describe(); empty when
  /// none moves. A mesh that a frame does not show has those it had last, or will have first.
  AttributeSource play_attributes(const std::vector<uint32_t>& meshes) const;

 private:
  /// The frame shown now; sources share it.
  struct Player {
    anic::Context context;
    uint32_t frame = UINT32_MAX;
  };

  std::vector<MeshSequence> describe_meshes(const std::vector<uint32_t>& meshes) const;
  void list_frames();
  std::vector<FrameRun> runs_of_all() const;
  anic::Status show(uint32_t frame) const;
  void check_played(anic::Status status, uint32_t frame) const;

  std::string path_;
  anic::Asset asset_;
  anic_asset_info info_ = ANIC_INIT(anic_asset_info);
  std::vector<anic_clip> clips_;
  uint32_t first_clip_ = 0;                        ///< of the file
  uint32_t frame_count_ = 0;                       ///< of the clips at hand
  std::vector<std::vector<FrameRun>> present_in_;  ///< by mesh
  std::unique_ptr<Player> player_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_INPUTS_PLAYED_CLIP_H_
