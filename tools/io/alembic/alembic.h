// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_H_
#define ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_H_

#include "codec/sequence/mesh_sequence.h"
#include "codec/sequence/progress.h"
#include "codec/sequence/scene.h"
#include "tools/io/files/byte_source.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace anicodec::tools {

struct AlembicOptions {
  /// Rate of the frames; default: the times of the samples.
  std::optional<FrameRate> rate = {};
  /// Path of the mesh to take ("/rig/body"), or of an object above several, or the last name of
  /// such a path; empty: all meshes.
  std::string mesh = {};
  /// Taken from the positions before they are rounded to float.
  Point origin = {};
  /// Most bytes that positions may take.
  uint64_t memory_limit = uint64_t{1} << 36;
  /// Stage "reading".
  Progress progress = {};
  /// Told, once each, what of the file is left out.
  std::function<void(const std::string& text)> note = {};
};

/// Reads an Alembic archive (Ogawa): all its meshes, instances included, as one in world space (Y
/// up), a part with its path for each. A frame stands at every time at which something has a
/// sample, and shows the last sample of everything that is not after it; uneven times become the
/// table of times. Faces are counter-clockwise seen from outside, face sets are materials. Texture
/// coordinates, colours and numbers of vertices come along, moving where they do, normals as in the
/// first frame. While a mesh is hidden or empty its vertices are at one point; what no frame shows
/// is left out, unless it is asked for by its path. Frames are read one at a time into the result.
/// Throws Error(kInput) "file: /path/of/object: reason", also where the faces of a mesh change,
/// Error(kUnsupported) for the older kind of file, Error(kUsage) for a mesh that is not there.
MeshSequence read_alembic(const ByteSource& source, const AlembicOptions& options = {});

/// The same with a mesh for each object and each of its connectivities, there in the frames that
/// show it.
Scene read_alembic_meshes(const ByteSource& source, const AlembicOptions& options = {});

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_ALEMBIC_ALEMBIC_H_
