// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_MESH_DRACO_MESH_H_
#define ANICODEC_SDK_MESH_DRACO_MESH_H_

#include "format/bytes.h"
#include "format/memory.h"
#include "format/status.h"

#include <cstdint>

namespace anicodec {

/// A triangle mesh whose points carry integers: what a Draco bitstream of ours holds.
struct DracoMesh {
  uint32_t points = 0;
  Vector<uint32_t> triangles;  ///< three points each
  uint32_t components = 0;
  Vector<int32_t> values;  ///< points x components
};

/// Decodes a Draco mesh bitstream (version 2.2) of int32 attributes: first POSITION with three
/// components, then GENERIC ones (a lone pose is followed by one stand-in component); their
/// components are concatenated. The counts must be the ones
/// the caller knows from the limits, else kDraco; kCoder in a build without Draco. Never throws:
/// Draco's exceptions are caught here. Only this file of the decoder calls Draco.
Status decode_draco_mesh(ByteView bytes, uint32_t points, uint32_t triangles, uint32_t components,
                         DracoMesh* out);

}  // namespace anicodec

#endif  // ANICODEC_SDK_MESH_DRACO_MESH_H_
