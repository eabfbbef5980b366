// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "tests/api/opened.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace anicodec {
namespace {

struct NormalsDestroyer {
  void operator()(anic_normal_plan* normals) const { anic_destroy_normal_plan(normals); }
};

using Normals = std::unique_ptr<anic_normal_plan, NormalsDestroyer>;

Normals plan(const Asset& asset, double crease, bool per_corner) {
  anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
  options.crease_angle = crease;
  options.per_corner = per_corner;
  anic_normal_plan* normals = nullptr;
  EXPECT_EQ(anic_create_normal_plan(asset.get(), 0, &options, nullptr, &normals), ANIC_OK);
  return Normals(normals);
}

std::vector<float> compute(const Normals& normals, const std::vector<float>& positions) {
  const uint32_t n = anic_get_normal_count(normals.get());
  std::vector<float> out(size_t{3} * n);
  const anic_output output = floats(out);
  EXPECT_EQ(anic_write_normals(normals.get(), positions.data(), 0, 0, n, &output), ANIC_OK);
  return out;
}

/// A clip of one frame twice, kept exactly enough.
Asset still(MeshSequence clip) {
  EncodeOptions options;
  options.target = {ErrorMetric::kMaxError, 1e-3, true};
  options.basis = BasisChoice::kKeyframes;
  options.effort = Effort::kFast;
  return open(encode(clip, options).file);
}

/// A cube of quads; every quad with corners of its own if `apart`.
MeshSequence cube(bool apart) {
  MeshSequence clip;
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  auto add_vertex = [&](int v) {
    for (int c = 0; c < 3; ++c)
      clip.positions.push_back((v >> c & 1) ? 1.0F : -1.0F);
    return clip.vertex_count++;
  };
  if (!apart) {
    for (int v = 0; v < 8; ++v)
      add_vertex(v);
  }
  for (const auto& quad : quads) {
    uint32_t corners[4];
    for (int i = 0; i < 4; ++i)
      corners[i] = apart ? add_vertex(quad[i]) : static_cast<uint32_t>(quad[i]);
    clip.polygons.add(corners);
  }
  clip.frame_count = 2;
  const FrameArray once = clip.positions;
  clip.positions.insert(clip.positions.end(), once.begin(), once.end());
  return clip;
}

double length(const float* v) {
  return std::hypot(static_cast<double>(v[0]), static_cast<double>(v[1]),
                    static_cast<double>(v[2]));
}

TEST(AnicNormals, ACubeIsSmoothOrHard) {
  for (bool apart : {false, true}) {
    const Asset asset = still(cube(apart));
    const std::vector<float> p = frame(asset, 0);
    // Smooth: the diagonals, across the seams.
    std::vector<float> n = compute(plan(asset, 0, false), p);
    ASSERT_EQ(n.size(), p.size());
    for (size_t i = 0; i < n.size(); ++i)
      EXPECT_NEAR(n[i], p[i] / std::sqrt(3.0F), 2e-3);
    // Hard: along the axes, away from the middle, one of each corner's three.
    n = compute(plan(asset, 30, true), p);
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    ASSERT_EQ(anic_get_polygons(asset.get(), 0, &polygons), ANIC_OK);
    ASSERT_EQ(n.size(), 72U);
    for (uint32_t q = 0; q < 6; ++q) {
      for (uint32_t c = polygons.offsets[q]; c < polygons.offsets[q + 1]; ++c) {
        const float* normal = &n[size_t{3} * c];
        const float* point = &p[size_t{3} * polygons.corners[c]];
        double along = 0;
        for (size_t i = 0; i < 3; ++i) {
          along += static_cast<double>(normal[i] * point[i]);
          EXPECT_NEAR(std::abs(normal[i]) * (1 - std::abs(normal[i])), 0, 2e-3);
          EXPECT_NEAR(normal[i], n[size_t{3} * polygons.offsets[q] + i], 2e-3);
        }
        EXPECT_NEAR(along, 1, 2e-3);
      }
    }
    // Each vertex one: hard ones where the source has its seams, smooth where it has none.
    n = compute(plan(asset, 30, false), p);
    for (size_t v = 0; v < n.size() / 3; ++v) {
      EXPECT_NEAR(length(&n[3 * v]), 1, 1e-6);
      const float most =
          std::max({std::abs(n[3 * v]), std::abs(n[3 * v + 1]), std::abs(n[3 * v + 2])});
      EXPECT_NEAR(most, apart ? 1 : 1 / std::sqrt(3.0F), 2e-3);
    }
  }
}

TEST(AnicNormals, RangesFormatsAndStridesAgree) {
  const Asset asset = open(encoded_clip("cloth", BasisChoice::kEigenshapes));
  const Normals normals = plan(asset, 60, false);
  const std::vector<float> p = frame(asset, 9);
  const std::vector<float> whole = compute(normals, p);
  std::vector<float> spread(p.size() / 3 * 5, 1e9F);
  for (size_t v = 0; v < p.size() / 3; ++v)
    std::copy_n(&p[3 * v], 3, &spread[5 * v]);
  const uint32_t n = anic_get_normal_count(normals.get());
  for (uint32_t first : {0U, 5U, 300U}) {
    std::vector<int16_t> out(size_t{4} * (n - first));
    anic_output output = ANIC_INIT(anic_output);
    output.data = out.data();
    output.size = 2 * out.size();
    output.format = ANIC_FORMAT_SNORM16X4;
    ASSERT_EQ(anic_write_normals(normals.get(), spread.data(), 20, first, n - first, &output),
              ANIC_OK);
    for (size_t i = 0; i < out.size(); ++i) {
      if (i % 4 < 3) {
        EXPECT_NEAR(out[i] / 32767.0, static_cast<double>(whole[3 * (first + i / 4) + i % 4]),
                    1.0 / 32767);
      }
    }
  }
  const anic_output output = ANIC_INIT(anic_output);
  EXPECT_EQ(anic_write_normals(normals.get(), p.data(), 6, 0, 1, &output), ANIC_E_ARGUMENT);
  EXPECT_EQ(anic_write_normals(normals.get(), p.data(), 0, n, 1, &output), ANIC_E_ARGUMENT);
}

TEST(AnicNormals, AreSumsOfTheAreasAtEachCorner) {
  for (const char* name : {"limb", "polygons"}) {
    SCOPED_TRACE(name);
    const Asset asset = open(encoded_clip(name, BasisChoice::kEigenshapes));
    const std::vector<float> p = frame(asset, 1);
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    ASSERT_EQ(anic_get_polygons(asset.get(), 0, &polygons), ANIC_OK);
    // Vertices at one place share a normal: their coded vertex is not told here, their place is.
    std::map<std::vector<float>, std::vector<double>> sums;
    const auto place = [&](uint32_t v) {
      return std::vector<float>(&p[size_t{3} * v], &p[size_t{3} * v] + 3);
    };
    for (uint32_t f = 0; f < polygons.polygon_count; ++f) {
      const uint32_t first = polygons.offsets[f], count = polygons.offsets[f + 1] - first;
      for (uint32_t i = 0; count > 2 && i < count; ++i) {
        const float* c = &p[size_t{3} * polygons.corners[first + i]];
        const float* a = &p[size_t{3} * polygons.corners[first + (i + 1) % count]];
        const float* b = &p[size_t{3} * polygons.corners[first + (i + count - 1) % count]];
        std::vector<double>& sum = sums[place(polygons.corners[first + i])];
        sum.resize(3);
        const auto edge = [c](const float* to, size_t x) { return double{to[x]} - double{c[x]}; };
        for (size_t x = 0; x < 3; ++x) {
          const size_t y = (x + 1) % 3, z = (x + 2) % 3;
          sum[x] += edge(a, y) * edge(b, z) - edge(a, z) * edge(b, y);
        }
      }
    }
    const std::vector<float> n = compute(plan(asset, 0, false), p);
    for (uint32_t v = 0; v < n.size() / 3; ++v) {
      std::vector<double> sum = sums[place(v)];
      if (sum.empty())
        continue;
      const double size = std::hypot(sum[0], sum[1], sum[2]);
      if (!(size > 1e-9))
        continue;
      for (size_t x = 0; x < 3; ++x)
        ASSERT_NEAR(double{n[size_t{3} * v + x]}, sum[x] / size, 1e-4) << v;
    }
    // The same for every corner, bit by bit.
    const std::vector<float> of_corners = compute(plan(asset, 0, true), p);
    for (uint32_t c = 0; c < of_corners.size() / 3; ++c)
      for (size_t x = 0; x < 3; ++x)
        ASSERT_EQ(of_corners[size_t{3} * c + x], n[size_t{3} * polygons.corners[c] + x]);
  }
}

TEST(AnicNormals, AreHardWhereTheSourceWas) {
  const Asset asset = open(encoded_clip("painted_box", BasisChoice::kKeyframes));
  anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
  options.per_corner = 1;
  auto distinct = [&] {
    anic_normal_plan* made = nullptr;
    EXPECT_EQ(anic_create_normal_plan(asset.get(), 0, &options, nullptr, &made), ANIC_OK);
    const Normals normals(made);
    const std::vector<float> n = compute(normals, frame(asset, 0));
    anic_polygons polygons = ANIC_INIT(anic_polygons);
    EXPECT_EQ(anic_get_polygons(asset.get(), 0, &polygons), ANIC_OK);
    std::set<std::vector<float>> of_vertex;
    for (uint32_t c = 0; c < anic_get_normal_count(normals.get()); ++c)
      of_vertex.insert({static_cast<float>(polygons.corners[c]), n[size_t{3} * c],
                        n[size_t{3} * c + 1], n[size_t{3} * c + 2]});
    return of_vertex.size();
  };
  EXPECT_EQ(distinct(), 98U);  // smooth: a normal for each vertex
  options.source_edges = 1;
  EXPECT_EQ(distinct(), 6U * 25);  // every side of the box for itself
}

TEST(AnicNormals, AreUnitVectorsForAnyMesh) {
  for (const auto& [name, basis] : cases()) {
    SCOPED_TRACE(name);
    const Asset asset = open(encoded_clip(name, basis));
    for (double crease : {0.0, 0.001, 45.0}) {
      for (bool per_corner : {false, true}) {
        const std::vector<float> n = compute(plan(asset, crease, per_corner), frame(asset, 1));
        for (size_t i = 0; i + 2 < n.size(); i += 3)
          ASSERT_NEAR(length(&n[i]), 1, 1e-6);
      }
    }
  }
  // No face: nothing to average.
  const Asset points = open(encoded_clip("points", BasisChoice::kEigenshapes));
  const std::vector<float> n = compute(plan(points, 0, false), frame(points, 1));
  EXPECT_EQ(n[0], 0);
  EXPECT_EQ(n[2], 1);
  anic_normal_plan_options options = ANIC_INIT(anic_normal_plan_options);
  options.reference_frame = 30;
  anic_normal_plan* none = nullptr;
  EXPECT_EQ(anic_create_normal_plan(points.get(), 0, &options, nullptr, &none), ANIC_E_FRAME_RANGE);
}

TEST(AnicNormals, FailWithoutALeakWhenThereIsNoMemory) {
  const Asset asset = open(encoded_clip("polygons", BasisChoice::kKeyframes));
  anic_status status = ANIC_E_MEMORY;
  for (size_t n = 0; status != ANIC_OK; ++n) {
    CountingMemory memory;
    memory.fail_at = n;
    const anic_allocator allocator = memory.allocator();
    anic_normal_plan* normals = nullptr;
    status = anic_create_normal_plan(asset.get(), 0, nullptr, &allocator, &normals);
    ASSERT_TRUE(status == ANIC_OK || status == ANIC_E_MEMORY);
    anic_destroy_normal_plan(normals);
    ASSERT_EQ(memory.held, 0U);
  }
}

}  // namespace
}  // namespace anicodec
