// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/api/all_files.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

constexpr double kNoHit = std::numeric_limits<double>::infinity();

std::vector<uint32_t> triangles_of(const Asset& asset) {
  anic_mesh mesh = ANIC_INIT(anic_mesh);
  EXPECT_EQ(anic_get_mesh(asset.get(), 0, &mesh), ANIC_OK);
  std::vector<uint32_t> triangles(size_t{3} * mesh.triangle_count);
  EXPECT_EQ(anic_write_indices(asset.get(), 0, 4, triangles.data(), triangles.size() * 4), ANIC_OK);
  return triangles;
}

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross_of(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot_of(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point point_at(const std::vector<float>& positions, uint32_t vertex) {
  const float* p = positions.data() + size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

/// The nearest distance at which a ray meets one of the triangles, by Cramer's rule.
double nearest(const std::vector<float>& positions, const std::vector<uint32_t>& triangles,
               const anic_ray& ray) {
  const Point from = {ray.origin[0], ray.origin[1], ray.origin[2]};
  const Point along = {ray.direction[0], ray.direction[1], ray.direction[2]};
  double found = kNoHit;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const Point a = point_at(positions, triangles[t]),
                u = point_at(positions, triangles[t + 1]) - a,
                v = point_at(positions, triangles[t + 2]) - a, n = cross_of(along, v);
    const double det = dot_of(u, n);
    if (det == 0)
      continue;
    const double x = dot_of(from - a, n) / det;
    const Point q = cross_of(from - a, u);
    const double y = dot_of(along, q) / det, distance = dot_of(v, q) / det;
    if (x >= 0 && y >= 0 && x + y <= 1 && distance >= 0)
      found = std::min(found, distance);
  }
  return found;
}

anic_hit shoot(const Context& context, const std::vector<uint32_t>& triangles, const anic_ray& ray,
               uint32_t vertices) {
  std::vector<float> work(size_t{3} * vertices);
  anic_hit hit;
  EXPECT_EQ(anic_intersect_ray(context.get(), 0, ANIC_WHEN_CURRENT, &ray, triangles.data(),
                               static_cast<uint32_t>(triangles.size() / 3), work.data(),
                               work.size() * 4, &hit),
            ANIC_OK);
  return hit;
}

/// Rays from around the shown picture, most of them towards a point of it.
class Rays {
 public:
  explicit Rays(const std::vector<float>& positions) : positions_(positions) {}

  anic_ray next() {
    anic_ray ray = ANIC_INIT(anic_ray);
    std::uniform_int_distribution<size_t> vertex(0, positions_.size() / 3 - 1);
    std::uniform_real_distribution<float> far(-2, 2), near(-0.02F, 0.02F);
    const float *from = positions_.data() + 3 * vertex(random_),
                *to = positions_.data() + 3 * vertex(random_);
    for (size_t c = 0; c < 3; ++c) {
      ray.origin[c] = from[c] + far(random_);
      ray.direction[c] = to[c] + near(random_) - ray.origin[c];
    }
    return ray;
  }

 private:
  const std::vector<float>& positions_;
  std::mt19937 random_{11};
};

TEST(AnicSurface, MeetsRaysAsBruteForceDoesAndNoBoxHidesAHit) {
  anic_options options = ANIC_INIT(anic_options);
  options.flags = ANIC_OPEN_BOUNDS;
  size_t hits = 0, misses = 0;
  for (const auto& [name, file] : all_files()) {
    SCOPED_TRACE(name);
    const Asset asset = open(file), bounded = open(file, &options);
    const std::vector<uint32_t> triangles = triangles_of(asset);
    const Context context = context_of(asset), culled = context_of(bounded);
    const double end = anic_get_frame_time(asset.get(), info_of(asset).frame_count - 1);
    for (int moment = 0; moment < 6; ++moment) {
      for (const Context* c : {&context, &culled}) {
        ASSERT_EQ(anic_set_quality(c->get(), moment == 5 ? 0.3 : 1), ANIC_OK);
        ASSERT_EQ(
            anic_seek_time(c->get(), end * moment / 5,
                           moment % 2 ? ANIC_SAMPLE_LINEAR : ANIC_SAMPLE_CUBIC, ANIC_WRAP_LOOP),
            ANIC_OK);
        if (moment == 3) {
          ASSERT_EQ(anic_blend(c->get(), 0, end / 7, ANIC_SAMPLE_LINEAR, ANIC_WRAP_LOOP, 0.4),
                    ANIC_OK);
        }
      }
      const uint32_t vertices = vertices_of(asset);
      std::vector<float> shown(size_t{3} * vertices);
      const anic_output output = floats(shown);
      if (anic_write_positions(context.get(), 0, ANIC_WHEN_CURRENT, 0, vertices, &output) ==
          ANIC_E_ABSENT)
        continue;
      Rays rays(shown);
      for (int i = 0; i < 20; ++i) {
        const anic_ray ray = rays.next();
        const double expected = nearest(shown, triangles, ray);
        const anic_hit hit = shoot(context, triangles, ray, vertices),
                       same = shoot(culled, triangles, ray, vertices);
        EXPECT_EQ(hit.triangle, same.triangle);
        EXPECT_EQ(hit.distance, same.distance);
        EXPECT_EQ(hit.triangle == UINT32_MAX, expected == kNoHit);
        if (hit.triangle == UINT32_MAX) {
          ++misses;
          continue;
        }
        ++hits;
        EXPECT_NEAR(hit.distance, expected, 1e-5 * (1 + expected));
        anic_surface_frame on;
        ASSERT_EQ(anic_get_surface_frame(context.get(), 0, ANIC_WHEN_CURRENT, &hit.point, &on),
                  ANIC_OK);
        double size = 0, facing = 0;
        for (size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(hit.point.vertices[c], triangles[size_t{3} * hit.triangle + c]);
          size = std::max(
              {size, std::abs(double{ray.direction[c]}), std::abs(double{on.position[c]})});
          facing += double{ray.direction[c]} * double{on.normal[c]};
        }
        EXPECT_EQ(hit.side, facing < 0 ? ANIC_SIDE_FRONT : ANIC_SIDE_BACK);
        for (size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(on.position[c], ray.origin[c] + hit.distance * ray.direction[c],
                      1e-5 * size * (1 + expected));
      }
    }
  }
  EXPECT_GT(hits, 500U);
  EXPECT_GT(misses, 100U);
}

TEST(AnicSurface, FramesFollowTheirTriangle) {
  const Asset asset = open(cut_clip());
  const Context context = context_of(asset);
  const std::vector<uint32_t> triangles = triangles_of(asset);
  anic_surface_point point = {{triangles[30], triangles[31], triangles[32]}, {0.2F, 0.3F, 0.5F}};
  for (double time : {0.0, 0.4, 1.1}) {
    ASSERT_EQ(anic_seek_time(context.get(), time, ANIC_SAMPLE_LINEAR, ANIC_WRAP_CLAMP), ANIC_OK);
    for (anic_when when : {ANIC_WHEN_CURRENT, ANIC_WHEN_PREVIOUS}) {
      const std::vector<float> shown = positions(asset, context, when);
      const Point a = point_at(shown, point.vertices[0]),
                  u = point_at(shown, point.vertices[1]) - a,
                  v = point_at(shown, point.vertices[2]) - a, n = cross_of(u, v);
      anic_surface_frame on;
      ASSERT_EQ(anic_get_surface_frame(context.get(), 0, when, &point, &on), ANIC_OK);
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(on.position[c],
                    a[c] + double{point.weights[1]} * u[c] + double{point.weights[2]} * v[c], 1e-6);
        EXPECT_NEAR(on.normal[c], n[c] / std::sqrt(dot_of(n, n)), 1e-6);
        EXPECT_NEAR(on.tangent[c], u[c] / std::sqrt(dot_of(u, u)), 1e-6);
      }
    }
  }
}

TEST(AnicSurface, RefusesArgumentsWithoutSense) {
  const Asset asset = open(cut_clip());
  const Context context = context_of(asset);
  const std::vector<uint32_t> triangles = triangles_of(asset);
  const uint32_t vertices = vertices_of(asset);
  std::vector<float> work(size_t{3} * vertices);
  anic_surface_point point = {{0, 1, 2}, {1, 0, 0}};
  anic_surface_frame frame;
  anic_hit hit;
  anic_ray ray = ANIC_INIT(anic_ray);
  ray.direction[1] = 1;
  const auto place = [&] {
    return anic_get_surface_frame(context.get(), 0, ANIC_WHEN_CURRENT, &point, &frame);
  };
  const auto meet = [&](size_t size, const uint32_t* list) {
    return anic_intersect_ray(context.get(), 0, ANIC_WHEN_CURRENT, &ray, list, list ? 1 : 0,
                              work.data(), size, &hit);
  };
  const size_t enough = work.size() * 4;
  EXPECT_EQ(place(), ANIC_E_STATE);
  EXPECT_EQ(meet(enough, triangles.data()), ANIC_E_STATE);
  ASSERT_EQ(anic_seek_frame(context.get(), 0), ANIC_OK);
  EXPECT_EQ(place(), ANIC_OK);
  EXPECT_EQ(meet(enough, triangles.data()), ANIC_OK);
  EXPECT_EQ(meet(enough - 1, triangles.data()), ANIC_E_BUFFER_SIZE);
  EXPECT_EQ(meet(enough, nullptr), ANIC_OK);
  EXPECT_EQ(hit.triangle, UINT32_MAX);
  EXPECT_EQ(hit.distance, INFINITY);
  const uint32_t beyond[] = {0, 1, vertices};
  EXPECT_EQ(meet(enough, beyond), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_intersect_ray(context.get(), 1, ANIC_WHEN_CURRENT, &ray, beyond, 0, work.data(),
                               enough, &hit),
            ANIC_E_ARGUMENT);
  point.vertices[2] = vertices;
  EXPECT_EQ(place(), ANIC_E_ARGUMENT);
  point = {{0, 1, 2}, {NAN, 0, 0}};
  EXPECT_EQ(place(), ANIC_E_ARGUMENT);
  for (const float wrong : {0.0F, NAN, INFINITY}) {
    ray.direction[1] = wrong;
    EXPECT_EQ(meet(enough, triangles.data()), ANIC_E_ARGUMENT);
  }
  ray.direction[1] = 1;
  ray.farthest = -1;
  EXPECT_EQ(meet(enough, triangles.data()), ANIC_E_ARGUMENT);
  ray.farthest = 0;
  ray.side = static_cast<anic_side>(3);
  EXPECT_EQ(meet(enough, triangles.data()), ANIC_E_ARGUMENT);
  ray.side = ANIC_SIDE_ANY;
  ray.struct_size = 0;
  EXPECT_EQ(meet(enough, triangles.data()), ANIC_E_ARGUMENT);
}

}  // namespace
}  // namespace anicodec
