// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_SDK_CLIP_KEPT_MESHES_H_
#define ANICODEC_SDK_CLIP_KEPT_MESHES_H_

#include "format/memory.h"
#include "format/records.h"
#include "sdk/clip/clip.h"
#include "sdk/clip/mesh_work.h"

namespace anicodec {

/// The decoded mesh chunks of a file, kept for the next opening of the same chunks: of a file more
/// layers of which have arrived, or of a continuation of a live stream. Kept in the memory that was
/// current when the object was made.
class KeptMeshes {
 public:
  KeptMeshes() : KeptMeshes(MemoryScope::current()) {}

  /// Copies the meshes and their poses, if they are kept for these sizes and this order.
  bool take(const Vector<Limits::Mesh>& sizes, OrderMode order, Vector<Mesh>* meshes,
            Vector<MeshPose>* poses) const;

  /// Keeps copies. Throws std::bad_alloc.
  void keep(const Vector<Limits::Mesh>& sizes, OrderMode order, const Vector<Mesh>& meshes,
            const Vector<MeshPose>& poses);

  bool empty() const { return sizes_.empty(); }

  void clear() { *this = KeptMeshes(memory_); }

 private:
  explicit KeptMeshes(Memory* memory) : memory_(memory) {}

  bool has(const Vector<Limits::Mesh>& sizes, OrderMode order) const;

  Memory* memory_;
  Vector<Limits::Mesh> sizes_;
  OrderMode order_ = OrderMode::kFree;
  Vector<Mesh> meshes_;
  Vector<MeshPose> poses_;
};

}  // namespace anicodec

#endif  // ANICODEC_SDK_CLIP_KEPT_MESHES_H_
