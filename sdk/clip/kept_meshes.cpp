// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/clip/kept_meshes.h"

#include <algorithm>

namespace anicodec {

bool KeptMeshes::has(const Vector<Limits::Mesh>& sizes, OrderMode order) const {
  return !sizes_.empty() && order_ == order &&
         std::equal(sizes.begin(), sizes.end(), sizes_.begin(), sizes_.end());
}

bool KeptMeshes::take(const Vector<Limits::Mesh>& sizes, OrderMode order, Vector<Mesh>* meshes,
                      Vector<MeshPose>* poses) const {
  if (!has(sizes, order))
    return false;
  *meshes = Vector<Mesh>(meshes_);
  *poses = Vector<MeshPose>(poses_);
  return true;
}

void KeptMeshes::keep(const Vector<Limits::Mesh>& sizes, OrderMode order,
                      const Vector<Mesh>& meshes, const Vector<MeshPose>& poses) {
  const MemoryScope scope(memory_);
  if (!has(sizes, order)) {
    clear();
    meshes_ = Vector<Mesh>(meshes);
    order_ = order;
  }
  poses_ = Vector<MeshPose>(poses);
  sizes_ = Vector<Limits::Mesh>(sizes);
}

}  // namespace anicodec
