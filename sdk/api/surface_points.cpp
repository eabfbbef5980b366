// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//
// The C interface: points of the surface, and rays.
#include "sdk/api/objects.h"
#include "sdk/play/ray_hit.h"
#include "sdk/play/triangle_axes.h"

#include <algorithm>
#include <cmath>

namespace anicodec {
namespace {

bool is_finite(const float (&values)[3]) {
  return std::all_of(values, values + 3, [](float value) { return std::isfinite(value); });
}

/// Whether a ray may meet a mesh as it is shown now, by the boxes of its frames. True where they do
/// not bound it.
bool may_meet(const anic_context& context, uint32_t mesh, const Sample& sample, const RayHit& ray) {
  const OpenedFile& file = *context.asset->file;
  const FrameMix& mix = context.mix;
  if (file.boxes.empty())
    return true;
  for (uint32_t i = 0; i < sample.count; ++i) {
    const FrameState& part = sample.parts[i];
    const Segment& segment = *part.segment;
    // Only whole frames have corrections; MSGI and turns leave the straight line between frames.
    const bool between = mix.count > 1 && (!segment.corrections.empty() || !segment.exact.empty() ||
                                           !segment.msgi.empty() || part.moves);
    if (between || part.components < segment.components)
      return true;
  }
  anic_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t t = 0; t < mix.count; ++t) {
    if (mix.terms[t].weight < 0)
      return true;
    const size_t row = size_t{context.asset->clip.frame_count()} + 1;
    const anic_box& frame = file.boxes[row * mesh + mix.terms[t].frame];
    for (size_t c = 0; c < 3; ++c) {
      box.min[c] = std::min(box.min[c], frame.min[c]);
      box.max[c] = std::max(box.max[c], frame.max[c]);
    }
  }
  return ray.meets_box(box.min, box.max);
}

}  // namespace
}  // namespace anicodec

using namespace anicodec;

anic_status anic_get_surface_frame(const anic_context* context, uint32_t mesh, anic_when when,
                                   const anic_surface_point* point, anic_surface_frame* out) {
  const Sample* sample = nullptr;
  if (!point || !out || !is_finite(point->weights))
    return ANIC_E_ARGUMENT;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  const uint32_t vertices = context->asset->clip.vertex_count(mesh);
  Vector3 corners[3], position;
  for (size_t i = 0; i < 3; ++i) {
    if (point->vertices[i] >= vertices)
      return ANIC_E_ARGUMENT;
    float corner[3];
    VertexOutput output;
    output.data = corner;
    sample->positions(point->vertices[i], 1, output);
    corners[i] = vector_at(corner);
    position += point->weights[i] * corners[i];
  }
  const TriangleAxes axes(corners);
  for (size_t c = 0; c < 3; ++c) {
    out->position[c] = static_cast<float>(position[c]);
    out->normal[c] = static_cast<float>(axes.normal[c]);
    out->tangent[c] = static_cast<float>(axes.tangent[c]);
  }
  return ANIC_OK;
}

anic_status anic_intersect_ray(const anic_context* context, uint32_t mesh, anic_when when,
                               const anic_ray* host, const uint32_t* triangles,
                               uint32_t triangle_count, float* work, size_t work_size,
                               anic_hit* out) {
  anic_ray ray;
  if (!host || !take(host, &ray) || !work || !out || (triangle_count > 0 && !triangles) ||
      !is_finite(ray.origin) || !is_finite(ray.direction) ||
      std::all_of(ray.direction, ray.direction + 3, [](float d) { return d == 0; }) ||
      !(ray.farthest >= 0) || ray.side < ANIC_SIDE_ANY || ray.side > ANIC_SIDE_BACK)
    return ANIC_E_ARGUMENT;
  const Sample* sample = nullptr;
  if (anic_status status = find_sample(context, mesh, when, &sample); status != ANIC_OK)
    return status;
  *out = {};
  out->distance = INFINITY;
  out->triangle = UINT32_MAX;
  const uint32_t vertices = context->asset->clip.vertex_count(mesh);
  if (std::any_of(triangles, triangles + size_t{3} * triangle_count,
                  [&](uint32_t vertex) { return vertex >= vertices; }))
    return ANIC_E_ARGUMENT;
  if (work_size / (3 * sizeof(float)) < vertices)
    return ANIC_E_BUFFER_SIZE;
  RayHit hit(vector_at(ray.origin), vector_at(ray.direction),
             ray.farthest > 0 ? double{ray.farthest} : double{INFINITY},
             static_cast<RayHit::Side>(ray.side));
  if (when == ANIC_WHEN_CURRENT && !may_meet(*context, mesh, *sample, hit))
    return ANIC_OK;
  VertexOutput output;
  output.data = work;
  sample->positions(0, vertices, output);
  for (uint32_t t = 0; t < triangle_count; ++t) {
    const uint32_t* corners = triangles + size_t{3} * t;
    hit.offer(t, work + size_t{3} * corners[0], work + size_t{3} * corners[1],
              work + size_t{3} * corners[2]);
  }
  if (hit.triangle() == RayHit::kNone)
    return ANIC_OK;
  out->triangle = hit.triangle();
  out->distance = static_cast<float>(hit.distance());
  out->side = static_cast<anic_side>(hit.side());
  for (size_t i = 0; i < 3; ++i) {
    out->point.vertices[i] = triangles[size_t{3} * hit.triangle() + i];
    out->point.weights[i] = static_cast<float>(hit.weight(i));
  }
  return ANIC_OK;
}
