// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_BAKE_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_BAKE_H_

#include "tools/io/alembic/abc_clock.h"
#include "tools/io/alembic/abc_mesh.h"
#include "tools/io/alembic/abc_scene.h"
#include "tools/io/alembic/alembic.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace anicodec::tools {

/// A mesh at a place of the scene.
struct AbcShown {
  uint32_t node = 0;
  AbcMesh* mesh = nullptr;
  /// The topology of the mesh that each frame shows; kAbcNone: it is hidden or empty.
  std::vector<uint32_t> topology;
  std::vector<int8_t> sides;  ///< of each frame: -1 mirrored, 0 flat
  bool mirrored = false;      ///< by its transforms, which turns its faces
  bool is_second = false;     ///< it is mirrored, in frames that another does not show

  /// The first frame that shows it, or that shows one topology.
  uint32_t first_frame() const;
  uint32_t first_frame(uint32_t topology) const;
};

/// Meshes of an archive on one clock, in world space.
class AlembicBake {
 public:
  /// Finds the meshes asked for and their frames. Throws as read_alembic().
  AlembicBake(const ByteSource& source, const AlembicOptions& options);

  const std::vector<AbcShown>& shown() const { return shown_; }

  const AbcArchive& archive() const { return archive_; }

  const std::string& path(const AbcShown& shown) const { return scene_.nodes()[shown.node].path; }

  /// That path, of a second mesh with a word behind it.
  std::string name(const AbcShown& shown) const {
    return path(shown) + (shown.is_second ? " mirrored" : "");
  }

  size_t frame_count() const { return clock_.times.size(); }

  /// Number, rate and times of the frames, axes.
  void set_timing(MeshSequence& out) const;

  /// The transforms of all nodes in a frame.
  std::vector<AbcPlace> places(size_t frame) { return scene_.at(clock_.times[frame]); }

  /// The place of one mesh. Cost: the ancestors of its node.
  AbcPlace place(const AbcShown& shown, size_t frame) {
    return scene_.at(shown.node, clock_.times[frame]);
  }

  /// Faces and all that stands beside the positions of a mesh, in a frame that shows it.
  MeshSequence describe(const AbcShown& shown, size_t frame);

  /// The attributes that move, in a frame.
  std::vector<Attribute> moving_attributes(const AbcShown& shown, size_t frame) const;
  static bool has_moving_attributes(const AbcShown& shown);

  /// The local origin.
  const Eigen::Vector3d& origin() const { return origin_; }

  /// Positions of a mesh in a frame that shows it, vertices x 3.
  void read_positions(const AbcShown& shown, const AbcPlace& place, size_t frame,
                      std::span<float> out) const;

  /// Throws Error(kInput) where so many positions take more memory than is left of what is allowed.
  void check_memory(double vertices, double frames) const;

  /// Takes memory for good. Throws like check_memory().
  void take_memory(double vertices, double frames);

  /// The same for what attributes have got since they took `before` numbers. Gives their numbers now.
  double take_memory(const std::vector<Attribute>& attributes, double before);

 private:
  AbcNote note_once(const AlembicOptions& options);
  void select(const std::string& mesh);
  void watch(bool hidden_too);
  void part_mirrored();
  void note_left_out() const;
  std::optional<Attribute> attribute(const AbcShown& shown, const AbcGeomParam& param,
                                     size_t frame) const;

  std::string name_;
  double memory_left_;
  Eigen::Vector3d origin_;
  AbcNote note_;
  AbcArchive archive_;
  AbcScene scene_;
  std::map<uint32_t, std::unique_ptr<AbcMesh>> meshes_;  ///< by object
  std::vector<AbcShown> shown_;
  AbcClock clock_;
};

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_BAKE_H_
