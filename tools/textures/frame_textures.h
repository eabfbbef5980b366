// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// A texel for each vertex and frame, in the layouts of two tools whose shaders exist for several engines.
#ifndef ANICODEC_TOOLS_TEXTURES_FRAME_TEXTURES_H_
#define ANICODEC_TOOLS_TEXTURES_FRAME_TEXTURES_H_

#include "tools/textures/vat.h"

namespace anicodec::tools {

/// OpenVAT 1.1, packed normals: NAME_vat holds offsets from the first frame, in Blender's axes (x, -z, y), from 0 to 1
/// between the Min and Max of NAME-remap_info.json; a row for each frame, and as many below for the normals, from 0 to 1.
/// If a row is too short for the vertices, the rows of all frames follow for the next ones.
/// NAME.glb is the first frame. Throws Error(kInput) for textures that pass the limit. Cost: three
/// passes over the frames.
VatResult make_openvat(const VatSource& source, const VatOptions& options);

/// SideFX Labs Vertex Animation Textures 3, soft bodies, as its shader graphs for Unity read them: offsets from
/// NAME_mesh.glb, x mirrored; NAME_rot holds the rotation that turns y to the normal, as a quaternion. Frames follow one
/// another, each of as many rows as the vertices take. PNG: from 0 to 1 between the bounds of NAME_data.json, whose
/// digits tell the shaders that, and that nothing is padded. Throws and costs as make_openvat().
VatResult make_houdini(const VatSource& source, const VatOptions& options);

}  // namespace anicodec::tools

#endif  // ANICODEC_TOOLS_TEXTURES_FRAME_TEXTURES_H_
