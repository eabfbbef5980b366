// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// In builds without Draco.
#include "sdk/mesh/draco_mesh.h"

namespace anicodec {

Status decode_draco_mesh(ByteView, uint32_t, uint32_t, uint32_t, DracoMesh*) {
  return Status::kCoder;
}

}  // namespace anicodec
