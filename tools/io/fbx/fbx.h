// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TOOLS_IO_FBX_FBX_H_
#define ANICODEC_TOOLS_IO_FBX_FBX_H_

#include "codec/sequence/mesh_sequence.h"
#include "tools/io/gltf/gltf.h"

#include <string>
#include <vector>

namespace anicodec::tools {

struct FileFormat;

/// Whether this build has ufbx, which reads FBX.
bool reads_fbx();

/// Reads an FBX by ufbx, in a process with limits: all its meshes as one in world space, polygons as they are, in
/// axes and units of the file (axes other than Y or Z up become Y up). Frames stand at the rate of the file, or on the
/// finer grid of its keys, from begin to end of the take; each is evaluated as the file says: curves, pivots, blend
/// shapes with in-betweens, skins, caches of geometry in the file's folder. Texture coordinates, colours, materials
/// and names come along, normals as in the first frame. A mesh that mirrors at some times only is there twice, as
/// NAME and "NAME mirrored". Takes are as in parse_gltf(). Throws Error(kInput), Error(kUsage) for a mesh or take that
/// is not there, Error(kUnsupported) in a build without ufbx.
MeshSequence load_fbx(const std::string& path, const GltfOptions& options);

/// Takes as clips, see parse_gltf_clips().
std::vector<MeshSequence> load_fbx_clips(const std::string& path, const GltfOptions& options,
                                         const std::vector<std::string>& names);

extern const FileFormat kFbx;

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_IO_FBX_FBX_H_
