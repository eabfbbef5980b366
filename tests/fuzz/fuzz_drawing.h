// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#ifndef ANICODEC_TESTS_FUZZ_FUZZ_DRAWING_H_
#define ANICODEC_TESTS_FUZZ_FUZZ_DRAWING_H_

#include "tests/fuzz/fuzz_asset.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace anicodec {

/// Render vertices of a mesh at the time chosen: they name what is there, and stay inside their outputs.
inline void draw(const anic_asset* asset, const anic_context* context, const anic_mesh& sizes,
                 uint32_t mesh, Script* script) {
  anic_render_plan_options wanted = ANIC_INIT(anic_render_plan_options);
  wanted.crease_angle = script->byte() % 3 * 30;
  wanted.source_edges = script->byte() % 2;
  anic_render_plan* plan = nullptr;
  if (anic_create_render_plan(asset, mesh, &wanted, nullptr, &plan) != ANIC_OK)
    return;
  anic_render_info info = ANIC_INIT(anic_render_info);
  require(anic_get_render_info(plan, &info) == ANIC_OK);
  for (uint32_t v = 0; v < info.vertex_count; ++v) {
    require(info.vertices[v] < sizes.vertex_count &&
            info.normal_groups[v] < info.normal_group_count);
    require(info.corners == nullptr || info.corners[v] < sizes.corner_count);
  }
  for (uint32_t i = 0; i < 3 * info.triangle_count; ++i)
    require(info.indices[i] < info.vertex_count);
  const uint32_t first = script->below(info.vertex_count + 1);
  const uint32_t count = script->below(info.vertex_count - first + 1);
  const GuardedOutput points(count, script), normals(count, script);
  if (anic_write_render_positions(plan, context, ANIC_WHEN_CURRENT, first, count, points.out()) ==
      ANIC_OK)
    points.check();
  std::vector<float> all(size_t{3} * info.vertex_count, 1.0F);
  require(anic_write_render_normals(plan, all.data(), 0, first, count, normals.out()) == ANIC_OK);
  normals.check();
  for (uint32_t a = 0; a < sizes.attribute_count; ++a) {
    std::vector<unsigned char> values(size_t{16} * count * 2);
    anic_value_output out = ANIC_INIT(anic_value_output);
    out.data = values.data();
    out.size = values.size();
    out.components = script->below(8);
    anic_write_render_attribute(plan, context, a, ANIC_WHEN_CURRENT, first, count, &out);
  }
  anic_destroy_render_plan(plan);
}

/// A point of the surface and a ray at the time chosen.
inline void touch(const anic_asset* asset, const anic_context* context, const anic_mesh& sizes,
                  uint32_t mesh, Script* script) {
  anic_surface_point point = {};
  for (uint32_t& v : point.vertices)
    v = script->below(sizes.vertex_count + 1);
  for (float& w : point.weights)
    w = static_cast<float>(script->byte() % 4) / 3;
  anic_surface_frame frame;
  if (anic_get_surface_frame(context, mesh, ANIC_WHEN_CURRENT, &point, &frame) == ANIC_OK) {
    for (const uint32_t v : point.vertices)
      require(v < sizes.vertex_count);
    for (int i = 0; i < 3; ++i)
      require(std::isfinite(frame.normal[i]) && std::isfinite(frame.tangent[i]));
  }
  std::vector<uint32_t> triangles(size_t{3} * sizes.triangle_count);
  require(anic_write_indices(asset, mesh, 4, triangles.data(), 4 * triangles.size()) == ANIC_OK);
  std::vector<float> work(size_t{3} * sizes.vertex_count);
  anic_output all = ANIC_INIT(anic_output);
  all.data = work.data();
  all.size = sizeof(float) * work.size();
  anic_ray ray = ANIC_INIT(anic_ray);
  if (sizes.triangle_count > 0)  // the ray goes through the middle of a triangle
    anic_write_positions(context, mesh, ANIC_WHEN_CURRENT, 0, sizes.vertex_count, &all);
  const size_t aim = size_t{3} * script->below(sizes.triangle_count);
  for (uint32_t i = 0; i < 3; ++i) {
    ray.direction[i] = static_cast<float>(script->byte() % 5) - 2;
    for (size_t k = aim; k < aim + 3 && k < triangles.size(); ++k)
      ray.origin[i] += work[size_t{3} * triangles[k] + i] / 3;
    ray.origin[i] -= ray.direction[i];
  }
  ray.side = static_cast<anic_side>(script->byte() % 3);
  anic_hit hit;
  if (anic_intersect_ray(context, mesh, ANIC_WHEN_CURRENT, &ray, triangles.data(),
                         sizes.triangle_count, work.data(), sizeof(float) * work.size(),
                         &hit) == ANIC_OK)
    require(hit.triangle == UINT32_MAX ? std::isinf(hit.distance)
                                       : hit.triangle < sizes.triangle_count && hit.distance >= 0);
}

/// Calls of a host that draws an asset.
inline void draw(const anic_asset* asset, Script script) {
  anic_asset_info info = ANIC_INIT(anic_asset_info);
  anic_get_asset_info(asset, &info);
  anic_context* context = nullptr;
  if (anic_create_context(asset, nullptr, &context) != ANIC_OK)
    return;
  for (int step = 0; step < 2; ++step) {
    const uint32_t mesh = script.below(info.mesh_count);
    anic_mesh sizes = ANIC_INIT(anic_mesh);
    require(anic_get_mesh(asset, mesh, &sizes) == ANIC_OK);
    anic_seek_time(context, info.duration * script.byte() / 255, ANIC_SAMPLE_LINEAR,
                   ANIC_WRAP_CLAMP);
    draw(asset, context, sizes, mesh, &script);
    touch(asset, context, sizes, mesh, &script);
    anic_root_motion motion = ANIC_INIT(anic_root_motion);
    const double from = script.byte() / 16.0, to = script.byte() / 16.0;
    if (anic_get_root_step(asset, script.below(anic_get_clip_count(asset)), from, to,
                           ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, &motion) == ANIC_OK) {
      for (const float x : motion.matrix)
        require(std::isfinite(x));
    }
  }
  anic_destroy_context(context);
}

/// Reads a file without opening it: its metadata lie in it, and its boxes are finite.
inline void read_unopened(const Bytes& file, Script script) {
  const char* text = nullptr;
  size_t length = 0;
  if (anic_read_metadata(file.data(), file.size(), &text, &length) == ANIC_OK) {
    const auto* const begin = reinterpret_cast<const char*>(file.data());
    require(text >= begin && length <= file.size() &&
            static_cast<size_t>(text - begin) <= file.size() - length);
  }
  anic_box box;
  if (anic_read_bounds(file.data(), file.size(), script.byte() % 3, script.below(64),
                       script.byte() % 4, &box) == ANIC_OK) {
    for (int i = 0; i < 3; ++i)
      require(std::isfinite(box.min[i]) && std::isfinite(box.max[i]));  // one too small is not told
  }
}

}  // namespace anicodec

#endif  // ANICODEC_TESTS_FUZZ_FUZZ_DRAWING_H_
