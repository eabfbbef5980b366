// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_OUTPUT_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_OUTPUT_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"
#include "tools/io/alembic/ogawa_output.h"

#include <span>
#include <vector>

namespace anicodec::tools {

/// A mesh of a clip: what it is, when it is there, and how it moves.
struct AlembicTrack {
  MeshSequence mesh;                 ///< but for positions and timing
  std::vector<FrameRun> present_in;  ///< frames of the clip
  FrameSource frames;                ///< asked for frames that show it, in order
  AttributeSource attributes;        ///< in the form of those of the mesh; empty: those of the mesh
};

struct AlembicWriteOptions {
  bool normals = false;    ///< of every corner in every frame
  Progress progress = {};  ///< stage "writing"
};

/// Writes an Alembic archive (Ogawa), one frame in memory at a time: a PolyMesh for each mesh, or
/// for each part of one without a name. Names with slashes are paths, whose upper objects become
/// Xforms; others become an Xform with the mesh below it. Meshes of one name that take turns are
/// one object of changing connectivity, empty where none is there; `visible` tells these frames,
/// too. Faces turn clockwise, as the format asks for; materials are face sets, the first texture
/// coordinates `uv`, further ones, colours and numbers of vertices are in `.arbGeomParams`.
/// Positions are stored as they are; a clip with Z up or a local origin stands below an Xform that turns and moves it.
/// `clip` gives name, number and timing of the frames, axes and origin.
void write_alembic(const AbcSink& sink, const MeshSequence& clip,
                   std::span<const AlembicTrack> tracks, const AlembicWriteOptions& options = {});

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_OUTPUT_H_
