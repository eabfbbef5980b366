// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_CLIP_H_
#define ANICODEC_SDK_CLIP_CLIP_H_

#include "format/container.h"
#include "format/memory.h"
#include "format/records.h"
#include "format/status.h"
#include "sdk/base/host_progress.h"
#include "sdk/base/parallel_for.h"
#include "sdk/clip/attributes.h"
#include "sdk/clip/mesh_work.h"
#include "sdk/clip/root_motion.h"
#include "sdk/mesh/topology.h"
#include "sdk/play/play.h"
#include "sdk/segment/segment.h"

#include <cstdint>
#include <utility>

namespace anicodec {

/// Clips by their names. The strings must outlive it.
struct ClipNames {
  const char* const* names = nullptr;
  uint32_t count = 0;
};

/// The most that a host allows a file to ask for. Checked before anything is allocated.
struct HostLimits {
  uint64_t vertices = uint64_t{1} << 31;
  uint64_t frames = uint64_t{1} << 24;
  uint64_t components = uint64_t{1} << 20;
  uint64_t resident_bytes = uint64_t{16} << 30;  ///< while opening, see estimate_memory()
};

class KeptLearning;
class KeptMeshes;
struct LearntSegment;

/// Whether each clip of a file is among those named; all are where none is. Errors: kAbsent.
Failure wanted_clips(const ClipsRecord& record, const ClipNames& names, Vector<uint8_t>* out);

struct OpenOptions {
  HostLimits limits;
  /// Share of the components to open, by number, in (0, 1]: fewer give a coarser clip.
  double quality = 1;
  /// Whether the bytes may be the first ones of a file: what has arrived is opened, with as many
  /// components as are there (spec/05-file-layout.md, section 7).
  bool prefix = false;
  /// The clips to open, at least one of them in the file; none named: all. Segments that hold none
  /// of their frames are not opened, of the others what they need stays resident.
  ClipNames clips;
  /// Leaves the source's order of vertices and polygons alone, whatever the file keeps of it.
  bool any_order = false;
  /// Leaves the motion of the whole out of the positions.
  bool in_place = false;
  /// Leaves exact positions closed: plays what the basis makes of all frames.
  bool inexact = false;

  /// Whether exact positions are opened, of segments that have them.
  bool opens_exact() const { return !inexact && quality >= 1; }

  /// Share the work that can be shared; nothing depends on them.
  HostThreads threads;
  /// Told after every mesh, level of the vertices and component; may end the opening with
  /// kCancelled. Null: nobody.
  HostProgress* progress = nullptr;
  /// Sees the integers of every step of decoding, for tests. Null: nobody.
  DecodingTrace* trace = nullptr;
  /// Meshes and poses from an earlier opening, and for the next one as far as memory allows. Null: none.
  KeptMeshes* kept = nullptr;
  /// Receives what segments learn, and has that of earlier files of a stream. Null: segments continue those of
  /// the same file alone.
  KeptLearning* learning = nullptr;
  double progress_end = 1;  ///< share of the host's call that is done once the clip is open
};

/// Moves what a state shows, its corrections excepted, which follow.
void move_whole(const Affine& root, FrameState* state);

/// One mesh of a clip. Its topology keeps what a player needs: polygons, and the coded vertex of
/// each vertex.
struct Mesh {
  String name;
  Topology topology;
  Vector<MeshAttribute> attributes;
};

/// A quantity with segments of its own: the positions of a mesh, or three components of an attribute.
struct Track {
  uint32_t mesh = 0;
  uint32_t attribute = kPositions;
  uint32_t first_component = 0;
  uint32_t begin = 0, end = 0;  ///< its segments in Clip::by_frame()

  bool is_attribute() const { return attribute != kPositions; }
};

/// An opened file of one clip or more: immutable, so any number of threads may play it. Owns all it needs; the file's
/// bytes may go after open(). Make and open it in the same MemoryScope.
class Clip {
 public:
  /// Opens a file in memory. On failure the clip is empty and the failure says where; kTruncated
  /// for a prefix of which too little is there. Throws std::bad_alloc. Cost: entropy decoding of
  /// all coefficients once; afterwards every frame costs the same.
  Failure open(ByteView file, const OpenOptions& options = {});

  /// The same for a file whose header and table have been read.
  Failure open(const ContainerReader& file, const OpenOptions& options);

  const Limits& limits() const { return limits_; }

  /// The file's record of itself and of its clips, opened or not.
  const ClipsRecord& record() const { return record_; }

  const Vector<ClipRecord>& clips() const { return record_.clips; }

  /// The clip that holds a frame of the file. O(log clips).
  uint32_t clip_at(uint32_t frame) const;

  /// Whether the host wants each clip (OpenOptions::clips).
  const Vector<uint8_t>& wanted() const { return wanted_; }

  const Vector<Mesh>& meshes() const { return meshes_; }

  const Vector<Segment>& segments() const { return segments_; }

  /// The frames of all clips; they are numbered through the file.
  uint32_t frame_count() const { return limits_.frames; }

  uint32_t vertex_count(uint32_t mesh = 0) const { return limits_.meshes[mesh].source_vertices; }

  /// Track m is that of the positions of mesh m; then follow those of attributes, ascending by
  /// mesh, attribute and component.
  const Vector<Track>& tracks() const { return tracks_; }

  /// Numbers of the segments: those of a track one after the other, ascending by first frame.
  const Vector<uint32_t>& by_frame() const { return by_frame_; }

  /// The tracks first .. second - 1 move an attribute; none when it does not move. O(log tracks).
  std::pair<uint32_t, uint32_t> attribute_tracks(uint32_t mesh, uint32_t attribute) const;

  /// The segment of a track (or of a mesh's positions) that holds a frame; null when the mesh is
  /// not there, or the attribute is as in frame 0. O(log segments).
  const Segment* segment_at(uint32_t track, uint32_t frame) const;

  /// The motion of the whole, part of the positions or not.
  const RootMotion& root() const { return root_; }

  /// Whether exact positions of a frame may be shown: those of a clip that is opened without its
  /// motion of the whole are not. O(log clips).
  bool shows_exact(uint32_t frame) const {
    return !in_place_ || root_.empty() || root_.holds(clip_at(frame)) == 0;
  }

  /// Whether the positions have the motion of the whole, and there is one.
  bool has_root() const { return !root_.empty() && !in_place_; }

  /// The motion of the whole in a frame of the file. O(log clips).
  RootState root_at(uint32_t frame) const;

  /// The input of play() for a frame, counted in a segment of positions, with the motion of the
  /// whole if the positions include it.
  FrameState state_of(const Segment& segment, uint32_t frame) const;

  /// Whether something had not arrived: segments have no frames, fewer components than options
  /// asked for, or no corrections.
  bool is_partial() const { return partial_; }

  /// Bytes that stay allocated while the clip is open.
  size_t resident_bytes() const;

  /// kHash when the decoded integers of a segment are not those that the encoder saw. Meaningful
  /// for clips opened at full quality.
  Failure check_hashes() const;

 private:
  Failure open_mesh(const ContainerReader& file, uint16_t mesh, const OpenOptions& options);
  Failure open_meshes(const ContainerReader& file, const OpenOptions& options);
  Failure open_root(const ContainerReader& file);
  void turn_corrections();
  bool has_attributes() const;
  bool has_surfaces() const;
  Status attribute_work(const Limits::Segment& sizes, AttributeWork** out);
  void list_tracks();
  Failure open_attributes(const ContainerReader& file, uint16_t mesh, const OpenOptions& options);
  Failure open_segments(const ContainerReader& file, const OpenOptions& options);
  Failure open_exact(const ContainerReader& file, uint32_t number, const SegmentContext& context,
                     const OpenOptions& options);
  Vector<uint8_t> needed_segments(const ContainerReader& file) const;
  Failure open_segment(const ContainerReader& file, uint32_t number,
                       const Vector<const Chunk*>& layers, const OpenOptions& options,
                       Vector<LearntSegment>* learnt);

  Limits limits_;
  ClipsRecord record_;
  Vector<uint8_t> wanted_;  ///< by clip
  RootMotion root_;
  bool in_place_ = false;
  Vector<Mesh> meshes_;
  Vector<MeshWork> work_;   ///< while opening
  Vector<MeshPose> poses_;  ///< while opening, by mesh
  Vector<Segment> segments_;
  bool partial_ = false;
  Vector<Track> tracks_;
  Vector<uint32_t> by_frame_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_CLIP_H_
