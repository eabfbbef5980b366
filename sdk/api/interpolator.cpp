// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: interpolation between meshes of the caller's.
#include "sdk/api/objects.h"
#include "sdk/msgi/msgi.h"

#include <algorithm>

struct anic_interpolator {
  anicodec::Msgi msgi;
  size_t resident_bytes = 0;
};

using namespace anicodec;

anic_status anic_interpolator_create(const uint32_t* triangles, uint32_t triangle_count,
                                     uint32_t vertex_count, const float* const* meshes,
                                     uint32_t mesh_count, const anic_interpolator_options* options,
                                     const anic_allocator* allocator, anic_interpolator** out) {
  if (out)
    *out = nullptr;
  const anic_interpolator_options wanted = options ? *options : anic_interpolator_options{};
  if (!out || !meshes || mesh_count < 2 || (!triangles && triangle_count > 0) ||
      (!wanted.pins && wanted.pin_count > 0) ||
      (allocator && !allocator->allocate != !allocator->release))
    return ANIC_E_ARGUMENT;
  for (uint32_t i = 0; i < mesh_count; ++i) {
    if (!meshes[i])
      return ANIC_E_ARGUMENT;
  }
  auto make = [&]() -> Failure {
    auto* interpolator = create<anic_interpolator>(memory_of(allocator), 0);
    Status status = Status::kOk;
    try {
      const MemoryScope scope(&memory_of_object(interpolator));
      Msgi::Options msgi;
      if (wanted.leaf_faces > 0)
        msgi.leaf_faces = wanted.leaf_faces;
      msgi.sweeps = wanted.sweeps;
      msgi.pins.assign(wanted.pins, wanted.pins + wanted.pin_count);
      if (wanted.bytes > 0)
        msgi.most_bytes = static_cast<size_t>(std::min<uint64_t>(wanted.bytes, SIZE_MAX));
      status = interpolator->msgi.init(triangles, triangle_count, vertex_count, meshes, mesh_count,
                                       msgi);
      interpolator->resident_bytes = memory_of_object(interpolator).held;
    } catch (...) {
      destroy(interpolator);
      throw;
    }
    if (status != Status::kOk) {
      destroy(interpolator);
      return {status, 0, 0, ""};
    }
    *out = interpolator;
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_interpolator_destroy(anic_interpolator* interpolator) {
  destroy(interpolator);
}

void anic_interpolator_info_get(const anic_interpolator* interpolator,
                                anic_interpolator_info* out) {
  if (!interpolator || !out)
    return;
  out->vertex_count = interpolator->msgi.vertex_count();
  out->mesh_count = static_cast<uint32_t>(interpolator->msgi.input_count());
  out->resident_bytes = interpolator->resident_bytes;
  out->scratch_bytes = interpolator->msgi.scratch_bytes();
  out->largest_turn = interpolator->msgi.largest_turn();
}

anic_status anic_interpolate(const anic_interpolator* interpolator, const double* weights,
                             const float* pin_positions, const anic_threads* threads, void* scratch,
                             size_t scratch_size, float* out) {
  if (!interpolator || !weights || !out || (threads && !threads->run) || !scratch ||
      reinterpret_cast<uintptr_t>(scratch) % alignof(double) != 0)
    return ANIC_E_ARGUMENT;
  if (scratch_size < interpolator->msgi.scratch_bytes())
    return ANIC_E_BUFFER_SIZE;
  HostThreads host;
  if (threads)
    host = {threads->run, threads->host};
  return c_status(interpolator->msgi.evaluate(weights, pin_positions, scratch, out, host));
}
