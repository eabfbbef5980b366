// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: morphing meshes of the host.
#include "sdk/api/objects.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>

struct anic_morpher {
  anicodec::Msgi msgi;
  size_t resident_bytes = 0;
};

using namespace anicodec;

anic_status anic_create_morpher(const uint32_t* triangles, uint32_t triangle_count,
                                uint32_t vertex_count, const float* const* meshes,
                                uint32_t mesh_count, const anic_morpher_options* options,
                                const anic_allocator* allocator, anic_morpher** out) {
  if (out)
    *out = nullptr;
  anic_morpher_options wanted;
  if (!take(options, &wanted) || !out || !meshes || mesh_count < 2 ||
      (!triangles && triangle_count > 0) || (!wanted.pins && wanted.pin_count > 0) ||
      (allocator && !allocator->allocate != !allocator->release))
    return ANIC_E_ARGUMENT;
  for (uint32_t i = 0; i < mesh_count; ++i) {
    if (!meshes[i])
      return ANIC_E_ARGUMENT;
  }
  auto make = [&]() -> Failure {
    auto* morpher = create<anic_morpher>(memory_of(allocator), 0);
    Status status = Status::kOk;
    try {
      const MemoryScope scope(&memory_of_object(morpher));
      Msgi::Options msgi;
      if (wanted.leaf_faces > 0)
        msgi.leaf_faces = wanted.leaf_faces;
      msgi.sweeps = wanted.sweeps;
      msgi.pins.assign(wanted.pins, wanted.pins + wanted.pin_count);
      if (wanted.max_bytes > 0)
        msgi.most_bytes = static_cast<size_t>(std::min<uint64_t>(wanted.max_bytes, SIZE_MAX));
      status =
          morpher->msgi.init(triangles, triangle_count, vertex_count, meshes, mesh_count, msgi);
      morpher->resident_bytes = memory_of_object(morpher).held;
    } catch (...) {
      destroy(morpher);
      throw;
    }
    if (status != Status::kOk) {
      destroy(morpher);
      return {status, 0, 0, ""};
    }
    *out = morpher;
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_destroy_morpher(anic_morpher* morpher) {
  destroy(morpher);
}

anic_status anic_get_morpher_info(const anic_morpher* morpher, anic_morpher_info* out) {
  if (!morpher || !is_sized(out))
    return ANIC_E_ARGUMENT;
  anic_morpher_info filled = ANIC_INIT(anic_morpher_info);
  filled.vertex_count = morpher->msgi.vertex_count();
  filled.mesh_count = static_cast<uint32_t>(morpher->msgi.input_count());
  filled.resident_bytes = morpher->resident_bytes;
  filled.scratch_bytes = morpher->msgi.scratch_bytes();
  filled.largest_turn = morpher->msgi.largest_turn();
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_morph(const anic_morpher* morpher, const double* weights,
                       const float* pin_positions, const anic_threads* threads, void* scratch,
                       size_t scratch_size, float* out) {
  if (!morpher || !weights || !out || !scratch ||
      reinterpret_cast<uintptr_t>(scratch) % alignof(double) != 0)
    return ANIC_E_ARGUMENT;
  if (scratch_size < morpher->msgi.scratch_bytes())
    return ANIC_E_BUFFER_SIZE;
  HostThreads host;
  if (threads)
    host = {threads->run, threads->user};
  return c_status(morpher->msgi.evaluate(weights, pin_positions, scratch, out, host));
}
