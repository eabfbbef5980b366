// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_CODEC_SEQUENCE_SCENE_H_
#define ANICODEC_CODEC_SEQUENCE_SCENE_H_

#include "codec/sequence/mesh_sequence.h"

#include <span>
#include <vector>

namespace anicodec {

/// A mesh of a scene.
struct SceneMesh {
  MeshSequence sequence;             ///< of the frames it is there in alone, without their timing
  std::vector<FrameRun> present_in;  ///< these frames, ascending: sequence.frame_count together
};

/// Several meshes on one clock: objects that stand beside one another, or take turns.
struct Scene {
  MeshSequence clip;  ///< name, number and timing of the frames, axes and units; no mesh
  std::vector<SceneMesh> meshes;
};

/// Gives timing, axes and units of a clip to a mesh that is there in all of it.
void set_timing(const MeshSequence& clip, MeshSequence* mesh);

/// Whether the last frame shows the meshes of the first, at the same positions.
bool is_closed(const Scene& scene);

/// The scene of a mesh that is always there.
Scene scene_of(MeshSequence sequence);

/// The vertices and polygons of a mesh that a part has, each ascending.
struct PartMembers {
  uint32_t part = UINT32_MAX;  ///< label, kNoLabel: of none
  std::vector<uint32_t> vertices, polygons, corners;
};

/// The parts of a mesh in the order of their first vertices. Vertices that several share belong to
/// each; those without polygon, and polygons without corner, stay with the one before. The mesh
/// has labels of parts and a polygon with corners; positions are not read.
std::vector<PartMembers> members_of_parts(const MeshSequence& sequence);

/// Takes a sequence apart into its parts, each a mesh with the part's name, in the order of their
/// first vertices. In frames where all its vertices are at one point, as those of hidden objects
/// are, a part is not there, unless it is so in all. Vertices that several parts share come with
/// each; those without polygon stay with the vertex before. Throws as check(sequence).
Scene split_parts(MeshSequence sequence);

/// The meshes as one, without positions and timing: vertices and polygons one mesh after the other,
/// attributes by kind and name (0 where a mesh has none, 1 for colours). Meshes with a name are its
/// parts.
MeshSequence merge_meshes(std::span<const MeshSequence> meshes);

}  // namespace anicodec

#endif  // ANICODEC_CODEC_SEQUENCE_SCENE_H_
