// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "sdk/mesh/polygon_cutter.h"
#include "tests/api/opened.h"

#include <anicodec/anicodec.hpp>

#include <cmath>
#include <cstring>
#include <set>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct PlanDestroyer {
  void operator()(anic_render_plan* plan) const { anic_destroy_render_plan(plan); }
};

using Plan = std::unique_ptr<anic_render_plan, PlanDestroyer>;

Plan plan_of(const Asset& asset, bool source_edges = true, double crease = 0) {
  anic_render_plan_options options = ANIC_INIT(anic_render_plan_options);
  options.source_edges = source_edges;
  options.crease_angle = crease;
  anic_render_plan* made = nullptr;
  EXPECT_EQ(anic_create_render_plan(asset.get(), 0, &options, nullptr, &made), ANIC_OK);
  return Plan(made);
}

anic_render_info info_of(const Plan& plan) {
  anic_render_info info = ANIC_INIT(anic_render_info);
  EXPECT_EQ(anic_get_render_info(plan.get(), &info), ANIC_OK);
  return info;
}

std::vector<float> render_positions(const Plan& plan, const Context& context) {
  std::vector<float> out(size_t{3} * info_of(plan).vertex_count);
  const anic_output output = floats(out);
  EXPECT_EQ(anic_write_render_positions(plan.get(), context.get(), ANIC_WHEN_CURRENT, 0,
                                        info_of(plan).vertex_count, &output),
            ANIC_OK);
  return out;
}

/// The data of a corner: its vertex, its values, its normal.
std::vector<float> carried(const Asset& asset, uint32_t corner, const std::vector<float>& normals) {
  anic_polygons polygons = ANIC_INIT(anic_polygons);
  anic_get_polygons(asset.get(), 0, &polygons);
  std::vector<float> key = {static_cast<float>(polygons.corners[corner])};
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_get_mesh(asset.get(), 0, &mesh);
  for (uint32_t a = 0; a < mesh.attribute_count; ++a) {
    anic_attribute attribute = ANIC_INIT(anic_attribute);
    anic_get_attribute(asset.get(), 0, a, &attribute);
    if (attribute.domain == ANIC_DOMAIN_CORNERS && attribute.components > 0) {
      const float* values = attribute.values + size_t{attribute.components} * corner;
      key.insert(key.end(), values, values + attribute.components);
    }
  }
  key.insert(key.end(), &normals[size_t{3} * corner], &normals[size_t{3} * corner] + 3);
  return key;
}

std::vector<float> corner_normals(const Asset& asset, const std::vector<float>& p, double crease) {
  anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
  options.per_corner = options.source_edges = 1;
  options.crease_angle = crease;
  anic_normal_plan* plan = nullptr;
  EXPECT_EQ(anic_create_normal_plan(asset.get(), 0, &options, nullptr, &plan), ANIC_OK);
  std::vector<float> out(size_t{3} * anic_get_normal_count(plan));
  const anic_output output = floats(out);
  EXPECT_EQ(
      anic_write_normals(plan, p.data(), 0, 0, static_cast<uint32_t>(out.size() / 3), &output),
      ANIC_OK);
  anic_destroy_normal_plan(plan);
  return out;
}

TEST(AnicRenderVertices, TrianglesShowWhatPolygonsAre) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Asset asset = open(encoded_clip(name, basis));
    const Context context = context_of(asset);
    ASSERT_EQ(anic_seek_frame(context.get(), 1), ANIC_OK);
    for (const double crease : {0.0, 30.0}) {
      const Plan plan = plan_of(asset, true, crease);
      const anic_render_info info = info_of(plan);
      const std::vector<float> p = positions(asset, context), rp = render_positions(plan, context);
      anic_polygons polygons = ANIC_INIT(anic_polygons);
      anic_get_polygons(asset.get(), 0, &polygons);
      anic_mesh mesh = ANIC_INIT(anic_mesh);
      anic_get_mesh(asset.get(), 0, &mesh);
      ASSERT_EQ(info.triangle_count, mesh.triangle_count);
      if (mesh.corner_count == 0) {
        EXPECT_EQ(rp, p);  // points
        EXPECT_EQ(info.corners, nullptr);
        continue;
      }
      for (uint32_t r = 0; r < info.vertex_count; ++r) {
        ASSERT_EQ(polygons.corners[info.corners[r]], info.vertices[r]);
        ASSERT_EQ(std::memcmp(&rp[size_t{3} * r], &p[size_t{3} * info.vertices[r]], 12), 0);
        ASSERT_TRUE(r == 0 || info.vertices[r - 1] <= info.vertices[r]);
      }
      // Normals, from the render positions, are those of the corners.
      std::vector<float> n(rp.size());
      const anic_output output = floats(n);
      ASSERT_EQ(anic_write_render_normals(plan.get(), rp.data(), 0, 0, info.vertex_count, &output),
                ANIC_OK);
      for (uint32_t r = 0; r < info.vertex_count; ++r) {
        const uint32_t g = info.normal_groups[r];
        ASSERT_LT(g, info.normal_group_count);
        double sum[3] = {0, 0, 0};
        const float* centre = &rp[size_t{3} * info.normal_centres[g]];
        for (uint32_t c = info.normal_begin[g]; c < info.normal_begin[g + 1]; ++c) {
          const float* a = &rp[size_t{3} * info.normal_corners[2 * c]];
          const float* b = &rp[size_t{3} * info.normal_corners[2 * c + 1]];
          for (size_t k = 0; k < 3; ++k) {
            const size_t i = (k + 1) % 3, j = (k + 2) % 3;
            sum[k] += static_cast<double>((a[i] - centre[i]) * (b[j] - centre[j]) -
                                          (a[j] - centre[j]) * (b[i] - centre[i]));
          }
        }
        const double length = std::hypot(sum[0], sum[1], sum[2]);
        for (size_t k = 0; k < 3 && length > 1e-6; ++k)
          ASSERT_NEAR(sum[k] / length, static_cast<double>(n[3 * size_t{r} + k]), 1e-3);
      }
      const std::vector<float> of_corners = corner_normals(asset, p, crease);
      for (uint32_t r = 0; r < info.vertex_count; ++r)
        ASSERT_EQ(std::memcmp(&n[size_t{3} * r], &of_corners[size_t{3} * info.corners[r]], 12), 0);
      // Every triangle is one of its polygon, cut in frame 0, whose corners carry what its vertices do.
      const std::vector<float> pose = frame(asset, 0);
      PolygonCutter cutter(pose.data(), mesh.corner_count);
      for (uint32_t t = 0; t < info.triangle_count;) {
        const uint32_t q = info.triangle_polygons[t], first = polygons.offsets[q];
        Vector<uint32_t> triangles;
        cutter.cut(polygons.corners + first, polygons.offsets[q + 1] - first, &triangles);
        for (size_t i = 0; i < triangles.size(); ++i)
          ASSERT_EQ(carried(asset, info.corners[info.indices[size_t{3} * t + i]], of_corners),
                    carried(asset, first + triangles[i], of_corners));
        t += static_cast<uint32_t>(triangles.size() / 3);
      }
      EXPECT_EQ(info.group_begin[info.group_count], info.triangle_count);
    }
  }
}

TEST(AnicRenderVertices, AreAsFewAsPossible) {
  const Asset asset = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  const std::vector<float> p = frame(asset, 0);
  const Plan plan = plan_of(asset);
  const anic_render_info info = info_of(plan);
  anic_polygons polygons = ANIC_INIT(anic_polygons);
  anic_get_polygons(asset.get(), 0, &polygons);
  std::set<std::vector<float>> distinct;
  const std::vector<float> normals = corner_normals(asset, p, 0);
  for (uint32_t c = 0; c < polygons.offsets[polygons.polygon_count]; ++c)
    distinct.insert(carried(asset, c, normals));
  EXPECT_EQ(info.vertex_count, distinct.size());
  EXPECT_GT(info.vertex_count, 98U);  // hard edges part vertices

  // Groups are materials, in order.
  std::set<uint32_t> materials;
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  anic_get_mesh(asset.get(), 0, &mesh);
  for (uint32_t a = 0; a < mesh.attribute_count; ++a) {
    anic_attribute attribute = ANIC_INIT(anic_attribute);
    anic_get_attribute(asset.get(), 0, a, &attribute);
    if (attribute.kind != ANIC_ATTRIBUTE_MATERIAL)
      continue;
    for (uint32_t g = 0; g < info.group_count; ++g) {
      materials.insert(info.group_materials[g]);
      for (uint32_t t = info.group_begin[g]; t < info.group_begin[g + 1]; ++t)
        ASSERT_EQ(attribute.labels[info.triangle_polygons[t]], info.group_materials[g]);
    }
  }
  EXPECT_EQ(materials.size(), info.group_count);
  EXPECT_GT(info.group_count, 1U);
}

TEST(AnicRenderVertices, RangesFormatsAndStridesAgree) {
  const Asset asset = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  const Context context = context_of(asset);
  ASSERT_EQ(anic_seek_time(context.get(), 0.11, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP), ANIC_OK);
  const Plan plan = plan_of(asset);
  const uint32_t n = info_of(plan).vertex_count;
  const std::vector<float> whole = render_positions(plan, context);
  for (const uint32_t first : {0U, 5U, 77U}) {
    for (const uint32_t count : {0U, 1U, n - first}) {
      std::vector<float> out(size_t{5} * n + 5, 7);
      anic_output output = floats(out);
      output.stride = 20;
      output.format = ANIC_FORMAT_FLOAT32X4;
      ASSERT_EQ(anic_write_render_positions(plan.get(), context.get(), ANIC_WHEN_CURRENT, first,
                                            count, &output),
                ANIC_OK);
      for (uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(std::memcmp(&out[size_t{5} * i], &whole[size_t{3} * (first + i)], 12), 0);
        ASSERT_EQ(out[size_t{5} * i + 3], 1);
        ASSERT_EQ(out[size_t{5} * i + 4], 7);
      }
      ASSERT_EQ(out[size_t{5} * count], 7);
    }
  }
  std::vector<float> small(size_t{3} * n - 1);
  const anic_output output = floats(small);
  EXPECT_EQ(
      anic_write_render_positions(plan.get(), context.get(), ANIC_WHEN_CURRENT, 0, n, &output),
      ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(
      anic_write_render_positions(plan.get(), context.get(), ANIC_WHEN_CURRENT, 1, n, &output),
      ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_write_render_normals(plan.get(), small.data(), 6, 0, 1, &output), ANIC_E_ARGUMENT);
  const Asset other = open(encoded_clip("cloth", BasisChoice::kEigenshapes));
  const Context of_other = context_of(other);
  ASSERT_EQ(anic_seek_frame(of_other.get(), 0), ANIC_OK);
  EXPECT_EQ(
      anic_write_render_positions(plan.get(), of_other.get(), ANIC_WHEN_CURRENT, 0, 1, &output),
      ANIC_E_ARGUMENT);
}

TEST(AnicRenderVertices, TheWrapperDoesTheSame) {
  const Bytes& file = encoded_clip("painted_box", BasisChoice::kKeyframes);
  anic::Asset asset;
  ASSERT_TRUE(asset.open(file));
  anic::Context context;
  ASSERT_TRUE(context.create(asset));
  ASSERT_TRUE(context.seek_frame(2));
  anic::RenderPlan plan;
  EXPECT_EQ(plan.info().vertex_count, 0U);
  ASSERT_TRUE(plan.create(asset));
  const uint32_t n = plan.info().vertex_count;
  ASSERT_GT(n, 0U);
  std::vector<float> p(size_t{3} * n), normals(p.size());
  ASSERT_TRUE(plan.write_positions(context, floats(p), 0, n));
  ASSERT_TRUE(plan.write_normals(p.data(), floats(normals), 0, n));
  EXPECT_EQ(plan.write_positions(context, floats(p), 1, n).code(), ANIC_E_ARGUMENT);
}

TEST(AnicRenderVertices, ValuesOfCornersAndOfMovingVertices) {
  for (const char* name : {"painted_box", "heated"}) {
    SCOPED_TRACE(name);
    const Asset asset = open(encoded_clip(name, BasisChoice::kEigentrajectories));
    const Context context = context_of(asset);
    ASSERT_EQ(anic_seek_frame(context.get(), 3), ANIC_OK);
    const Plan plan = plan_of(asset);
    const anic_render_info info = info_of(plan);
    anic_mesh mesh = ANIC_INIT(anic_mesh);
    anic_get_mesh(asset.get(), 0, &mesh);
    uint32_t seen = 0;
    for (uint32_t a = 0; a < mesh.attribute_count; ++a) {
      anic_attribute attribute = ANIC_INIT(anic_attribute);
      anic_get_attribute(asset.get(), 0, a, &attribute);
      std::vector<float> out(size_t{info.vertex_count} * std::max(attribute.components, 1U));
      anic_value_output output = ANIC_INIT(anic_value_output);
      output.data = out.data();
      output.size = out.size() * sizeof(float);
      const anic_status status = anic_write_render_attribute(
          plan.get(), context.get(), a, ANIC_WHEN_CURRENT, 0, info.vertex_count, &output);
      if (attribute.domain == ANIC_DOMAIN_POLYGONS || attribute.components == 0) {
        EXPECT_EQ(status, ANIC_E_ARGUMENT);
        continue;
      }
      ASSERT_EQ(status, ANIC_OK);
      std::vector<float> expected(
          attribute.values, attribute.values + size_t{attribute.count} * attribute.components);
      if (attribute.domain == ANIC_DOMAIN_VERTICES) {
        output.data = expected.data();
        output.size = expected.size() * sizeof(float);
        ASSERT_EQ(anic_write_attribute(context.get(), 0, a, ANIC_WHEN_CURRENT, 0, attribute.count,
                                       &output),
                  ANIC_OK);
      }
      const uint32_t* element =
          attribute.domain == ANIC_DOMAIN_VERTICES ? info.vertices : info.corners;
      for (uint32_t r = 0; r < info.vertex_count; ++r)
        ASSERT_EQ(std::memcmp(&out[size_t{r} * attribute.components],
                              &expected[size_t{element[r]} * attribute.components],
                              attribute.components * sizeof(float)),
                  0);
      ++seen;
    }
    EXPECT_GT(seen, 0U);
  }
}

TEST(AnicRenderVertices, FailWithoutALeakWhenThereIsNoMemory) {
  const Asset asset = open(encoded_clip("polygons", BasisChoice::kKeyframes));
  anic_status status = ANIC_E_MEMORY;
  for (size_t n = 0; status != ANIC_OK; ++n) {
    CountingMemory memory;
    memory.fail_at = n;
    const anic_allocator allocator = memory.allocator();
    anic_render_plan* plan = nullptr;
    status = anic_create_render_plan(asset.get(), 0, nullptr, &allocator, &plan);
    ASSERT_TRUE(status == ANIC_OK || status == ANIC_E_MEMORY);
    anic_destroy_render_plan(plan);
    ASSERT_EQ(memory.held, 0U);
    ASSERT_EQ(memory.small, 0U);
  }
  anic_render_plan* plan = nullptr;
  EXPECT_EQ(anic_create_render_plan(asset.get(), 9, nullptr, nullptr, &plan), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_get_render_info(nullptr, nullptr), ANIC_E_ARGUMENT);
}

}  // namespace
}  // namespace anicodec
