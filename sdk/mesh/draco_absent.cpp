// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// In builds without Draco.
#include "sdk/mesh/draco_poses.h"

namespace anicodec {

bool has_draco() {
  return false;
}

Status decode_draco_poses(ByteView, const Topology&, uint32_t, uint32_t, Vector<Vector<int32_t>>*) {
  return Status::kFeature;
}

}  // namespace anicodec
