// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: render vertices.
#include "sdk/api/normals.h"
#include "sdk/play/attribute_values.h"
#include "sdk/play/render_plan.h"
#include "sdk/play/value_output.h"

#include <algorithm>
#include <cstring>

struct anic_render_plan {
  uint32_t mesh = 0;
  uint32_t vertices = 0, corners = 0;  ///< of the mesh that it was made of
  anicodec::RenderPlan plan;
};

namespace anicodec {
namespace {

/// Vertices that are made at a time, a multiple of 16: their positions stay in the nearest cache.
constexpr uint32_t kVerticesAtOnce = 256;
constexpr size_t kLargestPosition = 16;

/// Labels of the polygons' materials; null: there are none.
const uint32_t* material_labels(const Mesh& mesh) {
  const auto found = std::find_if(
      mesh.attributes.begin(), mesh.attributes.end(),
      [](const MeshAttribute& a) { return a.header.kind == AttributeKind::kMaterial; });
  return found == mesh.attributes.end() ? nullptr : found->labels.data();
}

Vector<CornerValues> corner_values(const Mesh& mesh) {
  Vector<CornerValues> result;
  for (const MeshAttribute& a : mesh.attributes) {
    if (a.header.domain != AttributeDomain::kCorner || a.header.components() == 0)
      continue;
    result.push_back({a.values.data(), a.header.components()});
    if (!a.surface.vertex_coded.empty())  // equal in frame 0 alone
      result.push_back({a.surface.vertex_coded.data(), 1});
  }
  return result;
}

bool is_of_mesh(const anic_render_plan& plan, const Clip& clip) {
  return plan.mesh < clip.meshes().size() && clip.vertex_count(plan.mesh) == plan.vertices &&
         clip.meshes()[plan.mesh].topology.polygon_corners.size() == plan.corners;
}

bool is_range(const anic_render_plan& plan, uint32_t first, uint32_t count) {
  return first <= plan.plan.size() && count <= plan.plan.size() - first;
}

/// Walks over render vertices and the vertices that they show, so many of these at a time:
/// body(first render vertex, end, first vertex, end).
template <class Body>
void for_each_run(const RenderPlan& plan, uint32_t first, uint32_t count, uint32_t at_once,
                  Body body) {
  const uint32_t* vertices = plan.vertices.data();
  for (uint32_t r = first; r < first + count;) {
    const uint32_t begin = vertices[r];
    const uint32_t limit = begin / at_once * at_once + at_once;
    const auto end = static_cast<uint32_t>(
        std::lower_bound(vertices + r, vertices + first + count, limit) - vertices);
    body(r, end, begin, vertices[end - 1] + 1);
    r = end;
  }
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_create_render_plan(const anic_asset* asset, uint32_t mesh,
                                    const anic_render_plan_options* options,
                                    const anic_allocator* allocator, anic_render_plan** out) {
  if (out)
    *out = nullptr;
  anic_render_plan_options wanted;
  if (!take(options, &wanted) || !out || (allocator && !allocator->allocate != !allocator->release))
    return ANIC_E_ARGUMENT;
  anic_normal_plan_options normals = ANIC_INIT(anic_normal_plan_options);
  normals.crease_angle = wanted.crease_angle;
  normals.reference_frame = wanted.reference_frame;
  normals.source_edges = wanted.source_edges;
  normals.per_corner = 1;
  if (anic_status status = check_normal_options(asset, mesh, normals); status != ANIC_OK)
    return status;
  auto make = [&]() -> Failure {
    Memory memory = allocator ? memory_of(allocator) : memory_of_object(asset);
    memory.held = memory.peak = 0;
    auto* made = create<anic_render_plan>(memory, 0);
    try {
      const MemoryScope scope(&memory_of_object(made));
      const Mesh& of = asset->clip.meshes()[mesh];
      made->mesh = mesh;
      made->vertices = asset->clip.vertex_count(mesh);
      made->corners = static_cast<uint32_t>(of.topology.polygon_corners.size());
      Vector<float> pose;  // triangles need none
      if (has_larger_polygons(of.topology)) {
        pose.resize(size_t{3} * made->vertices);
        show_positions(asset->clip, mesh, wanted.reference_frame, pose.data());
      }
      made->plan =
          plan_rendering(of.topology, plan_normals(asset->clip, mesh, normals), corner_values(of),
                         material_labels(of), pose.empty() ? nullptr : pose.data());
    } catch (...) {
      destroy(made);
      throw;
    }
    *out = made;
    return {};
  };
  return c_status(guarded(make).status);
}

void anic_destroy_render_plan(anic_render_plan* plan) {
  destroy(plan);
}

anic_status anic_get_render_info(const anic_render_plan* plan, anic_render_info* out) {
  if (!plan || !is_sized(out))
    return ANIC_E_ARGUMENT;
  const RenderPlan& of = plan->plan;
  anic_render_info filled = ANIC_INIT(anic_render_info);
  filled.vertices = of.vertices.data();
  filled.corners = plan->corners > 0 ? of.corners.data() : nullptr;
  filled.indices = of.indices.data();
  filled.triangle_polygons = of.triangle_polygons.data();
  filled.group_materials = of.group_labels.data();
  filled.group_begin = of.group_begin.data();
  filled.mesh = plan->mesh;
  filled.vertex_count = of.size();
  filled.triangle_count = static_cast<uint32_t>(of.triangle_polygons.size());
  filled.group_count = static_cast<uint32_t>(of.group_labels.size());
  static_assert(sizeof(NormalPlan::Corner) == 2 * sizeof(uint32_t));
  filled.normal_group_count = static_cast<uint32_t>(of.normals.centre.size());
  filled.normal_groups = of.normals.group.data();
  filled.normal_centres = of.normals.centre.data();
  filled.normal_begin = of.normals.begin.data();
  filled.normal_corners = reinterpret_cast<const uint32_t*>(of.normals.corners.data());
  give(filled, out);
  return ANIC_OK;
}

anic_status anic_write_render_positions(const anic_render_plan* plan, const anic_context* context,
                                        anic_when when, uint32_t first, uint32_t count,
                                        const anic_output* out) {
  if (!plan || !context || !is_of_mesh(*plan, context->asset->clip))
    return ANIC_E_ARGUMENT;
  const Sample* sample = nullptr;
  if (anic_status status = find_sample(context, plan->mesh, when, &sample); status != ANIC_OK)
    return status;
  if (!is_range(*plan, first, count))
    return ANIC_E_ARGUMENT;
  VertexOutput output;
  if (Status status = check_output(out, count, &output); status != Status::kOk)
    return c_status(status);
  alignas(16) unsigned char made[kVerticesAtOnce * kLargestPosition];
  const size_t size = vertex_format_size(output.format), stride = output.stride;
  VertexOutput packed = output;
  packed.data = made;
  packed.stride = size;
  auto* to = static_cast<unsigned char*>(output.data);
  const uint32_t* vertices = plan->plan.vertices.data();
  for_each_run(plan->plan, first, count, kVerticesAtOnce,
               [&](uint32_t r, uint32_t end, uint32_t begin_vertex, uint32_t end_vertex) {
                 sample->positions(begin_vertex, end_vertex - begin_vertex, packed);
                 for (; r < end; ++r, to += stride)
                   std::memcpy(to, made + size * (vertices[r] - begin_vertex), size);
               });
  return ANIC_OK;
}

anic_status anic_write_render_normals(const anic_render_plan* plan, const float* positions,
                                      size_t stride, uint32_t first, uint32_t count,
                                      const anic_output* out) {
  if (!plan || !positions || stride % sizeof(float) != 0 ||
      (stride > 0 && stride < 3 * sizeof(float)) || !is_range(*plan, first, count))
    return ANIC_E_ARGUMENT;
  VertexOutput output;
  if (Status status = check_output(out, count, &output); status != Status::kOk)
    return c_status(status);
  if (count > 0)
    compute_normals(plan->plan.normals, positions, stride > 0 ? stride : 3 * sizeof(float), first,
                    count, output);
  return ANIC_OK;
}

anic_status anic_write_render_attribute(const anic_render_plan* plan, const anic_context* context,
                                        uint32_t attribute, anic_when when, uint32_t first,
                                        uint32_t count, const anic_value_output* out) {
  if (!plan || !context || !is_of_mesh(*plan, context->asset->clip))
    return ANIC_E_ARGUMENT;
  const Clip& clip = context->asset->clip;
  const Sample* sample = nullptr;
  const Vector<MeshAttribute>& attributes = clip.meshes()[plan->mesh].attributes;
  if (anic_status status = find_sample(context, plan->mesh, when, &sample); status != ANIC_OK)
    return status;
  if (attribute >= attributes.size() || !is_range(*plan, first, count))
    return ANIC_E_ARGUMENT;
  const MeshAttribute& found = attributes[attribute];
  const uint32_t components = found.header.components();
  anic_value_output wanted;
  if (found.header.domain == AttributeDomain::kPolygon || components == 0 || !out ||
      !take(out, &wanted))
    return ANIC_E_ARGUMENT;
  ValueOutput output;
  if (Status status = ValueOutput::make(wanted, components, count, &output); status != Status::kOk)
    return c_status(status);
  const auto [begin, end] = clip.attribute_tracks(plan->mesh, attribute);
  float values[kValueRange * kMaxAttributeComponents];
  if (found.header.domain == AttributeDomain::kCorner) {
    for (uint32_t r = first; r < first + count; ++r) {
      const uint32_t corner = plan->plan.corners[r];
      std::copy_n(found.values.data() + size_t{components} * corner, components, values);
      for (uint32_t t = begin; t < end; ++t)
        context->states[when].samples[t].add_motion(components, corner, 1, values);
      output.store(values, 1);
    }
    return ANIC_OK;
  }
  const uint32_t* vertices = plan->plan.vertices.data();
  for_each_run(
      plan->plan, first, count, kValueRange,
      [&, begin = begin, end = end](uint32_t r, uint32_t r_end, uint32_t v, uint32_t v_end) {
        std::copy_n(found.values.data() + size_t{components} * v, size_t{components} * (v_end - v),
                    values);
        for (uint32_t t = begin; t < end; ++t)
          context->states[when].samples[t].add_motion(components, v, v_end - v, values);
        for (; r < r_end; ++r)
          output.store(values + size_t{components} * (vertices[r] - v), 1);
      });
  return ANIC_OK;
}
