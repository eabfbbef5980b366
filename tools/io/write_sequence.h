// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_WRITE_SEQUENCE_H_
#define ANICODEC_TOOLS_IO_WRITE_SEQUENCE_H_

#include "codec/sequence/frame_source.h"
#include "codec/sequence/mesh_sequence.h"
#include "tools/io/alembic/alembic_output.h"
#include "tools/io/base/file_format.h"
#include "tools/io/base/write_options.h"

#include <cstdint>
#include <span>
#include <string>

namespace anicodec::tools {

/// Writes a clip, one frame in memory at a time:
///   - clip.pc2, clip.mdd: a vertex cache, with the mesh of frame 0 beside it as clip.obj, which
///   names the cache's content so that another's is told apart,
///   - clip.glb: a mesh with a morph target per frame and its animation, see GlbOutput,
///   - clip.abc: an Alembic archive, see write_alembic(),
///   - frame_%04d.obj, .ply, .off, .stl: a file per frame, its %d or %0Nd counting from
///   first_number.
/// Beside an OBJ whose materials have a look stands a library of them, frame_0000.mtl or clip.mtl.
/// A single frame may have a plain name. PC2 carries no rate; MDD has the time of each frame. STL
/// loses polygons and unused vertices. Counts, polygons and timing come from `clip`, whose
/// positions are not read; frames are asked for once and in order. Folders that are missing are
/// made. All outputs appear together at the end or, on any exception, not at all. Throws
/// Error(kUsage) for a bad name or an existing output, Error(kInternal) when the disk is full.
void write_sequence(const std::string& path, const MeshSequence& clip, const FrameSource& frames,
                    const WriteOptions& options);

/// Whether such an output gets positions with the local origin of the clip; others count from it as the clip does.
bool keeps_origin(const std::string& path, bool ascii);

/// The same for a clip that is in memory.
void write_sequence(const std::string& path, const MeshSequence& clip,
                    const WriteOptions& options = {});

/// Writes several meshes on one clock, which need not be there in all frames, as an Alembic
/// archive. Throws as write_sequence().
void write_tracks(const std::string& path, const MeshSequence& clip,
                  std::span<const AlembicTrack> tracks, const WriteOptions& options);

/// The format of an output by its name. Throws Error(kUsage) where it is unknown or not written.
const FileFormat& output_format(const std::string& path);

/// Throws the Error(kUsage) that write_sequence would throw for a bad name or an existing output,
/// before anything is computed or written.
void check_sequence_output(const std::string& path, uint32_t frame_count,
                           const WriteOptions& options = {});

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_WRITE_SEQUENCE_H_
