// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: normals.
#include "sdk/api/normals.h"

#include "sdk/base/quaternion.h"

#include <algorithm>
#include <cmath>

struct anic_normal_plan {
  anicodec::NormalPlan plan;
};

namespace anicodec {
namespace {

/// Which corners share a normal in the source; null if the file does not tell.
const Vector<uint32_t>* source_edges(const Mesh& mesh) {
  const auto found =
      std::find_if(mesh.attributes.begin(), mesh.attributes.end(), [](const MeshAttribute& a) {
        return a.header.kind == AttributeKind::kNormal && a.header.components() == 0;
      });
  return found == mesh.attributes.end() ? nullptr : &found->labels;
}

}  // namespace

anic_status check_normal_options(const anic_asset* asset, uint32_t mesh,
                                 const anic_normal_plan_options& options) {
  if (!asset || mesh >= asset->clip.meshes().size() || !(options.crease_angle >= 0))
    return ANIC_E_ARGUMENT;
  if (options.reference_frame >= asset->clip.frame_count())
    return ANIC_E_FRAME_RANGE;
  return asset->clip.segment_at(mesh, options.reference_frame) ? ANIC_OK : ANIC_E_ABSENT;
}

NormalPlan plan_normals(const Clip& clip, uint32_t mesh, const anic_normal_plan_options& options) {
  const Mesh& of = clip.meshes()[mesh];
  const bool per_corner = options.per_corner != 0;
  if (const Vector<uint32_t>* edges = options.source_edges ? source_edges(of) : nullptr)
    return plan_normals(of.topology, *edges, per_corner);
  const double degrees = options.crease_angle > 0 ? options.crease_angle : 180;
  const UnitQuaternion turn = exp_rotation({{degrees * 3.14159265358979323846 / 180, 0, 0}});
  const double cosine = degrees < 180 ? 2 * turn.w * turn.w - 1 : -2;
  Vector<float> pose(size_t{3} * clip.vertex_count(mesh));
  show_positions(clip, mesh, options.reference_frame, pose.data());
  return plan_normals(of.topology, pose.data(), cosine, per_corner);
}

}  // namespace anicodec

using namespace anicodec;

anic_status anic_create_normal_plan(const anic_asset* asset, uint32_t mesh,
                                    const anic_normal_plan_options* options,
                                    const anic_allocator* allocator, anic_normal_plan** out) {
  if (out)
    *out = nullptr;
  anic_normal_plan_options wanted;
  if (!take(options, &wanted) || !out || (allocator && !allocator->allocate != !allocator->release))
    return ANIC_E_ARGUMENT;
  if (anic_status status = check_normal_options(asset, mesh, wanted); status != ANIC_OK)
    return status;
  auto make = [&]() -> Failure {
    Memory memory = allocator ? memory_of(allocator) : memory_of_object(asset);
    memory.held = memory.peak = 0;
    auto* normals = create<anic_normal_plan>(memory, 0);
    try {
      const MemoryScope scope(&memory_of_object(normals));
      normals->plan = plan_normals(asset->clip, mesh, wanted);
    } catch (...) {
      destroy(normals);
      throw;
    }
    *out = normals;
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_destroy_normal_plan(anic_normal_plan* normals) {
  destroy(normals);
}

uint32_t anic_get_normal_count(const anic_normal_plan* normals) {
  return normals ? normals->plan.size() : 0;
}

anic_status anic_write_normals(const anic_normal_plan* normals, const float* positions,
                               size_t stride, uint32_t first, uint32_t count,
                               const anic_output* out) {
  if (!normals || !positions || stride % sizeof(float) != 0 ||
      (stride > 0 && stride < 3 * sizeof(float)) || first > normals->plan.size() ||
      count > normals->plan.size() - first)
    return ANIC_E_ARGUMENT;
  VertexOutput output;
  if (Status status = check_output(out, count, &output); status != Status::kOk)
    return c_status(status);
  if (count > 0)
    compute_normals(normals->plan, positions, stride > 0 ? stride : 3 * sizeof(float), first, count,
                    output);
  return ANIC_OK;
}
