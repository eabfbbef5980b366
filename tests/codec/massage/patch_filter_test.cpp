// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
#include "codec/massage/patch_filter.h"

#include "codec/massage/denoise.h"
#include "codec/massage/normal_fit.h"
#include "codec/massage/sliding_solver.h"
#include "codec/massage/untangle.h"
#include "codec/massage/welded_surface.h"
#include "codec/surface/mesh_quality.h"
#include "corpus/clips.h"
#include "tests/codec/massage_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace anicodec {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr uint32_t kSide = 16, kFrames = 20;

/// A sheet that turns and bends, with noise that every frame has of its own.
MeshSequence bending_sheet(const TestMesh& sheet, double noise) {
  MeshSequence clip;
  clip.vertex_count = kSide * kSide;
  clip.frame_count = kFrames;
  for (const SurfaceTopology::Triangle& t : sheet.topology.triangles)
    clip.polygons.add(t);
  for (uint32_t f = 0; f < kFrames; ++f) {
    const Eigen::AngleAxisd turn(0.3 * f, Vector3d(1, 2, 3).normalized());
    for (uint32_t i = 0; i < clip.vertex_count; ++i) {
      Vector3d p = row(sheet.positions, i);
      p[2] = std::sin(0.4 * f) * std::cos(0.3 * p[0]);
      p = turn * p;
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t c = 3 * i + k;
        clip.positions.push_back(
            static_cast<float>(p[k] + noise * std::sin(12.9898 * c + 78.233 * f + 0.37 * c * f)));
      }
    }
  }
  return clip;
}

double distance(const MeshSequence& a, const MeshSequence& b) {
  double sum = 0;
  for (size_t i = 0; i < a.positions.size(); ++i)
    sum += std::pow(double{a.positions[i]} - double{b.positions[i]}, 2);
  return std::sqrt(sum / static_cast<double>(a.positions.size()));
}

std::vector<uint32_t> all_vertices() {
  std::vector<uint32_t> vertices(kSide * kSide);
  std::iota(vertices.begin(), vertices.end(), 0U);
  return vertices;
}

TEST(PatchFilter, TakesOutNoiseAndLeavesMotion) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence clean = bending_sheet(sheet, 0), noisy = bending_sheet(sheet, 0.02);
  MeshSequence filtered = noisy;
  const double components =
      PatchFilter(sheet.topology).run(1, all_vertices(), 0, kFrames, &filtered);
  EXPECT_LT(distance(filtered, clean), 0.5 * distance(noisy, clean));
  EXPECT_GT(components, 0.5);
  EXPECT_LT(components, 5);
}

TEST(PatchFilter, LeavesOtherFramesAndVerticesAlone) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence noisy = bending_sheet(sheet, 0.02);
  MeshSequence filtered = noisy;
  PatchFilter(sheet.topology).run(1, all_vertices(), 5, 10, &filtered);
  for (uint32_t f : {0U, 4U, 15U, 19U})
    EXPECT_TRUE(std::ranges::equal(noisy.frame(f), filtered.frame(f))) << f;
  EXPECT_FALSE(std::ranges::equal(noisy.frame(5), filtered.frame(5)));
  const TestMesh small = flat_sheet(2);
  MeshSequence same = noisy;
  PatchFilter(small.topology).run(1, std::vector<uint32_t>{0, 1, 16, 17}, 0, kFrames, &same);
  EXPECT_EQ(same.positions, noisy.positions);
}

TEST(PatchFilter, LeavesMotionOfFewComponentsWithoutNoise) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence clean = bending_sheet(sheet, 0);
  MeshSequence filtered = clean;
  PatchFilter(sheet.topology).run(1, all_vertices(), 0, kFrames, &filtered);
  EXPECT_LT(distance(filtered, clean), 1e-4);
}

TEST(PatchFilter, KnowsTheMedianOfNoise) {
  EXPECT_NEAR(marchenko_pastur_median(1e-6), 1, 1e-3);
  // Of a square matrix, whose hard threshold 4 / sqrt(3 median) is known to be 2.858.
  EXPECT_NEAR(4 / std::sqrt(3 * marchenko_pastur_median(1)), 2.858, 1e-3);
}

TEST(Denoise, LeavesFewFramesAlone) {
  const MeshSequence clip = corpus::make_scaled("sliding", 400, 7);
  const WeldedSurface welded(clip);
  const std::vector<uint8_t> freedom(welded.topology.vertex_count, 2);
  MeshSequence massaged = clip;
  EXPECT_EQ(denoise(clip, welded, freedom, {}, &massaged).components, 0);
  EXPECT_EQ(massaged.positions, clip.positions);
}

TEST(Denoise, KeepsTheBoundaryInPlace) {
  const TestMesh sheet = flat_sheet(kSide);
  const MeshSequence noisy = bending_sheet(sheet, 0.02);
  const WeldedSurface welded(noisy);
  MeshSequence massaged = noisy;
  const std::vector<uint8_t> freedom = sliding_freedom(welded.topology, sheet.positions);
  denoise(noisy, welded, freedom, {}, &massaged);
  for (uint32_t f = 0; f < kFrames; ++f) {
    const Positions before = welded.frame(noisy.frame(f)), after = welded.frame(massaged.frame(f));
    for (uint32_t corner : {0U, kSide - 1, kSide * kSide - 1})
      EXPECT_EQ(row(before, corner), row(after, corner));
    EXPECT_NE(row(before, kSide + 1), row(after, kSide + 1));
  }
}

TEST(HeightFit, BringsPolygonsToTheCurvedSurface) {
  const TestMesh ball = sphere(8);
  const Surface surface(ball.topology, ball.positions);
  Positions v = ball.positions;
  for (Index i = 0; i < v.rows(); ++i)
    v.row(i) *= 1 + 0.02 * std::sin(3.0 * static_cast<double>(i));
  fit_normals(surface, 2, &v);
  for (Index i = 0; i < v.rows(); ++i)
    EXPECT_NEAR(v.row(i).norm(), 1, 0.006) << i;
}

TEST(HeightFit, LeavesTheBoundary) {
  const TestMesh sheet = flat_sheet(6);
  const Surface surface(sheet.topology, sheet.positions);
  Positions v = sheet.positions;
  v(0, 2) = 0.1;
  v(14, 2) = 0.1;
  fit_normals(surface, 1, &v);
  EXPECT_EQ(v(0, 2), 0.1);
  EXPECT_LT(std::abs(v(14, 2)), 0.02);
}

TEST(Untangle, TurnsATriangleByALittleMove) {
  const TestMesh sheet = flat_sheet(8);
  const Surface surface(sheet.topology, sheet.positions);
  Positions v = sheet.positions;
  v.row(27) += Eigen::RowVector3d(1.1, 0.2, 0);  // over the far side of its ring
  ASSERT_FALSE(turned_in_place(v, surface).empty());
  const Positions before = v;
  EXPECT_GT(untangle(surface, &v), 0U);
  EXPECT_TRUE(turned_in_place(v, surface).empty());
  EXPECT_LT((v - before).rowwise().norm().maxCoeff(), 0.3);
}

TEST(Untangle, LeavesWhatIsNotTurned) {
  const TestMesh ball = sphere(4);
  const Surface surface(ball.topology, ball.positions.cast<float>().cast<double>());
  Positions v = surface.positions();
  EXPECT_EQ(untangle(surface, &v), 0U);
  EXPECT_EQ(v, surface.positions());
}

}  // namespace
}  // namespace anicodec
